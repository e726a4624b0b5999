#!/bin/bash
# TetGen: which way its cells and its boundary faces are turned
# Packages of Debian 12: tetgen=1.5.0-5, libtet1.5=1.5.0-5. Needs python3 with numpy.
# Guess: cells have positive volumes in the order of VTK and Gmsh, and the triangles of the .face file face outwards, as those
#   of the surface that was read.
# Seen: cells have positive volumes. All triangles of .face face inwards: the volume that they enclose is -1 for a unit cube
#   whose file has its faces outwards.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install tetgen=1.5.0-5 libtet1.5=1.5.0-5
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > cube.off <<'E'
OFF
8 6 0
0 0 0
1 0 0
0 1 0
1 1 0
0 0 1
1 0 1
0 1 1
1 1 1
4 0 2 3 1
4 4 5 7 6
4 0 1 5 4
4 2 6 7 3
4 0 4 6 2
4 1 3 7 5
E
tetgen -pq1.4a0.05 cube.off >/dev/null
cat > a.py <<'E'
import numpy as np
def rows(name):
    lines = [line.split() for line in open(name) if line.strip() and not line.startswith("#")]
    return np.array([[float(word) for word in line] for line in lines[1:]])
points = rows("cube.1.node")
first = int(points[0, 0])
x = points[:, 1:4]
cells = rows("cube.1.ele")[:, 1:5].astype(int) - first
faces = rows("cube.1.face")[:, 1:4].astype(int) - first
volumes = np.linalg.det(x[cells[:, 1:]] - x[cells[:, :1]]) / 6
print(f"cells: volume {volumes.sum():.3f}, negative {(volumes < 0).sum()}")
given = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
given = np.array([[q[0], q[i], q[i + 1]] for q in given for i in (1, 2)])
for name, triangles in (("cube.off", given), ("cube.1.face", faces)):
    inside = np.einsum("ij,ij->i", np.cross(x[triangles[:, 1]] - x[triangles[:, 0]], x[triangles[:, 2]] - x[triangles[:, 0]]),
                       x[triangles[:, 0]] - 0.5) < 0
    print(f"{name}: volume {np.linalg.det(x[triangles]).sum() / 6:.3f}, faces that face inwards: {'all' if inside.all() else inside.sum()}")
E
python3 a.py | tee output
diff output - <<'E'
cells: volume 1.000, negative 0
cube.off: volume 1.000, faces that face inwards: 0
cube.1.face: volume -1.000, faces that face inwards: all
E
