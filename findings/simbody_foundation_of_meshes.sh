#!/bin/bash
# Simbody: force of an elastic foundation between two meshed cubes, as their meshes are refined
# Packages of Debian 12: libsimbody-dev=3.7+dfsg-3, libsimbody3.7=3.7+dfsg-3, libblas3=3.11.0-2, liblapack3=3.11.0-2. Needs g++
#   and libgfortran5.
# Guess: a unit cube of stiffness 1,000 N/m^3 that is 0.1 m deep in the top of a rigid one gets 100 N upwards, and 70 N where it
#   overhangs by 0.3 m, better with each refinement: the force is a sum over faces of stiffness, area and depth.
# Seen: 100 N with 2 and 8 triangles a side and 56 N with 32 and 128: triangles near the edge are nearest to the side
#   of the other cube and are pushed sideways by that. Overhanging it is 50, 50, 49 and 51 N, and up to 17 N sideways.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -o APT::Sandbox::User=root download libsimbody-dev=3.7+dfsg-3 libsimbody3.7=3.7+dfsg-3 libblas3=3.11.0-2 liblapack3=3.11.0-2
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

libraries="$lib/blas:$lib/lapack:$libraries" && export LD_LIBRARY_PATH="$libraries"
cat > a.cpp <<'E'
#include <array>
#include <cstdio>
#include <map>
#include "Simbody.h"
using namespace SimTK;
// Surface of a unit cube around the origin, 2 n^2 triangles a side.
PolygonalMesh cube_of(int n) {
    PolygonalMesh mesh;
    std::map<std::array<int, 3>, int> numbers;
    const auto vertex = [&](std::array<int, 3> i) {
        const auto found = numbers.find(i);
        if (found != numbers.end()) return found->second;
        return numbers[i] = mesh.addVertex(Vec3(double(i[0]) / n - 0.5, double(i[1]) / n - 0.5, double(i[2]) / n - 0.5));
    };
    const auto add = [&](int a, int b, int c) {
        Array_<int> corners;
        for (int corner : {a, b, c}) corners.push_back(corner);
        mesh.addFace(corners);
    };
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    const auto at = [&](int a, int b) {
                        std::array<int, 3> place{};
                        place[axis] = side * n, place[(axis + 1) % 3] = a, place[(axis + 2) % 3] = b;
                        return vertex(place);
                    };
                    const int p = at(i, j), q = at(i + 1, j), r = at(i + 1, j + 1), s = at(i, j + 1);
                    side ? add(p, q, r) : add(p, r, q);
                    side ? add(p, r, s) : add(p, s, r);
                }
    return mesh;
}
Vec3 force(int n, double overhang) {
    MultibodySystem system;
    SimbodyMatterSubsystem matter(system);
    GeneralForceSubsystem forces(system);
    GeneralContactSubsystem contacts(system);
    const ContactSetIndex set = contacts.createContactSet();
    const Body::Rigid body(MassProperties(1, Vec3(0), Inertia(1)));
    MobilizedBody::Free cube(matter.updGround(), Transform(), body, Transform());
    contacts.addBody(set, cube, ContactGeometry::TriangleMesh(cube_of(n)), Transform());
    contacts.addBody(set, matter.updGround(), ContactGeometry::TriangleMesh(cube_of(n)), Transform(Vec3(0, -0.5, 0)));
    ElasticFoundationForce foundation(forces, contacts, set);
    foundation.setBodyParameters(ContactSurfaceIndex(0), 1000, 0, 0, 0, 0);
    State state = system.realizeTopology();
    cube.setQToFitTransform(state, Vec3(overhang, 0.4, 0));
    system.realize(state, Stage::Dynamics);
    return system.getRigidBodyForces(state, Stage::Dynamics)[cube.getMobilizedBodyIndex()][1];
}
int main() {
    for (int n : {1, 2, 4, 8}) {
        const Vec3 on = force(n, 0), over = force(n, 0.3);
        std::printf("%d triangles a side: %.0f N upwards; overhanging %.0f N upwards, %.0f N sideways\n", 2 * n * n, on[1], over[1], over[0]);
    }
}
E
g++ -w -std=c++17 a.cpp -o a -I"$include" -I"$include/simbody" -L"$lib" -lSimTKsimbody -lSimTKmath -lSimTKcommon -Wl,-rpath-link,"$libraries"
./a | tee output
diff output - <<'E'
2 triangles a side: 100 N upwards; overhanging 50 N upwards, 17 N sideways
8 triangles a side: 100 N upwards; overhanging 50 N upwards, 8 N sideways
32 triangles a side: 56 N upwards; overhanging 49 N upwards, 4 N sideways
128 triangles a side: 56 N upwards; overhanging 51 N upwards, 2 N sideways
E
