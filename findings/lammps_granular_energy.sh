#!/bin/bash
# LAMMPS: the total energy of grains that collide without loss
# Packages of Debian 12: lammps=20220106.git7586adbb6a+ds1-2+b2, liblammps0 of the same version, libkim-api2=2.3.0-1+b1.
# Guess: two grains that a spring alone pushes apart keep their total energy: what the kinetic energy loses the potential one has.
# Seen: PotEng of gran/hooke, gran/hooke/history and granular is 0 at all times, so that TotEng is the kinetic energy: in the
#   middle of the collision it is below a hundredth of that before. No total energy tells whether a step of grains was too long.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
version=20220106.git7586adbb6a+ds1-2+b2
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install lammps=$version liblammps0=$version libkim-api2=2.3.0-1+b1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

style=("gran/hooke 1000.0 NULL 0.0 NULL 0.0 0" "gran/hooke/history 1000.0 NULL 0.0 NULL 0.0 0" "granular")
coefficients=("" "" "hooke 1000.0 0.0 tangential linear_nohistory 0.0 0.0")
for i in 0 1 2; do
    cat > in.grains <<E
units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
region box block -1 3 -1 1 -1 1
create_box 1 box
create_atoms 1 single 0 0 0
create_atoms 1 single 1.2 0 0
set group all diameter 1.0 density 1.0
group left id 1
group right id 2
velocity left set 0.5 0 0
velocity right set -0.5 0 0
pair_style ${style[i]}
pair_coeff * * ${coefficients[i]}
timestep 1e-4
fix 1 all nve/sphere
thermo_style custom step ke pe etotal
thermo 20
run 6000
E
    ./usr/bin/lmp -in in.grains -log none > output
    awk -v name="${style[i]%% *}" '$1 ~ /^[0-9]+$/ && $2 ~ /^[-+.0-9e]+$/ && NF == 4 {
            if (!n++) first = least = $4
            if ($4 < least) least = $4
            if ($3 != 0) potential = 1
            last = $4 }
        END { printf "%s: total energy over that before: least %.4f, after %.4f; a potential energy: %s\n",
                name, least / first, last / first, potential ? "yes" : "no"
              exit !(n > 100 && !potential && least < 0.01 * first && last > 0.999 * first && last < 1.001 * first) }' output
done
