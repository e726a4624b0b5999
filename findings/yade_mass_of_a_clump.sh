#!/bin/bash
# Yade: mass and moment of inertia of a clump of two spheres of radius 1 m whose centres are 0.2 m apart
# Packages of Debian 12: yade=2023.02a-1. Needs the python3 of Debian with numpy.
# Guess: a clump stands for one grain and has the mass of what its spheres fill together, 4815 kg at 1000 kg/m^3; that spheres overlap is
#   what clumps are made for.
# Seen: each sphere counts whole: 8378 kg, 74 % too much, and a moment about the long axis 69 % above that of the grain. More spheres for the
#   same grain make it heavier: 12566 kg with a third one in the middle. discretization=50 samples the union; 0 is the default.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install yade=2023.02a-1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH YADE_PREFIX="$work/usr"
export PYTHONPATH="$work/usr/lib/x86_64-linux-gnu/yade-double/py:$work/usr/lib/python3/dist-packages"

cat > clump.py <<'P'
from math import pi
from yade import *

O.materials.append(FrictMat(density=1000))
radius, apart, density = 1, 0.2, 1000
lens = pi * (4 * radius + apart) * (2 * radius - apart) ** 2 / 12  # what the two spheres share
half = apart / 2 + radius - 2 / 3 * ((apart / 2) ** 3 + radius ** 3) + ((apart / 2) ** 5 + radius ** 5) / 5  # integral of (1 - x^2)^2
print("seen: union: %.0f kg, %.0f kg m^2" % (density * (8 / 3 * pi * radius ** 3 - lens), density * pi * half))
for centres, samples in ((0, 0.2), 0), ((0, 0.1, 0.2), 0), ((0, 0.2), 50):
    clump, _ = O.bodies.appendClumped([sphere((x, 0, 0), radius) for x in centres], discretization=samples)
    state = O.bodies[clump].state
    print("seen: %d spheres, discretization=%d: %.0f kg, %.0f kg m^2" % (len(centres), samples, state.mass, state.inertia[0]))
P
/usr/bin/python3 ./usr/bin/yade -n -x clump.py 2> /dev/null | sed -n "s/^seen: //p" | tee output
diff output - <<'P'
union: 4815 kg, 1988 kg m^2
2 spheres, discretization=0: 8378 kg, 3351 kg m^2
3 spheres, discretization=0: 12566 kg, 5027 kg m^2
2 spheres, discretization=50: 4838 kg, 2005 kg m^2
P
