#!/bin/bash
# ODE: a box that slides on a plane with surface.mu = 0.5
# Packages of Debian 12: libode-dev=2:0.16.2-1, libode8=2:0.16.2-1. Needs g++.
# Guess: mu is Coulomb's coefficient. Under 10 m/s^2 the box is slowed by 5 m/s^2, whatever its mass and the direction of its motion.
# Seen: as contacts are made, mu is the largest force of each of them in N: the four of the box slow 0.1 kg by 20, 1 kg by 2 and 100 kg by
#   0.02 m/s^2. With dContactApprox1 it is a coefficient, but of each of two directions that ODE chooses: 5 m/s^2 along them, 7.07 along the
#   diagonal, 41 % more.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libode-dev=2:0.16.2-1 libode8=2:0.16.2-1
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

cat > slide.cpp <<'C'
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <ode/ode.h>

static int mode;
static dWorldID world;
static dJointGroupID contacts;

static void touch(void*, dGeomID one, dGeomID other) {
    dContact found[8];
    const int count = dCollide(one, other, 8, &found[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
        found[i].surface.mode = mode;
        found[i].surface.mu = 0.5;
        dJointAttach(dJointCreateContact(world, contacts, &found[i]), dGeomGetBody(one), dGeomGetBody(other));
    }
}

static double speed_after(dSpaceID space, dBodyID box, int steps) {
    for (int i = 0; i < steps; ++i) {
        dSpaceCollide(space, nullptr, touch);
        dWorldStep(world, 1e-3);
        dJointGroupEmpty(contacts);
    }
    const dReal* speed = dBodyGetLinearVel(box);
    return std::hypot(speed[0], speed[1]);
}

// Deceleration [m/s^2] of a box of 1 x 1 x 0.1 m that starts with 5 m/s at an angle to its edges
static double deceleration(double mass, double degrees) {
    world = dWorldCreate();
    contacts = dJointGroupCreate(0);
    const dSpaceID space = dSimpleSpaceCreate(nullptr);
    dWorldSetGravity(world, 0, 0, -10);
    dCreatePlane(space, 0, 0, 1, 0);
    const dBodyID box = dBodyCreate(world);
    dMass inertia;
    dMassSetBoxTotal(&inertia, mass, 1, 1, 0.1);
    dBodySetMass(box, &inertia);
    dGeomSetBody(dCreateBox(space, 1, 1, 0.1), box);
    dBodySetPosition(box, 0, 0, 0.05);
    const double angle = degrees * std::acos(-1.0) / 180;
    dBodySetLinearVel(box, 5 * std::cos(angle), 5 * std::sin(angle), 0);
    const double before = speed_after(space, box, 100);
    const double after = speed_after(space, box, 100);
    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(world);
    return (before - after) / 0.1;
}

int main() {
    dInitODE();
    for (const int each : {0, static_cast<int>(dContactApprox1)})
        for (const double mass : {0.1, 1.0, 100.0}) {
            mode = each;
            std::printf("%s, %g kg: %.2f m/s^2 along an edge, %.2f along the diagonal\n", mode ? "dContactApprox1" : "as it is", mass,
                        deceleration(mass, 0), deceleration(mass, 45));
        }
    dCloseODE();
}
C
g++ -O1 -I"$include" slide.cpp -L"$lib" -lode -o slide
./slide | tee output
diff output - <<'E'
as it is, 0.1 kg: 20.00 m/s^2 along an edge, 21.79 along the diagonal
as it is, 1 kg: 2.00 m/s^2 along an edge, 2.83 along the diagonal
as it is, 100 kg: 0.02 m/s^2 along an edge, 0.03 along the diagonal
dContactApprox1, 0.1 kg: 5.00 m/s^2 along an edge, 7.07 along the diagonal
dContactApprox1, 1 kg: 5.00 m/s^2 along an edge, 7.07 along the diagonal
dContactApprox1, 100 kg: 5.00 m/s^2 along an edge, 7.07 along the diagonal
E
