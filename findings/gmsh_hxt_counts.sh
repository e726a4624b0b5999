#!/bin/bash
# Gmsh: whether the mesher HXT makes the same cells twice
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3.
# Guess: with one thread and a fixed Mesh.RandomSeed two calls give the same tetrahedra.
# Seen: inside one and the same surface mesh HXT (Mesh.Algorithm3D = 10) makes another number of tetrahedra nearly each time,
#   Delaunay (1) the same each time.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.geo <<'E'
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 1, 1};
Cylinder(2) = {1, 0.5, -1, 0, 0, 3, 0.3};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("all") = {3};
General.NumThreads = 1;
Mesh.RandomSeed = 1;
Mesh.MeshSizeMax = 0.12;
E
for algorithm in 1 10; do
    for _ in $(seq 12); do
        gmsh -v 1 a.geo -3 -nt 1 -setnumber Mesh.Algorithm3D $algorithm -format msh22 -o a.msh >/dev/null
        awk '/\$Elements/ {inside = 1} /\$EndElements/ {inside = 0} inside && $2 == 4 {n++} END {print n}' a.msh
    done | sort -u | wc -l >counts
    echo "algorithm $algorithm: $([ "$(cat counts)" -gt 1 ] && echo "several numbers of tetrahedra" || echo "one number of tetrahedra") in 12 calls"
done | tee output
diff output - <<'E'
algorithm 1: one number of tetrahedra in 12 calls
algorithm 10: several numbers of tetrahedra in 12 calls
E
