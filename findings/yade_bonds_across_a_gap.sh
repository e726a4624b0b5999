#!/bin/bash
# Yade: bonds of CohFrictMat between spheres that do not touch, made by an interaction radius as those of JCFpmMat are
# Packages of Debian 12: yade=2023.02a-1. Needs the python3 of Debian with numpy.
# Guess: a bond is at rest as it is made. This is what an interaction radius is for: neighbours near touch are bonded without force.
# Seen: CohFrictMat measures from touch. Across 10 mm the bond pulls with k_n times the gap at once (1000 N at 1e5 N/m), and one of 900 N
#   of strength is gone before the first step ends. 10 mm inside each other the spheres push with 1000 N. Bonds of JCFpmMat are at rest.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install yade=2023.02a-1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH YADE_PREFIX="$work/usr"
export PYTHONPATH="$work/usr/lib/x86_64-linux-gnu/yade-double/py:$work/usr/lib/python3/dist-packages"

cat > gap.py <<'E'
from math import pi
from yade import *

def bond(name, gap, strength):
    O.reset()
    common = dict(young=1e6, poisson=0.3, frictionAngle=0.5, density=1000)
    if name == "CohFrictMat":
        O.materials.append(CohFrictMat(isCohesive=True, normalCohesion=strength / 0.01, shearCohesion=strength / 0.01, momentRotationLaw=False, **common))
        laws = [[Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=1.2)], [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)],
                [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]]
    else:
        O.materials.append(JCFpmMat(tensileStrength=strength / (0.01 * pi), cohesion=strength / (0.01 * pi), **common))
        laws = [[Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=1.2)], [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1)],
                [Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()]]
    for x in (0, 0.2 + gap):
        O.bodies.append(utils.sphere((x, 0, 0), 0.1, material=0))
        O.bodies[-1].state.blockedDOFs = "xyzXYZ"
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=1.2)]), InteractionLoop(*laws), NewtonIntegrator(damping=0)]
    O.dt = 1e-5
    O.step()
    held = O.interactions.has(0, 1) and O.interactions[0, 1].isReal
    print("seen: %s, gap %g mm, strength %d N: %s" % (name, 1000 * gap, strength, "%.0f N" % (O.interactions[0, 1].phys.normalForce[0] + 0.0) if held else "no bond"))

for name in ("CohFrictMat", "JCFpmMat"):
    for gap, strength in ((0.01, 1100), (0.01, 900), (-0.01, 1100)):
        bond(name, gap, strength)
E
/usr/bin/python3 ./usr/bin/yade -n -x gap.py 2> /dev/null | sed -n "s/^seen: //p" | tee output
diff output - <<'E'
CohFrictMat, gap 10 mm, strength 1100 N: -1000 N
CohFrictMat, gap 10 mm, strength 900 N: no bond
CohFrictMat, gap -10 mm, strength 1100 N: 1000 N
JCFpmMat, gap 10 mm, strength 1100 N: 0 N
JCFpmMat, gap 10 mm, strength 900 N: 0 N
JCFpmMat, gap -10 mm, strength 1100 N: 0 N
E
