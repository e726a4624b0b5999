#!/bin/bash
# Bullet: moments of inertia that shapes give for a mass of 1 kg
# Packages of Debian 12: libbullet-dev=3.24+dfsg-2, libbullet3.24=3.24+dfsg-2. Needs g++.
# Guess: calculateLocalInertia gives that of the solid: 1/6 for a unit cube of points, 0.4 for the regular tetrahedron, 0.075
#   about the axis of a cone of radius 0.5 and height 1, 1/6 kg m^2 for the triangle mesh of a unit cube.
# Seen: 0.256 and 0.836 for the hulls and 0.256 for the cone, which is the box around each, thicker by three margins of 0.04 m
#   on each side; 0.5 for the mesh, as if its mass were in its corners. Box and cylinder are right.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libbullet-dev=3.24+dfsg-2 libbullet3.24=3.24+dfsg-2
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.cpp <<'E'
#include <btBulletCollisionCommon.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <cstdio>
// Corners of the unit cube and its faces, seen from outside.
const double corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
const int face[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
void say(const char* what, const btCollisionShape& shape, double right) {
    btVector3 inertia;
    shape.calculateLocalInertia(1, inertia);
    std::printf("%s: %.4f, right is %.4f\n", what, inertia.y(), right);
}
int main() {
    btConvexHullShape cube, tetrahedron;
    for (auto& x : corner) cube.addPoint(btVector3(x[0] - 0.5, x[1] - 0.5, x[2] - 0.5));
    for (auto& x : {btVector3(1, 1, 1), btVector3(1, -1, -1), btVector3(-1, 1, -1), btVector3(-1, -1, 1)}) tetrahedron.addPoint(x);
    btTriangleMesh triangles;
    const auto point = [](int i) { return btVector3(corner[i][0] - 0.5, corner[i][1] - 0.5, corner[i][2] - 0.5); };
    for (auto& t : face) triangles.addTriangle(point(t[0]), point(t[1]), point(t[2]));
    btGImpactMeshShape mesh(&triangles);
    mesh.updateBound();
    say("box", btBoxShape(btVector3(0.5, 0.5, 0.5)), 1.0 / 6);
    say("cylinder", btCylinderShape(btVector3(0.5, 0.5, 0.5)), 0.125);
    say("cone", btConeShape(0.5, 1), 0.075);
    say("hull of a cube", cube, 1.0 / 6);
    say("hull of a tetrahedron", tetrahedron, 0.4);
    say("mesh of a cube", mesh, 1.0 / 6);
}
E
g++ -O1 -I"$include" -I"$include/bullet" a.cpp -L"$lib" -lBulletCollision -lLinearMath -o a
./a | tee output
diff output - <<'E'
box: 0.1667, right is 0.1667
cylinder: 0.1250, right is 0.1250
cone: 0.2563, right is 0.0750
hull of a cube: 0.2563, right is 0.1667
hull of a tetrahedron: 0.8363, right is 0.4000
mesh of a cube: 0.5000, right is 0.1667
E
