#!/bin/bash
# OpenVDB: a surface that is turned into a level set and back, and one whose top is missing
# Packages of Debian 12: python3-openvdb=10.0.1-2 and what it needs. Needs the python3 of Debian with numpy.
# Guess: convertToQuads gives back a cube whose faces face outwards, as those faced that were put in. A box without its top is refused, or
#   filled somehow.
# Seen: all faces come back facing inwards: the volume that they enclose is -1, whichever way the input faced. What pushes along their
#   normals pulls. The open box becomes a shell of two walls round its five sides, and the middle of it is as far outside as a point 2 m
#   away: no error is raised, and the shell is a closed surface, of a hundredth of the volume.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-openvdb=10.0.1-2
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

/usr/bin/python3 - <<'P' | tee output
import numpy as np
import pyopenvdb

corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], np.float32)
outwards = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)], np.uint32)
width = 0.05

def volume(points, squares):
    a, b, c = (points[np.vstack([squares[:, [0, 1, 2]], squares[:, [0, 2, 3]]]).astype(int)][:, i].astype(float) for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6

for name, squares in ("outwards", outwards), ("inwards", outwards[:, ::-1]), ("without top", outwards[:5]):
    grid = pyopenvdb.FloatGrid.createLevelSetFromPolygons(corners, quads=np.ascontiguousarray(squares),
                                                          transform=pyopenvdb.createLinearTransform(voxelSize=width))
    at = lambda x, y, z: grid.getConstAccessor().getValue(tuple(round(c / width) for c in (x, y, z)))
    print(f"{name}: volume put in {volume(corners, squares):.2f}, got back {volume(*grid.convertToQuads()):.2f}; "
          f"distance at the middle {at(0.5, 0.5, 0.5):.2f}, 2 m away {at(0.5, 0.5, 3):.2f}")
P
diff output - <<'P'
outwards: volume put in 1.00, got back -1.00; distance at the middle -0.15, 2 m away 0.15
inwards: volume put in -1.00, got back -1.00; distance at the middle -0.15, 2 m away 0.15
without top: volume put in 0.67, got back -0.01; distance at the middle 0.15, 2 m away 0.15
P
