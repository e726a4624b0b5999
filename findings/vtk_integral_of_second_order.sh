#!/bin/bash
# VTK: the integral of a field over one cell of second order
# Packages of Debian 12: python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1. Needs the python3 of Debian.
# Guess: vtkIntegrateAttributes integrates what such a cell holds. x^2, which it holds exactly, gives 1/3 for the unit cube of 20 nodes,
#   1/60 for the tetrahedron of 10 and 1/12 for the triangle of 6 nodes.
# Seen: 0.375, 0.0234 and 0.1042, which is 13, 41 and 25 % too much: the cell is cut into linear simplices, of which each gives its size
#   times the mean value of its corners. Of x the integrals are right. An energy of cells of second order is wrong by as much, in silence.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' 2>&1 | tee output
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkQuadraticHexahedron, vtkQuadraticTetra, vtkQuadraticTriangle, vtkUnstructuredGrid
from vtkmodules.vtkFiltersParallel import vtkIntegrateAttributes

def one_cell(cell):  # the cell in its place of reference, with the values of x and of x^2
    places, grid, points = cell.GetParametricCoords(), vtkUnstructuredGrid(), vtkPoints()
    points.SetDataType(VTK_DOUBLE)
    count = cell.GetNumberOfPoints()
    fields = vtkDoubleArray(), vtkDoubleArray()
    for i in range(count):
        points.InsertNextPoint(places[3 * i:3 * i + 3])
        for power, field in enumerate(fields, 1):
            field.InsertNextValue(places[3 * i] ** power)
    grid.SetPoints(points)
    for name, field in zip(("x", "x^2"), fields):
        field.SetName(name)
        grid.GetPointData().AddArray(field)
    grid.InsertNextCell(cell.GetCellType(), count, list(range(count)))
    return grid

for cell, size in (vtkQuadraticHexahedron(), "Volume"), (vtkQuadraticTetra(), "Volume"), (vtkQuadraticTriangle(), "Area"):
    integral = vtkIntegrateAttributes()
    integral.SetInputData(one_cell(cell))
    integral.Update()
    found = integral.GetOutput()
    print(cell.GetClassName(), "size %.4f," % found.GetCellData().GetArray(size).GetValue(0),
          ", ".join("%s %.4f" % (name, found.GetPointData().GetArray(name).GetValue(0)) for name in ("x", "x^2")))
P
diff output - <<'P'
vtkQuadraticHexahedron size 1.0000, x 0.5000, x^2 0.3750
vtkQuadraticTetra size 0.1667, x 0.0417, x^2 0.0234
vtkQuadraticTriangle size 0.5000, x 0.1667, x^2 0.1042
P
