#!/bin/bash
# Yade: a ball that falls freely
# Packages of Debian 12: yade=2023.02a-1. Needs the python3 of Debian with numpy.
# Guess: with gravity and an integrator as they are created a ball falls by g t^2/2, as nothing dissipates by itself.
# Seen: NewtonIntegrator has damping = 0.2. It takes a fifth of what speeds the ball up, gravity as well: it falls with 0.8 g, on
#   its way up it is slowed by 1.2 g, and aside, without a force, it keeps its speed. damping = 0 gives g.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install yade=2023.02a-1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH YADE_PREFIX="$work/usr"
export PYTHONPATH="$work/usr/lib/x86_64-linux-gnu/yade-double/py:$work/usr/lib/python3/dist-packages"

cat > fall.py <<'E'
from yade import *

def velocity(start, **options):
    O.reset()
    O.bodies.append(utils.sphere((0, 0, 0), 0.1))
    O.bodies[0].state.vel = start
    O.engines = [ForceResetter(), NewtonIntegrator(gravity=(0, 0, -10), **options)]
    O.dt = 1e-4
    O.run(1000, True)
    return O.bodies[0].state.vel

fall, throw, undamped = velocity((0, 0, 0)), velocity((3, 0, 100)), velocity((0, 0, 0), damping=0)
for name, v in (("fall", fall), ("throw", throw), ("undamped", undamped)):
    print("seen: %-8s after 0.1 s at 10 m/s^2: velocity (%.4f, %.4f, %.4f) m/s" % (name, v[0], v[1], v[2]))
near = lambda a, b: abs(a - b) < 0.01
good = near(fall[2], -0.8) and near(throw[2], 98.8) and throw[0] == 3 and near(undamped[2], -1.0)
print("seen: as written" if good else "seen: otherwise")
E
/usr/bin/python3 ./usr/bin/yade -n -x fall.py 2>/dev/null | grep "^seen:" | tee output
grep -qx "seen: as written" output
