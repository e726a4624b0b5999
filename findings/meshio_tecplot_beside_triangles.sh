#!/bin/bash
# meshio: tetrahedra beside triangles in a Tecplot file
# Packages of Debian 12: python3-meshio=7.0.0-3. Needs python3 with numpy.
# Guess: two tetrahedra and a triangle of their boundary written as .dat are two tetrahedra, and perhaps the triangle, when meshio
#   reads its own file; what is left out is warned of.
# Seen: two hexahedra of 4 different corners each. The triangle is gone, with its values; a warning says so.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-meshio=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > a.py <<'E'
import meshio
import numpy as np
x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1.0]])
tetrahedra, triangle = ("tetra", np.array([[0, 1, 2, 3], [1, 2, 3, 4]])), ("triangle", np.array([[0, 1, 2]]))
for name, cells in (("alone", [tetrahedra]), ("beside", [tetrahedra, triangle])):
    meshio.write(name + ".dat", meshio.Mesh(x, cells))
    read = meshio.read(name + ".dat")
    print(name + ":", ", ".join(f"{len(block.data)} {block.type} of {len(set(block.data[0]))} corners" for block in read.cells))
E
python3 a.py 2>errors | tee output
cat errors >&2
diff output - <<'E'
alone: 2 tetra of 4 corners
beside: 2 hexahedron of 4 corners
E
