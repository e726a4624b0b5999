#!/bin/bash
# meshio: a Gmsh file with groups as .vtu
# Packages of Debian 12: python3-meshio=7.0.0-3, meshio-tools=7.0.0-3, gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3.
# Guess: `meshio convert two.msh two.vtu` works for a file of Gmsh 4.1 with two bodies and two named faces.
# Seen: an IndexError and no file: besides the groups meshio makes a set gmsh:bounding_entities, whose numbers are of entities
#   and not of cells, and takes them for rows of cells. A file in format 2.2 is converted. python3-meshio 7.0.0-3 calls itself
#   5.0.0.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-meshio=7.0.0-3 meshio-tools=7.0.0-3 gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3
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
gmsh -v 1 two.msh -save -format msh22 -o old.msh
{
    meshio --version | head -n 1 | cut -d' ' -f1,2
    for name in two old; do
        meshio convert $name.msh $name.vtu 2>&1 | grep -o "IndexError.*" | sed 's/[0-9][0-9]*/N/g' || true
        test -e $name.vtu && echo "$name.vtu written" || echo "$name.vtu is not there"
    done
} | tee output
diff output - <<'E'
meshio 5.0.0
IndexError: index N is out of bounds for axis N with size N
two.vtu is not there
old.vtu written
E
