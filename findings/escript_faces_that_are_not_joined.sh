#!/bin/bash
# escript (finley): JoinFaces and GlueFaces of two unit squares that lie side by side
# Packages of Debian 12: python3-escript=5.6-4+b3, libboost-numpy1.74.0=1.74.0+ds1-21. Needs the python3 of Debian with numpy.
# Guess: squares whose cells do not match, or that are 1e-7 apart, are joined in part or refused.
# Seen: a mesh of two separate squares comes back without a word: no length in contact, all eight sides free. With 4 cells beside 4
#   and gaps up to 1e-9 the whole side is joined (length 1) or glued (free length 6). Nothing is joined for 4 beside 8 cells, or at 1e-7.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-escript=5.6-4+b3 libboost-numpy1.74.0=1.74.0+ds1-21
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3-escript" PYTHONWARNINGS=ignore

cat > join.py <<'E'
from esys.escript import FunctionOnBoundary, FunctionOnContactZero, Scalar, integrate
from esys.finley import GlueFaces, JoinFaces, Rectangle

def squares(cells, gap):
    left, right = Rectangle(n0=4, n1=4), Rectangle(n0=4, n1=cells)
    right.setX(right.getX() + [1 + gap, 0])
    return [left, right]

for cells, gap in (4, 0), (4, 1e-9), (4, 1e-7), (8, 0):
    joined = integrate(Scalar(1, FunctionOnContactZero(JoinFaces(squares(cells, gap)))))
    free = integrate(Scalar(1, FunctionOnBoundary(GlueFaces(squares(cells, gap)))))
    print("4 cells beside %d, gap %g: joined along %.0f, free length when glued %.0f" % (cells, gap, joined, free))
E
/usr/bin/python3 join.py 2> /dev/null | tee seen
diff seen - <<'E'
4 cells beside 4, gap 0: joined along 1, free length when glued 6
4 cells beside 4, gap 1e-09: joined along 1, free length when glued 6
4 cells beside 4, gap 1e-07: joined along 0, free length when glued 8
4 cells beside 8, gap 0: joined along 0, free length when glued 8
E
