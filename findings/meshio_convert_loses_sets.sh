#!/bin/bash
# meshio: what `meshio convert` leaves of the sets of an Abaqus file
# Packages of Debian 12: python3-meshio=7.0.0-3, meshio-tools=7.0.0-3.
# Guess: sets of elements (*ELSET) of an .inp file are kept by name in formats that have groups or fields, and where they
#   cannot be kept a warning says so.
# Seen: no format keeps them. .vtu and .vtk get one array whose name is all names joined by '-' and whose value is the last
#   set that a cell is in (a cell in two sets loses one); .mesh gets the number 1 everywhere; .bdf, .xdmf and .msh get
#   nothing, without a word on the terminal.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-meshio=7.0.0-3 meshio-tools=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.inp <<'E'
*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
5, 1, 1, 1
*ELEMENT, TYPE=C3D4
1, 1, 2, 3, 4
2, 2, 3, 4, 5
*ELSET, ELSET=STONE
1
*ELSET, ELSET=WOOD
2
*ELSET, ELSET=ALL
1, 2
E
for kind in vtu vtk mesh bdf xdmf msh; do
    meshio convert a.inp a.$kind >/dev/null 2>&1
    /usr/bin/python3 - a.$kind <<'E'
import sys, meshio
mesh = meshio.read(sys.argv[1])
data = {name: [a.tolist() for a in arrays] for name, arrays in mesh.cell_data.items() if not name.startswith("gmsh:geom")}
print(sys.argv[1], "sets:", list(mesh.cell_sets), "data:", data)
E
done | grep sets | tee output
diff output - <<'E'
a.vtu sets: [] data: {'STONE-WOOD-ALL': [[2, 2]]}
a.vtk sets: [] data: {'STONE-WOOD-ALL': [[2, 2]]}
a.mesh sets: [] data: {'medit:ref': [[1, 1]]}
a.bdf sets: [] data: {}
a.xdmf sets: [] data: {}
a.msh sets: [] data: {}
E
