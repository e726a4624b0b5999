#!/bin/bash
# ODE: contacts of two triangle meshes that do not touch
# Packages of Debian 12: libode-dev=2:0.16.2-1, libode8=2:0.16.2-1. Needs g++.
# Guess: two cubes 1 nm apart have no contact or contacts of depth 0; 0.1 m inside each other they have the depth 0.1 m.
# Seen: 1 nm apart there are two contacts of depth 0.7 m along the common face, which is how far one cube reaches over the
#   edge of the other, and they are among those of cubes that overlap as well: a solver that takes them pushes the cubes
#   sideways.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libode-dev=2:0.16.2-1 libode8=2:0.16.2-1
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.cpp <<'E'
#include <ode/ode.h>
#include <algorithm>
#include <cstdio>
// Corners of the unit cube and its faces, seen from outside.
const double corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
const int face[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
int main() {
    dInitODE();
    dTriIndex index[12][3];
    for (int t = 0; t < 12; ++t) std::copy(face[t], face[t] + 3, index[t]);
    const dTriMeshDataID data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, corner, sizeof corner[0], 8, index, 36, sizeof index[0]);
    const dGeomID one = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr), two = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
    for (const double gap : {0.1, 1e-9, -0.1}) {
        dGeomSetPosition(two, 1 + gap, 0.2, 0.3);
        dContactGeom contact[64];
        const int n = dCollide(one, two, 64, contact, sizeof contact[0]);
        double deepest = 0, along_face = 0;
        for (int i = 0; i < n; ++i) {
            deepest = std::max(deepest, contact[i].depth);
            if (contact[i].normal[0] == 0) ++along_face;
        }
        std::printf("gap %g: deepest %.2f m, contacts with a normal along the face: %g\n", gap, deepest, along_face);
    }
}
E
g++ -O1 -I"$include" a.cpp -L"$lib" -lode -o a
./a | tee output
diff output - <<'E'
gap 0.1: deepest 0.00 m, contacts with a normal along the face: 0
gap 1e-09: deepest 0.70 m, contacts with a normal along the face: 2
gap -0.1: deepest 0.70 m, contacts with a normal along the face: 2
E
