#!/bin/bash
# Gmsh and meshio: coordinates of a Nastran file
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3, python3-meshio=7.0.0-3.
# Guess: `gmsh -save` writes a .bdf with enough digits for the mesh, and meshio reads it.
# Seen: fields are the small ones of 8 characters: 1000.123456789 becomes 1000.123 and -1000.123456789 becomes -1000.12.
#   meshio refuses the file, since Gmsh writes no BEGIN BULK. The free format (Mesh.BdfFieldFormat = 0) has the same digits,
#   the large one (2) has 9 of its 16.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3 python3-meshio=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.geo <<'E'
Point(1) = {1000.123456789, 0, 0};
Point(2) = {-1000.123456789, 0, 0};
Point(3) = {0, 1000, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
Mesh.MeshSizeMin = 9000;
Mesh.MeshSizeMax = 9000;
E
gmsh -v 1 a.geo -2 -o small.bdf >/dev/null
gmsh -v 1 a.geo -2 -setnumber Mesh.BdfFieldFormat 0 -o free.bdf >/dev/null
gmsh -v 1 a.geo -2 -setnumber Mesh.BdfFieldFormat 2 -o large.bdf >/dev/null
{
    grep -h -m2 GRID small.bdf free.bdf large.bdf
    /usr/bin/python3 -c 'import meshio; meshio.read("small.bdf")' 2>&1 | tail -n 1 || true
} | tee output
diff -b output - <<'E'
GRID    1       0       1000.1230.00E+000.00E+00
GRID    2       0       -1000.120.00E+000.00E+00
GRID,1,0,1000.123,0.00E+00,0.00E+00
GRID,2,0,-1000.12,0.00E+00,0.00E+00
GRID*   1               0               1000.12346      0
GRID*   2               0               -1000.12346     0
RuntimeError: "BEGIN BULK" statement not found
E
