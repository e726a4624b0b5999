#!/bin/bash
# Yade: work of a contact of two cubes (Polyhedra) without friction along a closed path
# Packages of Debian 12: yade=2023.02a-1. Needs the python3 of Debian with numpy.
# Guess: the law of volumes is elastic. To press a cube into another, to slide it along and to lift it takes no work in all, as a force
#   without friction follows from an energy.
# Seen: 22.5 J are put in to press the cube 10 mm deep. As it slides by half of its edge and is lifted, 30.5 J come back: 8 J are gained each time
#   round, and 8 J are lost on the way back. The force is the stiffness times the volume of the overlap, along a normal of its own.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install yade=2023.02a-1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH YADE_PREFIX="$work/usr"
export PYTHONPATH="$work/usr/lib/x86_64-linux-gnu/yade-double/py:$work/usr/lib/python3/dist-packages"

cat > path.py <<'P'
from yade import *
from yade import polyhedra_utils

material = PolyhedraMat(young=1e6, poisson=0.3, frictionAngle=0, density=1000)
O.materials.append(material)
corners = [(x / 2, y / 2, z / 2) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
lower, upper = (polyhedra_utils.polyhedra(material, v=corners, fixed=True) for _ in range(2))
upper.state.pos = (0, 0, 1)
O.bodies.append([lower, upper])
O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Polyhedra_Aabb()]),
             InteractionLoop([Ig2_Polyhedra_Polyhedra_PolyhedraGeom()], [Ip2_PolyhedraMat_PolyhedraMat_PolyhedraPhys()],
                             [Law2_PolyhedraGeom_PolyhedraPhys_Volumetric()])]
O.dt = 1e-9

# Work [J] of the contact on the upper cube as its centre moves slowly from one place to another [m]
def work(start, end, parts=100):
    total = 0
    for i in range(parts):
        upper.state.pos = [a + (b - a) * (i + 0.5) / parts for a, b in zip(start, end)]
        O.step()
        total += sum(f * (b - a) / parts for f, a, b in zip(O.forces.f(upper.id, True), start, end))
    return total

path = (0.1, 0, 1), (0.1, 0, 0.99), (0.6, 0, 0.99), (0.6, 0, 1)
for name, places in ("there", path), ("back", path[::-1]):
    legs = [work(*leg) for leg in zip(places, places[1:])]
    print("seen: %s:" % name, " ".join("%+.1f" % leg for leg in legs), "J, in all %+.0f J" % sum(legs))
P
/usr/bin/python3 ./usr/bin/yade -n -x path.py 2> /dev/null | sed -n "s/^seen: //p" | tee output
diff output - <<'P'
there: -22.5 +20.5 +10.0 J, in all +8 J
back: -10.0 -20.3 +22.5 J, in all -8 J
P
