#!/bin/bash
# ESyS-Particle: two spheres of mass 1 kg that an elastic contact of 1000 N/m throws back
# Packages of Debian 12: esys-particle=2.3.5+dfsg2-6+b1, libboost-python1.74.0=1.74.0+ds1-21, python3-gengeo=1.4-4.1+b5. Needs mpirun.
# Guess: normalK = 1000 is the spring's constant. They touch for pi sqrt(m / (2 k)) = 0.0702 s, whatever their radius.
# Seen: by default the constant is multiplied by half of the radius: 500 N/m and 0.0993 s for 1 m, 250 N/m and 0.1405 s for 0.5 m. It
#   is 1000 N/m with scaling=False. The documentation says "scaled with particle size", and a radius of 1 does not give what was asked for.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install esys-particle=2.3.5+dfsg2-6+b1 libboost-python1.74.0=1.74.0+ds1-21 python3-gengeo=1.4-4.1+b5
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3/dist-packages" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# The spheres come at 1 m/s from 0.1 m beside touch, and leave at 1 m/s: where they are after 0.5 s tells how long they touched.
collide() {
    cat > run.py <<E
from math import pi, sqrt
from esys.lsm import LsmMpi, NRotElasticPrms, NRotSphere
from esys.lsm.util import BoundingBox, Vec3

run = LsmMpi(numWorkerProcesses=1, mpiDimList=[1, 1, 1])
run.initNeighbourSearch(particleType="NRotSphere", gridSpacing=2.5, verletDist=0.5)
run.setTimeStepSize(1e-4)
run.setNumTimeSteps(5001)
run.setSpatialDomain(BoundingBox(Vec3(-20, -20, -20), Vec3(20, 20, 20)))
for number, side in enumerate((-1, 1)):
    ball = NRotSphere(id=number, posn=Vec3(side * ($1 + 0.1), 0, 0), radius=$1, mass=1.0)
    ball.setLinearVelocity(Vec3(-side, 0, 0))
    run.createParticle(ball)
run.createInteractionGroup(NRotElasticPrms(name="spring", normalK=1000.0$2))
for _ in range(5000):
    run.runTimeStep()
x = abs(run.getParticleList()[0].getPosn()[0])
touched = 0.5 - 0.1 - (x - $1)
print("seen: radius $1$2: touch for %.4f s, %.0f N/m" % (touched, pi**2 / 2 / touched**2))
run.exit()
E
    timeout 60 mpirun --oversubscribe -n 2 usr/bin/esysparticle run.py 2> /dev/null | grep "^seen"
}
{ collide 1.0 ""; collide 0.5 ""; collide 1.0 ", scaling=False"; collide 0.5 ", scaling=False"; } | tee seen
diff seen - <<'E'
seen: radius 1.0: touch for 0.0993 s, 500 N/m
seen: radius 0.5: touch for 0.1405 s, 250 N/m
seen: radius 1.0, scaling=False: touch for 0.0702 s, 1000 N/m
seen: radius 0.5, scaling=False: touch for 0.0702 s, 1000 N/m
E
