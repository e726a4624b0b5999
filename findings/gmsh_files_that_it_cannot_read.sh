#!/bin/bash
# Gmsh: which files that it writes it reads again, and with which names
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3.
# Guess: what `gmsh -save` writes, `gmsh` opens; .inp, .unv and .bdf keep physical groups, and names where the format has
#   them.
# Seen: of seven formats, .inp, .su2 and .key are not read (a syntax error of Gmsh's own script language, in which files of
#   unknown kind are read); .bdf, .mesh and .vtk come back without groups, and .unv alone with the four names.
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
for kind in unv bdf mesh vtk inp su2 key; do
    gmsh -v 1 two.msh -save -o two.$kind
    rm -f back.msh
    gmsh -v 0 two.$kind -save -format msh41 -o back.msh >/dev/null 2>&1 || true
    names=$(sed -n '/\$PhysicalNames/,/\$End/p' back.msh 2>/dev/null | grep -c '"' || true)
    nodes=$(sed -n '/\$Nodes/{n;p}' back.msh 2>/dev/null | cut -d' ' -f2)
    echo "$kind: ${nodes:-0} nodes, $names names"
done | tee output
diff output - <<'E'
unv: 90 nodes, 4 names
bdf: 90 nodes, 0 names
mesh: 90 nodes, 0 names
vtk: 90 nodes, 0 names
inp: 0 nodes, 0 names
su2: 0 nodes, 0 names
key: 0 nodes, 0 names
E
