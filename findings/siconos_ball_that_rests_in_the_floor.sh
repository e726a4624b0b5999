#!/bin/bash
# Siconos: a ball that falls by a metre on a floor and does not bounce
# Packages of Debian 12: python3-siconos=4.4.0+dfsg-2 and the libsiconos-*7 of the same version. Needs the python3 of Debian with numpy.
# Guess: contact is a unilateral condition, solved for without a penalty: the ball comes to rest on the floor, whatever the step.
# Seen: TimeStepping with MoreauJeanOSI keeps the condition on velocities alone. The ball stops where the step of the impact
#   has taken it, 4.3 mm below the floor with h = 5 ms (speed times step is 22 mm), 1.0 mm with 0.5 ms, and stays there at rest.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
version=4.4.0+dfsg-2
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-siconos=$version libsiconos-kernel7=$version libsiconos-numerics7=$version libsiconos-control7=$version \
    libsiconos-mechanics7=$version libsiconos-io7=$version
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > fall.py <<'E'
import numpy as np
import siconos.kernel as sk

def height_and_speed(step):
    ball = sk.LagrangianLinearTIDS(np.array([1.0, 0.0, 0.0]), np.zeros(3), np.diag([1.0, 1.0, 0.004]))
    ball.setFExtPtr(np.array([-9.81, 0.0, 0.0]))
    floor = sk.Interaction(sk.NewtonImpactNSL(0.0), sk.LagrangianLinearTIR(np.array([[1.0, 0.0, 0.0]])))
    system = sk.NonSmoothDynamicalSystem(0.0, 2.0)
    system.insertDynamicalSystem(ball)
    system.link(floor, ball)
    run = sk.TimeStepping(system, sk.TimeDiscretisation(0.0, step), sk.MoreauJeanOSI(0.5), sk.LCP())
    while run.hasNextEvent():
        run.computeOneStep()
        run.nextStep()
    return ball.q()[0], ball.velocity()[0]

for step in 5e-3, 5e-4:
    print("h %g s: height %.4f m, speed %.4f m/s" % (step, *height_and_speed(step)))
E
/usr/bin/python3 fall.py | tee seen
grep -q "h 0.005 s: height -0.0043 m, speed 0.0000 m/s" seen
grep -q "h 0.0005 s: height -0.0010 m, speed 0.0000 m/s" seen
