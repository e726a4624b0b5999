#!/bin/bash
# SciPy: a ball that bounces on a floor, by events of solve_ivp
# Packages of Debian 12: python3-scipy=1.10.1-2. Needs the python3 of Debian with numpy.
# Guess: an event that is terminal and looks for height 0 from above stops the ball at the floor. Started again from there with half of its
#   speed turned upwards, it bounces lower and lower; at worst the loop never ends.
# Seen: from many heights it falls through the floor after some 50 bounces, and is tens of metres below it at the end, with status 0 and
#   without an event: where the last event was found, the height is a rounding below 0, so that the next way down crosses nothing. From
#   the other heights there are still events after 500 bounces.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-scipy=1.10.1-2
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"

/usr/bin/python3 - <<'P' | tee output
import numpy as np
from scipy.integrate import solve_ivp

def touches(t, state):
    return state[0]
touches.terminal, touches.direction = True, -1

def bounce(method, height, limit=500):
    t, state, n_bounces = 0.0, [height, 0.0], 0
    while n_bounces < limit:
        part = solve_ivp(lambda t, state: [state[1], -9.81], (t, 5.0), state, method=method, events=touches, rtol=1e-8, atol=1e-10)
        if part.status == 0:
            return n_bounces, part.y[0, -1]
        t, state, n_bounces = part.t[-1], [part.y[0, -1], -0.5 * part.y[1, -1]], n_bounces + 1
    return n_bounces, state[0]

for method in "RK45", "DOP853", "Radau":
    results = [bounce(method, height) for height in (0.3, 0.5, 0.7, 1.0, 1.1, 1.3, 1.5, 2.0)]
    fallen = [(n, y) for n, y in results if y < -1.0]
    print(f"{method}: of eight heights more than two fall through: {len(fallen) > 2}, after 20 to 100 bounces: "
          f"{all(20 < n < 100 for n, _ in fallen)}; the others bounce on: {all(n == 500 for n, y in results if y >= -1.0)}")
P
diff output - <<'P'
RK45: of eight heights more than two fall through: True, after 20 to 100 bounces: True; the others bounce on: True
DOP853: of eight heights more than two fall through: True, after 20 to 100 bounces: True; the others bounce on: True
Radau: of eight heights more than two fall through: True, after 20 to 100 bounces: True; the others bounce on: True
P
