#!/bin/bash
# OpenMesh: an STL of two cubes that touch
# Packages of Debian 12: libopenmesh-dev=9.0-4+b1, libopenmesh1=9.0-4+b1. Needs g++ and python3.
# Guess: two closed cubes in one STL are read as two closed surfaces of 8 vertices each where they touch, as they are where
#   they are 1 mm apart; or reading ends with false.
# Seen: apart there are 16 vertices and no boundary. Touching at one corner, along one edge or with a whole face, read_mesh
#   gives true, all 24 triangles, and surfaces that are open: 24, 30 and 34 edges are boundaries. Standard error says
#   "complex vertex".
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -o APT::Sandbox::User=root download libopenmesh-dev=9.0-4+b1 libopenmesh1=9.0-4+b1
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > cubes.py <<'E'
import struct
faces = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
def write(name, *corners):
    with open(name, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", 12 * len(corners)))
        for corner in corners:
            for face in faces:
                file.write(struct.pack("<3f", 0, 0, 0))
                for i in face:
                    file.write(struct.pack("<3f", corner[0] + i % 2, corner[1] + i // 2 % 2, corner[2] + i // 4))
                file.write(bytes(2))
write("apart.stl", (0, 0, 0), (1.001, 0, 0))
write("corner.stl", (0, 0, 0), (1, 1, 1))
write("edge.stl", (0, 0, 0), (1, 1, 0))
write("face.stl", (0, 0, 0), (1, 0, 0))
E
cat > a.cpp <<'E'
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdio>
int main(int count, char** files) {
    for (int k = 1; k < count; ++k) {
        OpenMesh::TriMesh_ArrayKernelT<> mesh;
        const bool is_read = OpenMesh::IO::read_mesh(mesh, files[k]);
        int open = 0;
        for (auto edge : mesh.edges()) open += mesh.is_boundary(edge);
        std::printf("%s: read %s, %zu triangles, open edges: %d\n", files[k], is_read ? "true" : "false", mesh.n_faces(),
                    open);
    }
}
E
python3 cubes.py
g++ a.cpp -o a -I"$include" -L"$lib" -lOpenMeshCore -Wl,-rpath-link,"$libraries"
./a apart.stl corner.stl edge.stl face.stl 2>errors | tee output
sort -u errors | grep -o "complex vertex" | tee -a output
diff output - <<'E'
apart.stl: read true, 24 triangles, open edges: 0
corner.stl: read true, 24 triangles, open edges: 24
edge.stl: read true, 24 triangles, open edges: 30
face.stl: read true, 24 triangles, open edges: 34
complex vertex
E
