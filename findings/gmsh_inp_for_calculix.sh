#!/bin/bash
# Gmsh and CalculiX: boundary groups in an .inp file
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3, calculix-ccx=2.20-1, libspooles2.2=2.2-14, libarpack2=3.8.0-3.
# Guess: CalculiX reads the .inp that `gmsh -save` writes of a solid with named boundary surfaces: sets of elements for the
#   bodies, and something to build a surface or set of nodes of for the groups.
# Seen: the triangles of boundary groups are written as elements of plane stress (CPS3), with which CalculiX stops: a model
#   with such elements must lie in the plane z = 0. Without boundary groups, the same file is solved.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3 calculix-ccx=2.20-1 libspooles2.2=2.2-14 libarpack2=3.8.0-3
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
gmsh -v 1 two.msh -save -o with.inp
sed -i '/Surface("/d' two.geo
gmsh -v 1 two.geo -3 -o without.inp >/dev/null
for name in with without; do
    echo "$name groups: $(grep -c CPS3 $name.inp || true) blocks of CPS3"
    cat >> $name.inp <<'E'
*MATERIAL, NAME=STEEL
*ELASTIC
2e11, 0.3
*SOLID SECTION, ELSET=left, MATERIAL=STEEL
*SOLID SECTION, ELSET=right, MATERIAL=STEEL
*NSET, NSET=HELD
1, 2, 3, 4, 9, 10, 11, 12
*BOUNDARY
HELD, 1, 3
*STEP
*STATIC
*CLOAD
5, 1, 1000.
*NODE FILE
U
*END STEP
E
    ccx $name > log 2>&1 || true
    grep -A4 "ERROR" log | tr -s ' ' || tail -n 4 log | grep -i finished | tr -s ' ' || grep -o "Job finished" log
done | tee output
diff output - <<'E'
with groups: 2 blocks of CPS3
 *ERROR in gen3delem. The structure
 contains plane stress, plane
 strain or axisymmetric
 elements and should lie in 
 the z=0 plane. This is at
without groups: 0 blocks of CPS3
Job finished
E
