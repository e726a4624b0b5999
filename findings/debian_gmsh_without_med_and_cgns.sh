#!/bin/bash
# Gmsh of Debian 12: formats that its manual lists and it lacks
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3.
# Guess: `gmsh part.med -save -o part.msh` converts meshes of Salome, and .cgns those of CFD, as the manual lists both.
# Seen: this build has neither: it says so and ends with status 1. meshio reads .med with its groups.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > two.geo <<'E'
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {2, 0, 0, 1, 1, 1};
Physical Volume("left") = {1};
Physical Volume("right") = {2};
Physical Surface("foot") = {1};
Physical Surface("head") = {8};
Mesh.MeshSizeMin = 0.5;
Mesh.MeshSizeMax = 0.5;
E
gmsh -v 1 two.geo -3 -o two.msh >/dev/null
for kind in med cgns; do
    gmsh -v 1 two.msh -save -o two.$kind 2>&1 | tr -s ' ' || true
done | sed 's/ .two.med.//; s/write.*/write/' | tee output
diff output - <<'E'
Error : Gmsh must be compiled with MED support to write
Error : This version of Gmsh was compiled without CGNS support
E
