#!/bin/bash
# VTK: volumes of a polyhedral cell that is not convex, and of two hexahedra that share a warped face
# Packages of Debian 12: python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1.
# Guess: vtkCellSizeFilter and vtkIntegrateAttributes give the volume of the cell that is written: 3 for an angle of three unit cubes
#   with planar faces. Volumes of two hexahedra that fill a box add up to that of the box, wherever the corners of their common face lie.
# Seen: the angle has 3.5, which is its convex hull; the field is integrated over the hull as well. A box of volume 2 has 2.08 or 1.92
#   once a corner of the common face is moved by half an edge: each hexahedron cuts this face along a diagonal of its own.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' 2>&1 | tee output
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, VTK_POLYHEDRON, vtkUnstructuredGrid
from vtkmodules.vtkFiltersParallel import vtkIntegrateAttributes
from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter

def grid_of(kind, corners, cells):
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    points.SetDataType(VTK_DOUBLE)
    for corner in corners:
        points.InsertNextPoint(corner)
    grid.SetPoints(points)
    for cell in cells:
        ids = vtkIdList()
        for i in cell:
            ids.InsertNextId(i)
        grid.InsertNextCell(kind, ids)
    return grid

def volumes(grid):
    size, integral = vtkCellSizeFilter(), vtkIntegrateAttributes()
    for each in size, integral:
        each.SetInputData(grid)
        each.Update()
    cells = size.GetOutput().GetCellData().GetArray("Volume")
    total = integral.GetOutput().GetCellData().GetArray("Volume").GetValue(0)
    return f"cells {[round(cells.GetValue(i), 4) for i in range(cells.GetNumberOfTuples())]}, integral of 1: {round(total, 4)}"

def prism(outline):  # height 1, as a polyhedron: number of faces, then the number of corners and the corners of each
    n = len(outline)
    faces = [list(range(n))[::-1], list(range(n, 2 * n))] + [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    stream = [len(faces)] + [i for face in faces for i in [len(face)] + face]
    return grid_of(VTK_POLYHEDRON, [(x, y, z) for z in (0, 1) for x, y in outline], [stream])

def box(move):  # two hexahedra, one on the other; a corner of their common face is moved along the height
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = [[x, y, z] for z in (0, 1, 2) for x, y in square]
    corners[6][2] += move
    return grid_of(VTK_HEXAHEDRON, corners, [range(8), range(4, 12)])

print("cube:", volumes(prism([(0, 0), (1, 0), (1, 1), (0, 1)])))
print("angle:", volumes(prism([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])))
for move in 0, 0.5, -0.5:
    print(f"box of volume 2, corner moved by {move}:", volumes(box(move)))
P
diff output - <<'P'
cube: cells [1.0], integral of 1: 1.0
angle: cells [3.5], integral of 1: 3.5
box of volume 2, corner moved by 0: cells [1.0, 1.0], integral of 1: 2.0
box of volume 2, corner moved by 0.5: cells [1.1667, 0.9167], integral of 1: 2.0833
box of volume 2, corner moved by -0.5: cells [0.8333, 1.0833], integral of 1: 1.9167
P
