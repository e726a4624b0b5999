#!/bin/bash
# FCL: what distance() says of two triangle meshes that overlap
# Packages of Debian 12: libfcl-dev=0.7.0-3+b1, libfcl0.7=0.7.0-3+b1. Needs g++.
# Guess: the nearest points of two cubes that overlap by 0.1 m coincide, or the distance is negative with
#   enable_signed_distance, as it is for two boxes; contacts all have the depth 0.1 m.
# Seen: the distance is 0, signed or not, and its two nearest points lie 0.49 m apart: they are points of the two triangles
#   where the search stopped. One of the contacts has the depth 0.7 m, along the face, since depths are those of pairs of
#   triangles and not of bodies.
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
#include <algorithm>
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
int main() {
    CollisionObjectd one(cube(), at(0, 0, 0)), two(cube(), at(0.9, 0.2, 0.3));
    CollisionResultd touching;
    collide(&one, &two, CollisionRequestd(1000, true), touching);
    double least = 1e9, largest = 0;
    for (size_t i = 0; i < touching.numContacts(); ++i) {
        least = std::min(least, touching.getContact(i).penetration_depth);
        largest = std::max(largest, touching.getContact(i).penetration_depth);
    }
    std::printf("meshes: depths from %.3f to %.3f m\n", least, largest);
    const auto box = std::make_shared<Boxd>(1, 1, 1);
    CollisionObjectd box_1(box, at(0, 0, 0)), box_2(box, at(0.9, 0.2, 0.3));
    for (auto [what, a, b] : {std::tuple{"meshes", &one, &two}, {"boxes", &box_1, &box_2}}) {
        DistanceResultd nearest;
        const double d = distance(a, b, DistanceRequestd(true, true), nearest);
        std::printf("%s: distance %.3f m, nearest points %.3f m apart\n", what, d,
                    (nearest.nearest_points[0] - nearest.nearest_points[1]).norm());
    }
}
E
g++ -O1 -I"$include" -I"$include/eigen3" -I/usr/include/eigen3 a.cpp -L"$lib" -lfcl -lccd -loctomap -loctomath -o a
./a | tee output
diff output - <<'E'
meshes: depths from 0.100 to 0.700 m
meshes: distance 0.000 m, nearest points 0.495 m apart
boxes: distance -0.100 m, nearest points 0.100 m apart
E
