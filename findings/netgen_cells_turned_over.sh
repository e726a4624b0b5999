#!/bin/bash
# Netgen: which way tetrahedra are turned in the files that it exports
# Packages of Debian 12: python3-netgen=6.2.2006+really6.2.1905+dfsg-5.1+b1, netgen of the same version, libtogl2=2.0-1.1. Needs the
#   python3 of Debian with numpy.
# Guess: an export brings cells into the order of the format it writes: volumes are positive in a file for Gmsh as in one for Abaqus.
# Seen: in the file for Abaqus the volume of a unit cube is +1. In both formats for Gmsh and in the neutral one all cells have
#   negative volumes, as in Netgen itself. Their triangles face outwards. What sums volumes of the cells gets -1.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-netgen=6.2.2006+really6.2.1905+dfsg-5.1+b1 netgen=6.2.2006+really6.2.1905+dfsg-5.1+b1 libtogl2=2.0-1.1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > cube.py <<'P'
from netgen.csg import CSGeometry, OrthoBrick, Pnt
geometry = CSGeometry()
geometry.Add(OrthoBrick(Pnt(0, 0, 1), Pnt(1, 1, 2)))
mesh = geometry.GenerateMesh(maxh=0.5)
for kind, name in ("Abaqus", "inp"), ("Gmsh", "msh1"), ("Gmsh2", "msh2"), ("Neutral", "neutral"):
    mesh.Export("cube." + name, kind + " Format")
P
/usr/bin/python3 cube.py > /dev/null
cat > volumes.py <<'P'
import numpy as np

def blocks(name):  # lists of rows of numbers between lines of words
    found = [[]]
    for line in open("cube." + name):
        words = line.replace(",", " ").split()
        try:
            found[-1].append([float(word) for word in words])
        except ValueError:
            found.append([])
    return [block for block in found if len(block) > 1]

def show(name, points, cells, faces):
    x = np.array(points)
    corner, face = (x[np.array(ids, int) - 1] for ids in (cells, faces))
    volume = np.linalg.det(corner[:, 1:] - corner[:, :1]) / 6
    enclosed = f", its triangles enclose {np.linalg.det(face).sum() / 6:.3f}" if len(faces) else ""
    print(f"{name}: volume {volume.sum():.3f}, all cells one way: {len(set(np.sign(volume))) == 1}{enclosed}")

nodes, cells = blocks("inp")[:2]
show("Abaqus", [row[1:] for row in nodes], [row[1:] for row in cells], np.empty((0, 3)))
nodes, elements = blocks("msh1")  # number, type, group, entity, number of nodes, nodes
show("Gmsh", [row[1:] for row in nodes[1:]], [r[5:] for r in elements[1:] if r[1] == 4], [r[5:] for r in elements[1:] if r[1] == 2])
nodes, elements = blocks("msh2")[-2:]  # number, type, number of tags, tags, nodes
show("Gmsh2", [row[1:] for row in nodes[1:]], [r[-4:] for r in elements[1:] if r[1] == 4], [r[-3:] for r in elements[1:] if r[1] == 2])
rows, lists = blocks("neutral")[0], []  # each list begins with its length
while rows:
    n = int(rows[0][0])
    lists, rows = lists + [rows[1:n + 1]], rows[n + 1:]
show("Neutral", lists[0], [row[1:] for row in lists[1]], [row[1:] for row in lists[2]])
P
env -u LD_LIBRARY_PATH -u PYTHONPATH /usr/bin/python3 volumes.py | tee output
diff output - <<'P'
Abaqus: volume 1.000, all cells one way: True
Gmsh: volume -1.000, all cells one way: True, its triangles enclose 1.000
Gmsh2: volume -1.000, all cells one way: True, its triangles enclose 1.000
Neutral: volume -1.000, all cells one way: True, its triangles enclose 1.000
P
