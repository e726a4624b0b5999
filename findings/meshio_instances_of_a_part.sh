#!/bin/bash
# meshio: an Abaqus file with a part that stands in its assembly twice
# Packages of Debian 12: python3-meshio=7.0.0-3. Needs the python3 of Debian with numpy.
# Guess: two instances of a part, one of them moved by 5 m, are two bodies, or meshio says that it cannot place them.
# Seen: one body, where the part was drawn. *INSTANCE is passed over: neither its number nor its move is read, and nothing is printed.
#   A move of the only instance is lost as well: parts of an assembly that stand side by side lie in each other.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-meshio=7.0.0-3
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"

part() {
    printf '%s\n' "*PART, NAME=$1" "*NODE" "1, 0, 0, 0" "2, 1, 0, 0" "3, 0, 1, 0" "4, 0, 0, 1" "*ELEMENT, TYPE=C3D4, ELSET=$1" "1, 1, 2, 3, 4" "*END PART"
}
{ part P && printf '%s\n' "*ASSEMBLY, NAME=A" "*INSTANCE, NAME=P-1, PART=P" "*END INSTANCE" \
    "*INSTANCE, NAME=P-2, PART=P" "5., 0., 0." "*END INSTANCE" "*END ASSEMBLY"; } > twice.inp
{ part P && printf '%s\n' "*ASSEMBLY, NAME=A" "*INSTANCE, NAME=P-1, PART=P" "5., 0., 0." "*END INSTANCE" "*END ASSEMBLY"; } > moved.inp
/usr/bin/python3 - <<'P' 2>&1 | tee output
import meshio
for name in "twice", "moved":
    mesh = meshio.read(name + ".inp")
    x = mesh.points[:, 0]
    print(f"{name}: {sum(len(block.data) for block in mesh.cells)} cells, x from {x.min():g} to {x.max():g}")
P
diff output - <<'P'
twice: 1 cells, x from 0 to 1
moved: 1 cells, x from 0 to 1
P
