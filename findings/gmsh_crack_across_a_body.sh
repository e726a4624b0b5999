#!/bin/bash
# Gmsh: Plugin(Crack) along a line that goes through a body from side to side
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3.
# Guess: a crack that crosses the whole body parts it in two.
# Seen: the two points where the crack meets the outside are not doubled. Both halves stay joined by them, as at hinges, until
#   these points are a physical group that OpenBoundaryPhysicalGroup names.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > parts.py <<'E'
import sys
lines = iter(open("a.msh").read().split("\n"))
nodes, triangles, parent = {}, [], {}
for line in lines:
    if line == "$Nodes":
        for _ in range(int(next(lines))):
            tag, *x = next(lines).split()
            nodes[tag] = [float(v) for v in x]
    if line == "$Elements":
        for _ in range(int(next(lines))):
            words = next(lines).split()
            if words[1] == "2":
                triangles.append(words[-3:])
def root(node):
    while parent.setdefault(node, node) != node:
        node = parent[node]
    return node
for a, b, c in triangles:
    parent[root(a)] = root(b)
    parent[root(c)] = root(b)
used = {node for triangle in triangles for node in triangle}
on_cut = sorted(nodes[node][0] for node in used if abs(nodes[node][1] - 1) < 1e-9)
print(f"{sys.argv[1]}: {len({root(node) for node in used})} part(s) that share no point, points on the cut at x =", *(f"{x:.2f}" for x in on_cut))
E
for rim in "" "Plugin(Crack).OpenBoundaryPhysicalGroup = 3;"; do
    cat > a.geo <<E
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Rectangle(2) = {0, 1, 0, 1, 1};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Mesh.MeshSizeMax = 0.25;
Mesh.MeshSizeMin = 0.25;
Physical Surface("body", 1) = {1, 2};
cut() = Curve In BoundingBox {-0.1, 0.9, -0.1, 1.1, 1.1, 0.1};
Physical Curve("cut", 2) = {cut()};
rim() = Point In BoundingBox {-0.1, 0.9, -0.1, 1.1, 1.1, 0.1};
Physical Point("rim", 3) = {rim()};
Mesh 2;
Plugin(Crack).Dimension = 1;
Plugin(Crack).PhysicalGroup = 2;
$rim
Plugin(Crack).Run;
Mesh.MshFileVersion = 2.2;
Save "a.msh";
E
    gmsh -v 1 a.geo - >/dev/null
    python3 parts.py "${rim:-without a rim}"
done | tee output
diff output - <<'E'
without a rim: 1 part(s) that share no point, points on the cut at x = 0.00 0.25 0.25 0.50 0.50 0.75 0.75 1.00
Plugin(Crack).OpenBoundaryPhysicalGroup = 3;: 2 part(s) that share no point, points on the cut at x = 0.00 0.00 0.25 0.25 0.50 0.50 0.75 0.75 1.00 1.00
E
