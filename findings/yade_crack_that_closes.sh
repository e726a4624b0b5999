#!/bin/bash
# Yade: where the pieces of a torn bond of JCFpmMat bear pressure again
# Packages of Debian 12: yade=2023.02a-1. Needs the python3 of Debian with numpy.
# Guess: the crack closes where the bond was made without force: at that distance of the centres, or else where the spheres touch, 200 mm.
# Seen: where the bond was made decides, and differently for bonds that look alike. Made 10 mm inside each other, torn and pulled 3 mm
#   apart, the spheres press as soon as they turn round, at 193 mm: the crack is propped open. Made with a gap of 10 mm (an interaction
#   radius, as the model asks for), they come back by 10 mm without force, through the place of the bond, until they touch at 200 mm.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install yade=2023.02a-1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH YADE_PREFIX="$work/usr"
export PYTHONPATH="$work/usr/lib/x86_64-linux-gnu/yade-double/py:$work/usr/lib/python3/dist-packages"

cat > crack.py <<'E'
from yade import *

def run(gap):
    O.reset()
    O.materials.append(JCFpmMat(young=1e6, poisson=0.3, frictionAngle=0.5, density=1000, tensileStrength=3e3, cohesion=3e3))
    for x in (0, 0.2 + gap):
        O.bodies.append(utils.sphere((x, 0, 0), 0.1, material=0))
        O.bodies[-1].state.blockedDOFs = "xyzXYZ"
    bounds, geometry = Bo1_Sphere_Aabb(aabbEnlargeFactor=1.2), Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.2)
    O.engines = [ForceResetter(), InsertionSortCollider([bounds], verletDist=0),
                 InteractionLoop([geometry], [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1)],
                                 [Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()]),
                 NewtonIntegrator(damping=0)]
    O.dt = 1e-4
    O.step()
    # Bonds are made; from now on contacts are those of spheres that touch.
    bounds.aabbEnlargeFactor = geometry.interactionDetectionFactor = 1
    force = lambda: O.interactions[0, 1].phys.normalForce[0] if O.interactions.has(0, 1) and O.interactions[0, 1].isReal else 0.0
    distance = lambda: 1000 * O.bodies[1].state.pos[0]
    rest = force()
    O.bodies[1].state.vel = (0.1, 0, 0)
    O.run(51, True)
    pull = force()
    O.run(249, True)
    torn = distance()
    O.bodies[1].state.vel = (-0.1, 0, 0)
    while force() < 10:
        O.run(10, True)
    print("seen: made at %.0f mm: %.0f N at first, %.0f N at 0.5 mm more, turned at %.0f mm, presses from %.0f mm"
          % (200 + 1000 * gap, rest, pull, torn, distance()))

for gap in (-0.01, 0, 0.01):
    run(gap)
E
/usr/bin/python3 ./usr/bin/yade -n -x crack.py 2> /dev/null | sed -n "s/^seen: //p" | tee output
diff output - <<'E'
made at 190 mm: 0 N at first, -50 N at 0.5 mm more, turned at 193 mm, presses from 193 mm
made at 200 mm: 0 N at first, -50 N at 0.5 mm more, turned at 203 mm, presses from 200 mm
made at 210 mm: 0 N at first, -50 N at 0.5 mm more, turned at 213 mm, presses from 200 mm
E
