#!/bin/bash
# meshio: an Abaqus set that is made of other sets
# Packages of Debian 12: python3-meshio=7.0.0-3.
# Guess: cell_sets of meshio has one list of cells per block of cells, also for *ELSET, ELSET=BOTH with the names of other
#   sets below it, and sets of nodes likewise.
# Seen: the lists of such a set are by its members in their order, not by block: with the members B, A the cells of block 0
#   are those of B. With one member there is one list, though there are two blocks. A set of nodes made of sets is empty.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-meshio=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

head='*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n6,2,2,2\n'
head+='*ELEMENT,TYPE=C3D4,ELSET=A\n1,1,2,3,4\n*ELEMENT,TYPE=C3D4,ELSET=B\n2,2,3,4,5\n3,3,4,5,6\n*NSET,NSET=N\n1,2\n'
printf "$head*ELSET,ELSET=BOTH\nB\nA\n*NSET,NSET=M\nN\n" > turned.inp
printf "$head*ELSET,ELSET=BOTH\nA\n" > one.inp
for name in turned one; do
    /usr/bin/python3 - $name.inp <<'E'
import sys, numpy, meshio
mesh = meshio.read(sys.argv[1])
print(sys.argv[1], "blocks of", [len(b.data) for b in mesh.cells], "BOTH:", [numpy.asarray(x).tolist() for x in mesh.cell_sets["BOTH"]],
      "nodes:", {name: len(x) for name, x in mesh.point_sets.items()})
E
done 2>/dev/null | tee output
diff output - <<'E'
turned.inp blocks of [1, 2] BOTH: [[0, 1], [0]] nodes: {'N': 2, 'M': 0}
one.inp blocks of [1, 2] BOTH: [[0]] nodes: {'N': 2}
E
