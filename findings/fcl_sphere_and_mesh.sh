#!/bin/bash
# FCL: signs and frames of a sphere against a triangle mesh
# Packages of Debian 12: libfcl-dev=0.7.0-3+b1, libfcl0.7=0.7.0-3+b1. Needs g++.
# Guess: depths are positive, the normal points from the first object to the second and so turns when they are swapped, and
#   nearest points are in the frame of the world, all as for a sphere and a box.
# Seen: the depth is -0.1 m, the normal is (1, 0, 0) whichever comes first, and of the nearest points the first is always of
#   the mesh, in the frame of the mesh, the second of the sphere, in its own frame.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libfcl-dev=0.7.0-3+b1 libfcl0.7=0.7.0-3+b1
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.cpp <<'E'
#include <fcl/fcl.h>
#include <cstdio>
using namespace fcl;
// Corners of the unit cube and its faces, seen from outside.
const double corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
const int face[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
auto cube() {
    auto mesh = std::make_shared<BVHModel<OBBRSSd>>();
    std::vector<Vector3d> points;
    std::vector<Triangle> triangles;
    for (auto& x : corner) points.emplace_back(x[0], x[1], x[2]);
    for (auto& t : face) triangles.emplace_back(t[0], t[1], t[2]);
    mesh->beginModel();
    mesh->addSubModel(points, triangles);
    mesh->endModel();
    return mesh;
}
Transform3d at(double x, double y, double z) {
    Transform3d pose = Transform3d::Identity();
    pose.translation() = Vector3d(x, y, z);
    return pose;
}
void look(const char* what, CollisionObjectd one, CollisionObjectd two) {
    CollisionResultd touching;
    DistanceResultd nearest;
    if (collide(&one, &two, CollisionRequestd(1, true), touching) > 0) {
        const auto& c = touching.getContact(0);
        std::printf("%s: depth %.2f, normal %.1f\n", what, c.penetration_depth, c.normal.x());
    } else {
        const double d = distance(&one, &two, DistanceRequestd(true), nearest);
        std::printf("%s: distance %.2f, nearest x %.1f and %.1f\n", what, d, nearest.nearest_points[0].x(),
                    nearest.nearest_points[1].x());
    }
}
int main() {  // all at x = 10: the cube ends at x = 11, the sphere of radius 0.5 begins at 10.9 or 11.2
    const auto sphere = std::make_shared<Sphered>(0.5);
    const CollisionObjectd mesh(cube(), at(10, 0, 0)), box(std::make_shared<Boxd>(1, 1, 1), at(10.5, 0.5, 0.5));
    for (const double x : {11.4, 11.7}) {
        const CollisionObjectd ball(sphere, at(x, 0.5, 0.5));
        look("box, sphere", box, ball);
        look("sphere, box", ball, box);
        look("mesh, sphere", mesh, ball);
        look("sphere, mesh", ball, mesh);
    }
}
E
g++ -O1 -I"$include" -I"$include/eigen3" -I/usr/include/eigen3 a.cpp -L"$lib" -lfcl -lccd -loctomap -loctomath -o a
./a | tee output
diff output - <<'E'
box, sphere: depth 0.10, normal 1.0
sphere, box: depth 0.10, normal -1.0
mesh, sphere: depth -0.10, normal 1.0
sphere, mesh: depth -0.10, normal 1.0
box, sphere: distance 0.20, nearest x 11.0 and 11.2
sphere, box: distance 0.20, nearest x 11.2 and 11.0
mesh, sphere: distance 0.20, nearest x 1.0 and -0.5
sphere, mesh: distance 0.20, nearest x 1.0 and -0.5
E
