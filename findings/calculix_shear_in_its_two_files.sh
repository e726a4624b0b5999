#!/bin/bash
# CalculiX: stress and strain of a cube under uniform shear, in the .dat and the .frd file of one run
# Packages of Debian 12: calculix-ccx=2.20-1, libspooles2.2=2.2-14, libarpack2=3.8.0-3. Needs python3.
# Guess: both files have the six components in one order, uniform stress is the same in cells and at nodes to the six digits of the file,
#   and shear strains are angles, as in Abaqus, whose input it reads: 0.01, 0.02 and 0.03 for xy, yz and xz.
# Seen: .dat has xx, yy, zz, xy, xz, yz, and .frd has xx, yy, zz, xy, yz, zx. Values at nodes are 0.99996 of those in cells, since the
#   numbers that extrapolate them have four digits: a uniform 4 is 3.99984. Shear strains are half of the angle: 0.005, 0.01, 0.015.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install calculix-ccx=2.20-1 libspooles2.2=2.2-14 libarpack2=3.8.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

python3 - > cube.inp <<'P'
corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
print("*NODE, NSET=ALL")
for i, (x, y, z) in enumerate(corners, 1):
    print(f"{i}, {x}, {y}, {z}")
print("*ELEMENT, TYPE=C3D8, ELSET=CUBE\n1, 1, 2, 3, 4, 5, 6, 7, 8")
print("*MATERIAL, NAME=STEEL\n*ELASTIC\n1000, 0.25\n*SOLID SECTION, ELSET=CUBE, MATERIAL=STEEL")
print("*STEP\n*STATIC\n*BOUNDARY")
for i, (x, y, z) in enumerate(corners, 1):  # G = 400
    for direction, value in enumerate((0.01 * y + 0.03 * z, 0.02 * z, 0), 1):
        print(f"{i}, {direction}, {direction}, {value}")
print("*EL FILE\nS, E\n*EL PRINT, ELSET=CUBE\nS, E\n*END STEP")
P
usr/bin/ccx cube > log
python3 - <<'P' | tee output
import re
rows = open("cube.dat").read().splitlines()
heads = [i for i, row in enumerate(rows) if "integ.pnt" in row]
for i in heads:
    names = re.search(r"pnt\.,([a-z,]+)\)", rows[i]).group(1)
    print("cells:", names, ["%g" % abs(round(float(value), 12)) for value in rows[i + 2].split()[2:8]])
rows = open("cube.frd").read().splitlines()
for i, row in enumerate(rows):
    if row.startswith(" -4  STRESS") or row.startswith(" -4  TOSTRAIN"):
        names = [name.split()[1].lower() for name in rows[i + 1:i + 7]]
        values = [float(rows[i + 7][13 + 12 * k:25 + 12 * k]) for k in range(6)]
        print("nodes:", ",".join(names), ["%g" % abs(round(value, 12)) for value in values])
P
diff output - <<'P'
cells: sxx,syy,szz,sxy,sxz,syz ['0', '0', '0', '4', '12', '8']
cells: exx,eyy,ezz,exy,exz,eyz ['0', '0', '0', '0.005', '0.015', '0.01']
nodes: sxx,syy,szz,sxy,syz,szx ['0', '0', '0', '3.99984', '7.99968', '11.9995']
nodes: exx,eyy,ezz,exy,eyz,ezx ['0', '0', '0', '0.0049998', '0.0099996', '0.0149994']
P
