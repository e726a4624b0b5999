#!/bin/bash
# SciPy (Qhull): a Delaunay mesh of the points of a regular grid, and the faces of a convex hull
# Packages of Debian 12: python3-scipy=1.10.1-2. Needs the python3 of Debian with numpy.
# Guess: Delaunay of 5x5x5 points fills the cube with tetrahedra of positive volume, in one sense of rotation, or leaves some points
#   out; triangles of ConvexHull face outwards, as its equations do.
# Seen: the cube is filled, and no face is used by more than two cells. But many tetrahedra have a volume of exactly 0: their corners lie in
#   one plane, so that a stable time step is 0. Half of the others are turned over. The triangles of the hull face either way: the
#   volume that those of a cube enclose is 0.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-scipy=1.10.1-2
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"

/usr/bin/python3 - <<'P' | tee output
from collections import Counter
from itertools import combinations, product
import numpy as np
from scipy.spatial import ConvexHull, Delaunay

points = np.array(list(product(range(5), repeat=3)), float)
cells = Delaunay(points).simplices
corner = points[cells]
volume = np.round(np.linalg.det(corner[:, 1:] - corner[:, :1])) / 6  # whole numbers, since coordinates are
used = Counter(face for cell in cells for face in combinations(sorted(cell), 3))
flat, turned = np.mean(volume == 0), np.mean(volume[volume != 0] < 0)
print(f"grid: volume {np.sum(abs(volume)):g}, a face is used {max(used.values())} times at most, all points used: {len(np.unique(cells)) == 125}")
print(f"of its cells more than a tenth flat: {flat > 0.1}; of the others more than a third turned over: {1 / 3 < turned < 2 / 3}")
hull = ConvexHull(np.array(list(product((0, 1), repeat=3)), float))
face = hull.points[hull.simplices]
print(f"hull of a cube: volume {hull.volume:g}, enclosed by its {len(face)} triangles: {np.linalg.det(face).sum() / 6:g}")
P
diff output - <<'P'
grid: volume 64, a face is used 2 times at most, all points used: True
of its cells more than a tenth flat: True; of the others more than a third turned over: True
hull of a cube: volume 1, enclosed by its 12 triangles: 0
P
