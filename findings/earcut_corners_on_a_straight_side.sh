#!/bin/bash
# Earcut: a face with a hole, cut into triangles
# Packages of Debian 12: python3-mapbox-earcut=1.0.1-2+b1. Needs the python3 of Debian with numpy.
# Guess: every corner of the face is a corner of a triangle, also where three lie on a line, so that triangles of neighbouring faces share
#   their edges: a square of 16 edges without a hole has 14 triangles, with a hole of 4 edges it has 20.
# Seen: without the hole there are 14. With the hole there are 8, and 11 of the 12 corners that lie on straight sides are in none of them. The
#   area is right, which tells nothing: a body whose faces are cut so has gaps in its surface, since its sides have these corners.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-mapbox-earcut=1.0.1-2+b1
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"

/usr/bin/python3 - <<'P' | tee output
import numpy as np
import mapbox_earcut as earcut

def report(name, points, ends):
    points = np.array(points)
    triangles = earcut.triangulate_float64(points, np.array(ends, np.uint32)).reshape(-1, 3)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    area = np.abs(np.cross(b - a, c - a)).sum() / 2
    print(f"{name}: {len(triangles)} triangles, area {area:g}, {len(points) - len(np.unique(triangles))} corners in none")

steps = [i / 4 for i in range(4)]
square = [(t, 0) for t in steps] + [(1, t) for t in steps] + [(1 - t, 1) for t in steps] + [(0, 1 - t) for t in steps]
hole = [(0.25, 0.25), (0.25, 0.75), (0.75, 0.75), (0.75, 0.25)]
report("square of 16 edges", square, [16])
report("with a hole of 4", square + hole, [16, 20])
report("square of 4 edges with the hole", square[::4] + hole, [4, 8])
P
diff output - <<'P'
square of 16 edges: 14 triangles, area 1, 0 corners in none
with a hole of 4: 8 triangles, area 0.75, 11 corners in none
square of 4 edges with the hole: 8 triangles, area 0.75, 0 corners in none
P
