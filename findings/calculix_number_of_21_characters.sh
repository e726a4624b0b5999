#!/bin/bash
# CalculiX: a coordinate as Python writes it, with 21 characters
# Packages of Debian 12: calculix-ccx=2.20-1, libspooles2.2=2.2-14, libarpack2=3.8.0-3. Needs python3.
# Guess: numbers of an input file are read with all of their characters, or a longer one is an error.
# Seen: 20 characters are read. 6.123233995736766e-17, which is cos(pi/2) as Python prints it, has 21: its exponent loses a digit, and the
#   node stands at 0.612 in place of 0, without a word. Of 22 characters or more the exponent loses both digits, which is an error.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install calculix-ccx=2.20-1 libspooles2.2=2.2-14 libarpack2=3.8.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

coordinate() {
    python3 - "$1" > cube.inp <<'P'
import sys
corners = [(sys.argv[1], 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
print("*NODE, NSET=ALL")
for i, (x, y, z) in enumerate(corners, 1):
    print(f"{i}, {x}, {y}, {z}")
print("*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1, 2, 3, 4, 5, 6, 7, 8")
print("*MATERIAL, NAME=STEEL\n*ELASTIC\n1000, 0.25\n*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL")
print("*BOUNDARY\n" + "".join(f"{i}, 1, 3\n" for i in range(1, 5)) + "*STEP\n*STATIC\n*NODE FILE\nU\n*END STEP")
P
    local status=0
    usr/bin/ccx cube > log || status=$?
    echo "$1: status $status, $(grep -qE "[*](ERROR|WARNING)" log && echo errors || echo nothing said)," \
        "node at $(python3 -c 'rows = open("cube.frd").read().splitlines()
print("%.6g" % float(next(row for row in rows if row.startswith(" -1"))[13:25]))' 2> /dev/null || echo none)"
    rm -f cube.frd
}
{
    for number in "math.cos(math.pi / 2)" "-math.cos(math.pi / 2)"; do
        coordinate "$(python3 -c "import math; print($number)")"
    done
    coordinate 6.12323399573677e-17
} | tee output
diff output - <<'E'
6.123233995736766e-17: status 0, nothing said, node at 0.612323
-6.123233995736766e-17: status 201, errors, node at none
6.12323399573677e-17: status 0, nothing said, node at 6.12323e-17
E
