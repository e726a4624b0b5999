#!/bin/bash
# Gmsh: the files of a cube that is parted for two ranks with -part 2
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3, python3-meshio=7.0.0-3. Needs the python3 of Debian with numpy.
# Guess: -part gives each cell a number of a part. Cells and groups of the file stay those of the mesh that is not parted.
# Seen: the cut becomes a surface of the model, with triangles and a physical group of its own, and its rim becomes bars. An STL has
#   the cut as a wall inside the closed surface, and an .inp has it as shells (CPS3) and trusses (T3D2) that bear load. With
#   -setnumber Mesh.PartitionCreateTopology 0 they are as before. meshio reads the parted MSH 4.1 in neither case: it ends with a KeyError.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3 python3-meshio=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > cube.geo <<'E'
Point(1) = {0, 0, 0, 0.5}; Point(2) = {1, 0, 0, 0.5}; Point(3) = {1, 1, 0, 0.5}; Point(4) = {0, 1, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
top[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; };
Physical Volume("block") = {1}; Physical Surface("down") = {1}; Physical Surface("up") = {top[0]};
E
count() {  # name, then options of gmsh
    name=$1 && shift
    for format in stl inp msh; do "$work/usr/bin/gmsh" -3 cube.geo "$@" -o "$name.$format" > /dev/null; done
    facets=$(grep -c "facet normal" "$name.stl")
    types=$(sed -n 's/^\*ELEMENT, type=\([^,]*\),.*/\1/p' "$name.inp" | sort -u | paste -sd" ")
    groups=$(sed -n 's/^\*ELSET,ELSET=//p' "$name.inp" | sort | paste -sd" ")
    reads=$(/usr/bin/python3 -c "import meshio; meshio.read('$name.msh')" 2>&1 | grep -o "KeyError" || true)
    echo "$name: $facets facets of STL; .inp: $types; groups $groups; meshio: ${reads:-reads it}"
}
{
    count whole
    count parted -part 2
    count without_topology -part 2 -setnumber Mesh.PartitionCreateTopology 0
} | tee output
diff output - <<'E'
whole: 28 facets of STL; .inp: C3D4 CPS3; groups block down up; meshio: reads it
parted: 44 facets of STL; .inp: C3D4 CPS3 T3D2; groups PhysicalLine2 PhysicalLine3 PhysicalSurface1 block down up; meshio: KeyError
without_topology: 28 facets of STL; .inp: C3D4 CPS3; groups block down up; meshio: KeyError
E
