#!/bin/bash
# GetFEM and Gmsh: numbers of regions
# Packages of Debian 12: python3-getfem=5.4.2+dfsg1-3+b1, libgetfem5=5.4.2+dfsg1-3+b1, gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3.
# Guess: Mesh('import', 'gmsh', file) has the regions 1, 2 (volumes) and 3, 4 (faces), which are the physical numbers,
#   whichever format Gmsh wrote.
# Seen: so it is with format 2.2. With 4.1 regions are the numbers of entities (faces 1 and 8), and since volume 1 and face 1
#   collide, the volume becomes region 6: scripts that hold region 3 hold nothing, or something else.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-getfem=5.4.2+dfsg1-3+b1 libgetfem5=5.4.2+dfsg1-3+b1 gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3
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
for version in 22 41; do
    gmsh -v 1 two.msh -save -format msh$version -o a.msh
    /usr/bin/python3 - $version <<'E'
import sys, getfem
mesh = getfem.Mesh("import", "gmsh", "a.msh")
print("format", sys.argv[1], {int(r): "faces" if mesh.region(r)[1].min() < 60000 else "volumes" for r in mesh.regions()})
E
done 2>/dev/null | grep format | tee output
diff output - <<'E'
format 22 {1: 'volumes', 2: 'volumes', 3: 'faces', 4: 'faces'}
format 41 {1: 'faces', 2: 'volumes', 6: 'volumes', 8: 'faces'}
E
