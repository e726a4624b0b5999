#!/bin/bash
# VTK: vtkMassProperties of a surface that is inside out, and of one with a hole
# Packages of Debian 12: python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1.
# Guess: the volume of a unit cube whose triangles all face inwards is -1, so that the sign tells; a cube without its top is
#   refused or warned of.
# Seen: inside out it is +1, as with right faces. Without the top (two triangles) it is 0.8, and 0.2 where the same surface
#   stands 3 m further, with no word about the hole.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

/usr/bin/python3 - <<'E' 2>&1 | tee output
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkMassProperties
faces = [(0, 2, 3), (0, 3, 1), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5), (4, 5, 7), (4, 7, 6)]
def volume(faces, shift=0.0):
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    for i in range(8):
        points.InsertNextPoint(i % 2 + shift, i // 2 % 2, i // 4 + shift)
    for face in faces:
        cells.InsertNextCell(3, face)
    data.SetPoints(points)
    data.SetPolys(cells)
    mass = vtkMassProperties()
    mass.SetInputData(data)
    mass.Update()
    return round(mass.GetVolume(), 4)
print("cube:", volume(faces))
print("inside out:", volume([face[::-1] for face in faces]))
print("without its top:", volume(faces[:10]), "and, 3 m further:", volume(faces[:10], 3.0))
E
diff output - <<'E'
cube: 1.0
inside out: 1.0
without its top: 0.8 and, 3 m further: 0.2
E
