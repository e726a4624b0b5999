#!/bin/bash
# LIGGGHTS: two dry spheres that hit each other (Hertz, coefficient of restitution 0.5)
# Packages of Debian 12: libliggghts3=3.8.0+repack1-9+b2, liggghts=3.8.0+repack1-9+b2.
# Guess: a contact without cohesion never pulls, and the sphere leaves at half the speed that it came with.
# Seen: it leaves at half the speed, and before that the contact pulls with 0.13 of its largest force. With `limitForce on` it does not pull,
#   and the sphere leaves at 0.55 of the speed: the coefficient of restitution is not the one that was asked for. The default is off.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libliggghts3=3.8.0+repack1-9+b2 liggghts=3.8.0+repack1-9+b2
for deb in *.deb; do dpkg -x "$deb" .; done
export LD_LIBRARY_PATH="$work/usr/lib/x86_64-linux-gnu"

collide() {
    cat > in.run <<E
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
units si
region box block -0.1 0.1 -0.1 0.1 -0.1 0.3 units box
create_box 1 box
neighbor 0.01 bin
neigh_modify delay 0
fix stiff all property/global youngsModulus peratomtype 1e7
fix lateral all property/global poissonsRatio peratomtype 0.3
fix back all property/global coefficientRestitution peratomtypepair 1 0.5
fix rub all property/global coefficientFriction peratomtypepair 1 0.0
pair_style gran model hertz tangential off $1
pair_coeff * *
timestep 1e-6
create_atoms 1 single 0 0 0.0201
create_atoms 1 single 0 0 0
group held id 2
set atom * diameter 0.02
set atom * density 1000
set atom 1 vz -0.5
fix hold held freeze
fix move all nve/sphere
variable force equal fz[1]
variable speed equal vz[1]
thermo_style custom step v_force v_speed
thermo 20
thermo_modify lost ignore norm no
run 3000
E
    usr/bin/liggghts -in in.run > out
    awk -v name="$1" '$1 ~ /^[0-9]+$/ && NF == 3 { if ($2 < low) low = $2; if ($2 > high) high = $2; v = $3 }
        END { printf "%s: pulls with %.2f of the largest force, leaves at %.2f of the speed\n", name, -low / high, v / 0.5 }' out
}
collide "limitForce off" | tee off
collide "limitForce on" | tee on
grep -q "pulls with 0.13 of the largest force, leaves at 0.50" off
grep -q "pulls with -\?0.00 of the largest force, leaves at 0.55" on
