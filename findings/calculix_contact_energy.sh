#!/bin/bash
# CalculiX: energy of an explicit impact against the stiffness of its contact
# Packages of Debian 12: calculix-ccx=2.20-1, libspooles2.2=2.2-14, libarpack2=3.8.0-3. Needs python3.
# Guess: two elastic cubes that meet at 5 m/s each (25 J, nothing damps) keep their energy within some per cent in *DYNAMIC,
#   EXPLICIT with contact by penalty, whose stiffness changes the penetration, since the program chooses the step.
# Seen: internal plus kinetic energy at the end is 25 J at a stiffness of 1e9 N/m^3, 32 J at 1e10 and 800 J at 1e11 (the cells
#   have E/h = 2e10 N/m^3), without a warning: the step follows from the cells and not from the contact.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install calculix-ccx=2.20-1 libspooles2.2=2.2-14 libarpack2=3.8.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PATH="$work/usr/bin:$PATH" PYTHONPATH="$work/usr/lib/python3/dist-packages"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > make.py <<'E'
import itertools, sys
n, h, gap = 2, 0.05, 1e-4
number, nodes, cells = {}, [], ([], [])
for b in range(2):
    for k, j, i in itertools.product(range(n + 1), repeat=3):
        nodes.append(f"{i * h}, {j * h}, {b * (n * h + gap) + k * h}")
        number[b, i, j, k] = len(nodes)
for b in range(2):
    for k, j, i in itertools.product(range(n), repeat=3):
        cells[b].append([number[b, i + x, j + y, k + z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))])
lines = ["*NODE"] + [f"{i + 1}, {x}" for i, x in enumerate(nodes)]
for b in range(2):
    lines += [f"*ELEMENT, TYPE=C3D8, ELSET=E{b}"] + [f"{8 * b + e + 1}, " + ", ".join(map(str, c)) for e, c in enumerate(cells[b])]
    lines += [f"*NSET, NSET=N{b}"] + [str(27 * b + i + 1) for i in range(27)]
lines += ["*ELSET, ELSET=ALL", "E0, E1", "*MATERIAL, NAME=M", "*ELASTIC", "1e9, 0", "*DENSITY", "1000", "*SOLID SECTION, ELSET=ALL, MATERIAL=M"]
lines += ["*SURFACE, NAME=TOP"] + [f"{e}, S2" for e in range(5, 9)] + ["*SURFACE, NAME=BOTTOM"] + [f"{e}, S1" for e in range(9, 13)]
lines += ["*SURFACE INTERACTION, NAME=C", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", sys.argv[1]]
lines += ["*CONTACT PAIR, INTERACTION=C, TYPE=SURFACE TO SURFACE", "BOTTOM, TOP"]
lines += ["*INITIAL CONDITIONS, TYPE=VELOCITY", "N0, 3, 5.", "N1, 3, -5.", "*STEP, NLGEOM, INC=100000", "*DYNAMIC, EXPLICIT", "1e-6, 1e-3"]
lines += ["*EL PRINT, ELSET=ALL, TOTALS=ONLY, FREQUENCY=100000", "ELSE, ELKE", "*END STEP"]
print("\n".join(lines))
E
for stiffness in 1e9 1e10 1e11; do
    /usr/bin/python3 make.py $stiffness > a.inp
    ccx a > log 2>&1
    awk -v k=$stiffness '/total/ {getline; getline; sum += $1} END {printf "stiffness %s: %.0f of 25 J\n", k, sum}' a.dat
done | tee output
diff output - <<'E'
stiffness 1e9: 25 of 25 J
stiffness 1e10: 32 of 25 J
stiffness 1e11: 801 of 25 J
E
