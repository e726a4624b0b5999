#!/bin/bash
# Gmsh: a physical surface that is given with a minus sign
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3.
# Guess: Physical Surface("down") = {-1} turns the triangles of that surface over in the file.
# Seen: in format 2.2 the triangles are turned; in 4.1 they are the same as without the sign, and the sign stands at the
#   group's number in $Entities, where a reader must look for it.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

for sign in "" -; do
    cat > a.geo <<E
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Physical Surface("side") = {${sign}1};
Mesh.MeshSizeMin = 2;
Mesh.MeshSizeMax = 2;
E
    for version in 22 41; do
        gmsh -v 1 a.geo -2 -format msh$version -o a.msh >/dev/null
        last=$(sed -n '/\$Elements/,/\$End/p' a.msh | tail -n 2 | head -n 1 | awk '{print $(NF-2), $(NF-1), $NF}')
        entity=$(sed -n '/\$Entities/,/\$End/p' a.msh | tail -n 2 | head -n 1 | cut -d' ' -f8,9)
        echo "sign '$sign', format $version: triangle $last; groups of the surface: ${entity:-not in this format}"
    done
done | tee output
diff output - <<'E'
sign '', format 22: triangle 4 5 3; groups of the surface: not in this format
sign '', format 41: triangle 4 5 3; groups of the surface: 1 1
sign '-', format 22: triangle 4 3 5; groups of the surface: not in this format
sign '-', format 41: triangle 4 5 3; groups of the surface: 1 -1
E
