#!/bin/bash
# ADMesh: a file of three cubes, of which one is inside out
# Packages of Debian 12: admesh=0.98.4-2, libadmesh1=0.98.4-2. Needs python3.
# Guess: its repair turns the faces of each part outwards, as it does those of one cube alone.
# Seen: one cube that is inside out is turned, all of its 12 facets. Beside two sound cubes it stays as it is: no facet is reversed, and
#   the volume of the three is 1. It looks at the sign of the volume of all parts together.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install admesh=0.98.4-2 libadmesh1=0.98.4-2
for deb in *.deb; do dpkg -x "$deb" .; done
export LD_LIBRARY_PATH="$work/usr/lib/x86_64-linux-gnu"

cat > cubes.py <<'E'
def cube(x, outwards=True):
    corner = [(x + i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    facets = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
    return [[corner[i] for i in (t if outwards else t[::-1])] for t in facets]

def write(name, facets):
    with open(name, "w") as file:
        print("solid cubes", file=file)
        for facet in facets:
            print("facet normal 0 0 0\nouter loop", *("vertex %g %g %g" % v for v in facet), "endloop\nendfacet", sep="\n", file=file)
        print("endsolid cubes", file=file)

write("one.stl", cube(0, False))
write("three.stl", cube(0) + cube(3) + cube(6, False))
E
python3 cubes.py
for name in one three; do
    ./usr/bin/admesh $name.stl > $name.txt
    echo "$name: $(grep -oE "Number of parts +: +[0-9]+" $name.txt), $(grep -oE "Volume +: +[-0-9.]+" $name.txt), $(grep -E "^Facets reversed" $name.txt)" |
        tr -s " " | tee $name.seen
done
grep -q "parts : 1, Volume : 1.000000, Facets reversed : 12" one.seen
grep -q "parts : 3, Volume : 1.000000, Facets reversed : 0" three.seen
