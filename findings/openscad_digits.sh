#!/bin/bash
# OpenSCAD: a small gap far from the origin, written as STL and as OFF
# Packages of Debian 12: openscad=2021.01-6.
# Guess: two cubes of 1 mm with a gap of 0.01 mm, 10 m from the origin, keep their gap in a file: single precision would hold it.
# Seen: coordinates are written with six digits. 10001.01 is 10001 there, and the cubes touch. Near the origin the gap is kept: export
#   bodies there, and move them afterwards.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install openscad=2021.01-6
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

echo "translate([10000, 0, 0]) cube([1, 1, 1]); translate([10001.01, 0, 0]) cube([1, 1, 1]);" > far.scad
echo "translate([0, 0, 0]) cube([1, 1, 1]); translate([1.01, 0, 0]) cube([1, 1, 1]);" > near.scad
for name in far near; do
    ./usr/bin/openscad -o $name.stl $name.scad > /dev/null 2>&1
    ./usr/bin/openscad -o $name.off $name.scad > /dev/null 2>&1
    echo "$name, STL: x is $(awk '$1 == "vertex" { print $2 }' $name.stl | sort -gu | paste -sd' ')" | tee $name.txt
    # the number of vertices is in the first line
    echo "$name, OFF: x is $(awk 'NR == 1 { n = $2 } NR > 1 && NR <= n + 1 { print $1 }' $name.off | sort -gu | paste -sd' ')" | tee -a $name.txt
done
[ "$(grep -c "x is 10000 10001 10002$" far.txt)" = 2 ]
[ "$(grep -c "x is 0 1 1.01 2.01$" near.txt)" = 2 ]
