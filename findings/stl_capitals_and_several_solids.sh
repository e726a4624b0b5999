#!/bin/bash
# ASCII STL: several solids, and keywords in capitals
# Packages of Debian 12: python3-stl=2.9.0-2+b3, python3-meshio=7.0.0-3, python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1.
# Guess: readers of ASCII STL take all solids of a file and keywords in capitals, as the first specification has them.
# Seen: numpy-stl's Mesh.from_file takes the first solid and says nothing (from_multi_file has all); meshio fails over
#   capitals with a ValueError about 'OUTER'. VTK reads both.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-stl=2.9.0-2+b3 python3-meshio=7.0.0-3 python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

for z in 0 1; do
    printf "solid part$z\nfacet normal 0 0 1\nouter loop\nvertex 0 0 $z\nvertex 1 0 $z\nvertex 0 1 $z\nendloop\nendfacet\nendsolid part$z\n"
done > small.stl
tr a-z A-Z < small.stl > CAPITALS.stl
/usr/bin/python3 - <<'E' 2>/dev/null | grep -E "^(numpy-stl|meshio|VTK)" | tee output
import meshio, stl
from vtkmodules.vtkIOGeometry import vtkSTLReader
def by_vtk(name):
    reader = vtkSTLReader()
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput().GetNumberOfCells()
readers = {"numpy-stl": lambda name: len(stl.mesh.Mesh.from_file(name).vectors), "VTK": by_vtk,
           "meshio": lambda name: sum(len(block.data) for block in meshio.read(name).cells)}
for name in ("small.stl", "CAPITALS.stl"):
    for who, read in readers.items():
        try:
            print(who, name, read(name), "of 2 triangles")
        except Exception as error:
            print(who, name, error)
E
diff output - <<'E'
numpy-stl small.stl 1 of 2 triangles
VTK small.stl 2 of 2 triangles
meshio small.stl 2 of 2 triangles
numpy-stl CAPITALS.stl 1 of 2 triangles
VTK CAPITALS.stl 2 of 2 triangles
meshio CAPITALS.stl could not convert string to float: 'OUTER'
E
