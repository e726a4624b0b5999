#!/bin/bash
# Gmsh: how the faces of an extruded block are turned, in the STL and in the groups of its mesh
# Packages of Debian 12: gmsh=4.8.4+ds2-3, libgmsh4.8=4.8.4+ds2-3. Needs python3.
# Guess: the boundary of a volume that is meshed faces outwards in the file, or inwards all over, as Gmsh knows the volume.
# Seen: the face that was extruded faces inwards, and all others outwards, for the kernel of Gmsh and for OpenCASCADE. The area vectors of
#   bottom and top are both +1, and the STL of a block of volume 1 from height 1 to 2 encloses 1.667. A pressure on both faces pushes
#   the block away. With `ReverseMesh Surface{1};` all face outwards.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gmsh=4.8.4+ds2-3 libgmsh4.8=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

cat > areas.py <<'P'
import sys

def cross(a, b, c):
    u, v = [[q[i] - a[i] for i in range(3)] for q in (b, c)]
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]

def read_stl(name):
    corners = [[float(x) for x in line.split()[1:]] for line in open(name) if line.split()[0] == "vertex"]
    return list(zip(corners[::3], corners[1::3], corners[2::3]))

def read_msh22(name):  # triangles of each group
    lines = iter(open(name).read().split("\n"))
    points, groups = {}, {}
    for line in lines:
        if line in ("$Nodes", "$Elements"):
            for _ in range(int(next(lines))):
                word = next(lines).split()
                if line == "$Nodes":
                    points[word[0]] = [float(x) for x in word[1:]]
                elif word[1] == "2":
                    groups.setdefault(int(word[3]), []).append([points[i] for i in word[-3:]])
    return groups

name = sys.argv[1]
volume = sum(sum(a[i] * n[i] for i in range(3)) for a, b, c in read_stl(name + ".stl") for n in [cross(a, b, c)]) / 6
upwards = {group: sum(cross(*face)[2] for face in faces) / 2 for group, faces in read_msh22(name + ".msh").items()}
print(f"{name}: STL encloses {volume:.3f}; area vectors upwards: bottom {upwards[2]:.3f}, top {upwards[3]:.3f}")
P
kernel='Point(1) = {0, 0, 1, 0.5}; Point(2) = {1, 0, 1, 0.5}; Point(3) = {1, 1, 1, 0.5}; Point(4) = {0, 1, 1, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};'
extrusion='top[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; };
Physical Volume(1) = {1}; Physical Surface(2) = {1}; Physical Surface(3) = {top[0]}; Physical Surface(4) = {top[{2:5}]};'
printf '%s\n' "$kernel" "$extrusion" > block.geo
printf '%s\n' 'SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 1, 1, 1};' "$extrusion" > occ.geo
printf '%s\n' "$kernel" "$extrusion" 'ReverseMesh Surface{1};' > reversed.geo
for name in block occ reversed; do
    ./usr/bin/gmsh -3 $name.geo -o $name.stl > /dev/null
    ./usr/bin/gmsh -3 $name.geo -format msh22 -o $name.msh > /dev/null
    python3 areas.py $name
done | tee output
diff output - <<'P'
block: STL encloses 1.667; area vectors upwards: bottom 1.000, top 1.000
occ: STL encloses 1.667; area vectors upwards: bottom 1.000, top 1.000
reversed: STL encloses 1.000; area vectors upwards: bottom -1.000, top 1.000
P
