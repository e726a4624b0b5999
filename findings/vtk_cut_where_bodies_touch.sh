#!/bin/bash
# VTK: a cut through the plane where two bodies touch, and through the bottom and the top of a body
# Packages of Debian 12: python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1. Needs the python3 of Debian with numpy.
# Guess: vtkCutter at the height where faces of cells lie gives the section of both bodies, area 2 for unit cubes, or nothing at all;
#   bottom and top of a body are alike.
# Seen: a node on the plane counts as above it, so that only cells below are cut: the section of the interface is that of the lower body
#   alone, its values included, and it is the one of the other body where the normal is turned over. A cut at the bottom of a body is empty,
#   and one at its top has the whole area. vtkPlaneCutter does the same.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' 2>&1 | tee output
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkPlane, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCutter, vtkPlaneCutter
from vtkmodules.vtkFiltersParallel import vtkIntegrateAttributes

square = ((0, 0), (1, 0), (1, 1), (0, 1))
grid, points, bodies = vtkUnstructuredGrid(), vtkPoints(), vtkDoubleArray()
points.SetDataType(VTK_DOUBLE)
bodies.SetName("body")
grid.Allocate(2)
for body in 1, 2:  # unit cubes that stand on each other, with nodes of their own
    for z in body - 1, body:
        for x, y in square:
            points.InsertNextPoint(x, y, z)
    grid.InsertNextCell(VTK_HEXAHEDRON, 8, list(range(8 * body - 8, 8 * body)))
    bodies.InsertNextValue(body)
grid.SetPoints(points)
grid.GetCellData().AddArray(bodies)

def leaves(data):  # the surfaces of which an output is made
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    found, walk = [], data.NewIterator()
    walk.InitTraversal()
    while not walk.IsDoneWithTraversal():
        found.append(walk.GetCurrentDataObject())
        walk.GoToNextItem()
    return found

def section(kind, height, up):
    plane, cut, whole, integral = vtkPlane(), kind(), vtkAppendPolyData(), vtkIntegrateAttributes()
    plane.SetOrigin(0, 0, height)
    plane.SetNormal(0, 0, up)
    cut.SetInputData(grid)
    cut.SetPlane(plane) if kind is vtkPlaneCutter else cut.SetCutFunction(plane)
    cut.Update()
    for leaf in leaves(cut.GetOutputDataObject(0)):
        whole.AddInputData(leaf)
    whole.Update()
    integral.SetInputData(whole.GetOutput())
    integral.Update()
    area, body = (data.GetCellData().GetArray(name) for data, name in ((integral.GetOutput(), "Area"), (whole.GetOutput(), "body")))
    return f"{area.GetValue(0):.2f} of {sorted(set(vtk_to_numpy(body)))}" if area and body else "nothing"

for kind in vtkCutter, vtkPlaneCutter:
    for up in 1, -1:
        print(f"{kind.__name__}, normal {up}:", ", ".join(f"{z} m: {section(kind, z, up)}" for z in (0, 0.5, 1, 1.5, 2)))
P
diff output - <<'P'
vtkCutter, normal 1: 0 m: nothing, 0.5 m: 1.00 of [1.0], 1 m: 1.00 of [1.0], 1.5 m: 1.00 of [2.0], 2 m: 1.00 of [2.0]
vtkCutter, normal -1: 0 m: 1.00 of [1.0], 0.5 m: 1.00 of [1.0], 1 m: 1.00 of [2.0], 1.5 m: 1.00 of [2.0], 2 m: nothing
vtkPlaneCutter, normal 1: 0 m: nothing, 0.5 m: 1.00 of [1.0], 1 m: 1.00 of [1.0], 1.5 m: 1.00 of [2.0], 2 m: 1.00 of [2.0]
vtkPlaneCutter, normal -1: 0 m: 1.00 of [1.0], 0.5 m: 1.00 of [1.0], 1 m: 1.00 of [2.0], 1.5 m: 1.00 of [2.0], 2 m: nothing
P
