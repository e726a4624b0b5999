#!/bin/bash
# meshio: faces of an OBJ that count their corners from the last vertex
# Packages of Debian 12: python3-meshio=7.0.0-3. Needs the python3 of Debian with numpy.
# Guess: `f -3 -2 -1` is the face of the three vertices above it, as the format has it, or an error is raised.
# Seen: the numbers come back as -4, -3 and -2 in each face. numpy takes them from the end of all points of the file: of two triangles 5 m
#   apart both become one and the same, 5 m long, between the two. The STL that meshio writes of it has them so, without a word.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-meshio=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > relative.obj <<'O'
v 0 0 0
v 1 0 0
v 0 1 0
f -3 -2 -1
v 0 0 5
v 1 0 5
v 0 1 5
f -3 -2 -1
O
sed '4s/.*/f 1 2 3/; 8s/.*/f 4 5 6/' relative.obj > absolute.obj
/usr/bin/python3 - <<'P' 2>&1 | tee output
import meshio
for name in "absolute", "relative":
    mesh = meshio.read(name + ".obj")
    mesh.write(name + ".stl", file_format="stl", binary=False)
    heights = [float(line.split()[3]) for line in open(name + ".stl") if line.split()[0] == "vertex"]
    print(f"{name}: cells {mesh.cells[0].data.tolist()}; heights of the corners in the STL {heights}")
P
diff output - <<'P'
absolute: cells [[0, 1, 2], [3, 4, 5]]; heights of the corners in the STL [0.0, 0.0, 0.0, 5.0, 5.0, 5.0]
relative: cells [[-4, -3, -2], [-4, -3, -2]]; heights of the corners in the STL [0.0, 5.0, 5.0, 0.0, 5.0, 5.0]
P
