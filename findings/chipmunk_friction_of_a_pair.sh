#!/bin/bash
# Chipmunk: a long box of friction 0.5 on a ramp of friction 0.5
# Packages of Debian 12: libchipmunk7=7.0.3-5, libchipmunk-dev=7.0.3-5. Needs gcc.
# Guess: two surfaces of the same coefficient have that coefficient together: the box rests up to 26.6 degrees (tan = 0.5).
# Seen: the coefficients are multiplied. The box slides on 20 degrees, with exactly g (sin 20 - 0.25 cos 20), and rests up to 14 degrees.
#   With 1 and 0.5 it would rest up to 26.6: one of the two has to be 1 for the other to count.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libchipmunk7=7.0.3-5 libchipmunk-dev=7.0.3-5
for deb in *.deb; do dpkg -x "$deb" .; done
libraries=$PWD/usr/lib/x86_64-linux-gnu

cat > ramp.c <<'E'
#include <chipmunk/chipmunk.h>
#include <math.h>
#include <stdio.h>

static double speed_after_a_second(double degrees, double ramp, double box) {
    const double angle = degrees * M_PI / 180;
    cpSpace* space = cpSpaceNew();
    cpSpaceSetGravity(space, cpv(9.81 * sin(angle), -9.81 * cos(angle)));
    cpShape* floor = cpSegmentShapeNew(cpSpaceGetStaticBody(space), cpv(-100, 0), cpv(100, 0), 0);
    cpShapeSetFriction(floor, ramp);
    cpSpaceAddShape(space, floor);
    cpBody* body = cpSpaceAddBody(space, cpBodyNew(1, cpMomentForBox(1, 4, 1)));
    cpBodySetPosition(body, cpv(0, 0.5));
    cpShape* shape = cpSpaceAddShape(space, cpBoxShapeNew(body, 4, 1, 0));
    cpShapeSetFriction(shape, box);
    for (int i = 0; i < 1000; ++i)
        cpSpaceStep(space, 1e-3);
    return cpBodyGetVelocity(body).x;
}

int main(void) {
    for (double degrees = 10; degrees < 31; degrees += 10)
        printf("%g degrees: %.3f for 0.5 and 0.5, %.3f for 1 and 0.5\n", degrees,
               fabs(speed_after_a_second(degrees, 0.5, 0.5)), fabs(speed_after_a_second(degrees, 1, 0.5)));
    const double angle = 20 * M_PI / 180;
    printf("g (sin 20 - 0.25 cos 20) = %.3f\n", 9.81 * (sin(angle) - 0.25 * cos(angle)));
}
E
gcc -o ramp ramp.c -Iusr/include -L"$libraries" -lchipmunk -lm
LD_LIBRARY_PATH=$libraries ./ramp | tee seen
grep -q "^10 degrees: 0.000 for 0.5 and 0.5, 0.000 for 1 and 0.5" seen
grep -q "^20 degrees: 1.051 for 0.5 and 0.5, 0.000 for 1 and 0.5" seen
grep -q "^30 degrees: 2.781 for 0.5 and 0.5, 0.657 for 1 and 0.5" seen
grep -q "= 1.051" seen
