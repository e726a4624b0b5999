#!/bin/bash
# GEOS: the area that a triangle shares with itself, where a corner differs in the last bit
# Packages of Debian 12: libgeos-c1v5=3.11.1-1, libgeos3.11.1=3.11.1-1, python3-shapely=1.8.5-2+b1. Needs python3.
# Guess: the overlay of GEOS 3.11 is robust. The area is that of the triangle, up to roundings.
# Seen: in some pairs the intersection is one or two points, of area 0, and the union of two such pairs has twice the area of each.
#   Ten of 5,000 random pairs whose corners differ by 1e-17 to 1e-9 lose everything;
#   the others are right to 1e-8, by which they differ. No error is raised.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libgeos-c1v5=3.11.1-1 libgeos3.11.1=3.11.1-1 python3-shapely=1.8.5-2+b1
for deb in *.deb; do dpkg -x "$deb" .; done
export LD_LIBRARY_PATH="$work/usr/lib/x86_64-linux-gnu" PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > pairs.py <<'E'
import random
from shapely.geometry import Polygon

one = [(0.681733561468338, 0.14304858865865888), (0.8691575460368332, 0.8624623586342306), (0.022479905391807442, 0.012164296903332983)]
two = [(one[0][0], one[0][1] - 2.7755575615628914e-17), one[1], (one[2][0] - 3.469446951953614e-17, one[2][1] - 1.9081958235744878e-17)]
a, b = Polygon(one), Polygon(two)
print("one pair: areas %.4f %.4f, intersection %.4f, union %.4f" % (a.area, b.area, a.intersection(b).area, a.union(b).area))

random.seed(5)
lost = others = worst = 0
while lost + others < 5000:
    corners = [(random.random(), random.random()) for _ in range(3)]
    size = 10 ** random.uniform(-17, -9)
    moved = [(x + size * random.uniform(-1, 1), y + size * random.uniform(-1, 1)) for x, y in corners]
    a, b = Polygon(corners), Polygon(moved)
    if a.area < 1e-2:
        continue
    shared = a.intersection(b).area
    if shared == 0:
        lost += 1
    else:
        others += 1
        worst = max(worst, abs(shared - a.area))
print("random pairs: %d of 5000 share no area, the others differ by less than %.0e" % (lost, 1e-8 if worst < 1e-8 else worst))
E
python3 pairs.py | tee seen
grep -q "areas 0.2249 0.2249, intersection 0.0000, union 0.4497" seen
grep -qE "random pairs: [1-9][0-9]? of 5000 share no area, the others differ by less than 1e-08" seen
