#!/bin/bash
# meshio and CGNS: is a .cgns file of meshio a CGNS file?
# Packages of Debian 12: python3-meshio=7.0.0-3, cgns-convert=3.4.0-3, libcgns3.4=3.4.0-3. Needs python3-h5py.
# Guess: cgnscheck of the CGNS library reads a .cgns file that meshio wrote, with some warnings at most.
# Seen: it cannot open it: a node attribute that every CGNS file in HDF5 has is missing. Only meshio reads the file.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-meshio=7.0.0-3 cgns-convert=3.4.0-3 libcgns3.4=3.4.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

/usr/bin/python3 - <<'E' 2>/dev/null
import meshio
mesh = meshio.Mesh([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [("tetra", [[0, 1, 2, 3]])])
meshio.write("a.cgns", mesh)
print("meshio reads", len(meshio.read("a.cgns").points), "points")
E
{ cgnscheck a.cgns 2>&1 || true; } | grep ERROR | tee output
diff output - <<'E'
CGNSlib ERROR:cg_open:cgio_get_label:Node attribute doesn't exist
E
