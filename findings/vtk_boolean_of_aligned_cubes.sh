#!/bin/bash
# VTK: boolean operations of cubes whose sides lie in common planes
# Packages of Debian 12: python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1.
# Guess: vtkBooleanOperationPolyDataFilter gives union and intersection of two closed surfaces, and where sides lie in one plane
#   it gives them too, or an error.
# Seen: unit cubes shifted along three axes by (0.5, 0.3, 0.2) have the volumes 1.72 and 0.28 of theory. Shifted along one axis
#   by 0.5 they have 1.07 and 0.83 for 1.5 and 0.5, by 0.9 they have 1.28 and 0.66 for 1.9 and 0.1, and no event of an error
#   is sent.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.py <<'E'
import vtk
def cube(x, y, z):
    source, triangles = vtk.vtkCubeSource(), vtk.vtkTriangleFilter()
    source.SetCenter(x, y, z)
    triangles.SetInputConnection(source.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()
errors = []
def volume(shift, operation):
    both, triangles, mass = vtk.vtkBooleanOperationPolyDataFilter(), vtk.vtkTriangleFilter(), vtk.vtkMassProperties()
    for filter_ in (both, triangles, mass):
        filter_.AddObserver("ErrorEvent", lambda *_: errors.append(shift))
    both.SetOperation(operation)
    both.SetInputData(0, cube(0, 0, 0))
    both.SetInputData(1, cube(*shift))
    triangles.SetInputConnection(both.GetOutputPort())
    mass.SetInputConnection(triangles.GetOutputPort())
    mass.Update()
    return mass.GetVolume()
for shift in ((0.5, 0.3, 0.2), (0.5, 0, 0), (0.9, 0, 0)):
    print(f"{shift}: union {volume(shift, 0):.2f}, intersection {volume(shift, 1):.2f}")
print(f"errors: {len(errors)}")
E
python3 a.py | tee output
diff output - <<'E'
(0.5, 0.3, 0.2): union 1.72, intersection 0.28
(0.5, 0, 0): union 1.07, intersection 0.83
(0.9, 0, 0): union 1.28, intersection 0.66
errors: 0
E
