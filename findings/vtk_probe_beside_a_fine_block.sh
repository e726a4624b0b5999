#!/bin/bash
# VTK: values of points inside a coarse block that lies beside a finer one
# Packages of Debian 12: python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1. Needs the python3 of Debian with numpy.
# Guess: vtkProbeFilter finds the cell of each point that lies inside one, on whatever mesh: of two blocks in contact that do not share
#   their nodes, a point 0.2 m deep in the coarse one has a value.
# Seen: it starts at the nearest node and walks from cell to cell. Where that node is of the other block, the walk ends at the surface: the
#   mask of the point is 0 and its value is 0. This takes 431 of 1,000 points of a cube of one cell beside one of 2x2x2, 573 beside
#   12x12x12, without a word. vtkCellLocatorStrategy finds all of them. Beside a block of one cell none is lost.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' 2>&1 | tee output
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_DOUBLE, vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkCellLocatorStrategy, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkProbeFilter

def points_of(places):
    points = vtkPoints()
    points.SetDataType(VTK_DOUBLE)
    for place in places:
        points.InsertNextPoint(place)
    return points

def block(n, bottom):  # a unit cube of n x n x n cells: places of its nodes, nodes of its cells
    x = np.linspace(0, 1, n + 1)
    places = [(a, b, bottom + c) for c in x for b in x for a in x]
    node = lambda i, j, k: (k * (n + 1) + j) * (n + 1) + i
    square = lambda i, j, k: [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
    return places, [square(i, j, k) + square(i, j, k + 1) for k in range(n) for j in range(n) for i in range(n)]

def two_blocks(n):  # one cell from height 0 to 1, n x n x n cells from 1 to 2; the value of each cell is 7
    (below, cells_below), (above, cells_above) = block(1, 0), block(n, 1)
    grid, values = vtkUnstructuredGrid(), vtkDoubleArray()
    grid.SetPoints(points_of(below + above))
    grid.Allocate(1)
    values.SetName("value")
    for cell in cells_below + [[node + len(below) for node in cell] for cell in cells_above]:
        grid.InsertNextCell(VTK_HEXAHEDRON, 8, cell)
        values.InsertNextValue(7)
    grid.GetCellData().AddArray(values)
    return grid

inside = vtkPolyData()
inside.SetPoints(points_of(np.random.default_rng(0).random((1000, 3))))
for n in 1, 2, 12:
    for strategy in None, vtkCellLocatorStrategy():
        probe = vtkProbeFilter()
        probe.SetInputData(inside)
        probe.SetSourceData(two_blocks(n))
        probe.SetFindCellStrategy(strategy)
        probe.Update()
        found = probe.GetOutput().GetPointData()
        mask, value = (vtk_to_numpy(found.GetArray(name)) for name in ("vtkValidPointMask", "value"))
        assert np.array_equal(value, 7.0 * mask)
        print(f"beside {n}x{n}x{n} cells, {'by a locator' if strategy else 'as it is'}: {np.sum(mask == 0)} of {len(mask)} points have no value")
P
diff output - <<'P'
beside 1x1x1 cells, as it is: 0 of 1000 points have no value
beside 1x1x1 cells, by a locator: 0 of 1000 points have no value
beside 2x2x2 cells, as it is: 431 of 1000 points have no value
beside 2x2x2 cells, by a locator: 0 of 1000 points have no value
beside 12x12x12 cells, as it is: 573 of 1000 points have no value
beside 12x12x12 cells, by a locator: 0 of 1000 points have no value
P
