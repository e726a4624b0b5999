#!/bin/bash
# VTK: gradients and nodal values of a mesh whose boundary triangles stand in the same grid, as a mesh of Gmsh with groups has them
# Packages of Debian 12: python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1. Needs the python3 of Debian with numpy.
# Guess: vtkGradientFilter gives the gradient of a linear field exactly at each node. vtkCellDataToPointData gives a value that all
#   tetrahedra have to each node. Triangles of the boundary, whose own values are 0, change neither.
# Seen: at a node the mean over all cells is taken, triangles like tetrahedra. The gradient of 2 z across the boundary is 1 to 1.5 in place of
#   2, and a stress of 5 in the tetrahedra is 2.5 to 3.75 at the boundary. SetContributingCellOption(2) counts the tetrahedra alone. It cures
#   the gradient, and leaves the nodal stress without any entry. Boundary triangles have to be taken out before.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' 2>&1 | tee output
from itertools import permutations
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkCellDataToPointData
from vtkmodules.vtkFiltersGeneral import vtkGradientFilter

corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
floor_and_top = (0, 3, 1), (0, 2, 3), (4, 5, 7), (4, 7, 6)

def field(name, values):
    array = vtkDoubleArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    return array

def cube(triangles):  # six tetrahedra around a diagonal, with the nodal field 2 z and a stress of 5 in them
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    for corner in corners:
        points.InsertNextPoint(corner)
    grid.SetPoints(points)
    for a, b, _ in permutations((1, 2, 4)):
        grid.InsertNextCell(VTK_TETRA, 4, [0, a, a + b, 7])
    for triangle in triangles:
        grid.InsertNextCell(VTK_TRIANGLE, 3, triangle)
    grid.GetPointData().AddArray(field("height", [2.0 * z for _, _, z in corners]))
    grid.GetCellData().AddArray(field("stress", [5.0] * 6 + [0.0] * len(triangles)))
    return grid

def span(filter_, grid, option, name, component):
    filter_.SetInputData(grid)
    filter_.SetContributingCellOption(option)
    filter_.Update()
    array = filter_.GetOutput().GetPointData().GetArray(name)
    values = [array.GetComponent(i, component) for i in range(array.GetNumberOfTuples())]
    return "%g to %g" % (min(values), max(values)) if values else "none"

def report(name, triangles, option):
    gradient = vtkGradientFilter()
    gradient.SetInputScalars(0, "height")
    print(f"{name}: gradient {span(gradient, cube(triangles), option, 'Gradients', 2)},",
          f"stress {span(vtkCellDataToPointData(), cube(triangles), option, 'stress', 0)}")

assert vtkGradientFilter().GetContributingCellOption() == 0 == vtkCellDataToPointData().GetContributingCellOption()
report("tetrahedra", (), 0)
report("and triangles", floor_and_top, 0)
report("and triangles, option 2", floor_and_top, 2)
P
diff output - <<'P'
tetrahedra: gradient 2 to 2, stress 5 to 5
and triangles: gradient 1 to 1.5, stress 2.5 to 3.75
and triangles, option 2: gradient 2 to 2, stress none
P
