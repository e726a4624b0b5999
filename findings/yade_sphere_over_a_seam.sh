#!/bin/bash
# Yade: a sphere that is pressed 1 mm deep into a flat floor of triangles (facets)
# Packages of Debian 12: yade=2023.02a-1. Needs the python3 of Debian with numpy.
# Guess: a flat floor pushes upwards with the same force everywhere, however it is cut into facets.
# Seen: each facet that the sphere reaches pushes with all of the stiffness: 1333 N inside a facet, 2667 N on the seam of two, 5333 and
#   8000 N where four or six meet. 10 mm beside a seam it is 1992 N, and 66 N aside. The seams of a flat floor are felt as ridges, and
#   how the floor is meshed decides where they are.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install yade=2023.02a-1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH YADE_PREFIX="$work/usr"
export PYTHONPATH="$work/usr/lib/x86_64-linux-gnu/yade-double/py:$work/usr/lib/python3/dist-packages"

cat > floor.py <<'E'
from math import cos, pi, sin
from yade import *

radius, depth = 0.1, 1e-3

# Force [N] on a fixed sphere above (0.3, y) or the origin, in which the facets of a round floor meet; the first seam lies along x
def push(facets, x, y):
    O.reset()
    O.materials.append(FrictMat(young=1e7, poisson=0.3, frictionAngle=0, density=2600))
    rim = [(cos(2 * pi * i / facets), sin(2 * pi * i / facets), 0) for i in range(facets)]
    for i in range(facets):
        O.bodies.append(utils.facet([(0, 0, 0), rim[i], rim[(i + 1) % facets]], fixed=True))
    O.bodies.append(utils.sphere((x, y, radius - depth), radius, fixed=True))
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Facet_Aabb()]),
                 InteractionLoop([Ig2_Facet_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
                 NewtonIntegrator(damping=0)]
    O.dt = 1e-6
    O.run(2, True)
    return O.forces.f(facets, True)

for facets, x, y in (4, 0.3, 0.1), (4, 0.3, 0.01), (4, 0.3, 0), (4, 0, 0), (6, 0, 0):
    force = push(facets, x, y)
    print("seen: %d facets, at (%g, %g): %.0f N upwards, %.0f N aside" % (facets, x, y, force[2], force[1]))
E
/usr/bin/python3 ./usr/bin/yade -n -x floor.py 2> /dev/null | sed -n "s/^seen: //p" | tee output
diff output - <<'E'
4 facets, at (0.3, 0.1): 1333 N upwards, 0 N aside
4 facets, at (0.3, 0.01): 1992 N upwards, 66 N aside
4 facets, at (0.3, 0): 2667 N upwards, 0 N aside
4 facets, at (0, 0): 5333 N upwards, 0 N aside
6 facets, at (0, 0): 8000 N upwards, 0 N aside
E
