#!/bin/bash
# Gmsh with OpenCASCADE: a STEP file whose unit is the metre
# Packages of Debian 12: libgmsh4.8=4.8.4+ds2-3, python3-gmsh=4.8.4+ds2-3. Needs the python3 of Debian with numpy.
# Guess: coordinates come in as they stand in the file: a box of 1 m has an edge of 1.
# Seen: the unit of the file is read, and all is turned into millimetres: the edge is 1000. With Geometry.OCCTargetUnit = "M" it is 1, and
#   that of the same numbers in a file in millimetres is 0.001. A density in SI beside a mesh made by default is wrong by 1e9 in its mass.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libgmsh4.8=4.8.4+ds2-3 python3-gmsh=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > step.py <<'E'
import pathlib

import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.add("box")
gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
gmsh.model.occ.synchronize()
gmsh.write("millimetres.step")
text = pathlib.Path("millimetres.step").read_text()
assert text.count("SI_UNIT(.MILLI.,.METRE.)") == 1
pathlib.Path("metres.step").write_text(text.replace("SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT($,.METRE.)"))

for target in "", "M":
    if target:
        gmsh.option.setString("Geometry.OCCTargetUnit", target)
    for name in "metres", "millimetres":
        gmsh.model.add(name + target)
        gmsh.model.occ.importShapes(name + ".step")
        gmsh.model.occ.synchronize()
        print("seen: edge of a file in %s, target %s: %.4g" % (name, target or "as it is", gmsh.model.occ.getMass(3, 1) ** (1 / 3)))
E
/usr/bin/python3 step.py | grep -o "seen.*" | tee seen
diff seen - <<'E'
seen: edge of a file in metres, target as it is: 1000
seen: edge of a file in millimetres, target as it is: 1
seen: edge of a file in metres, target M: 1
seen: edge of a file in millimetres, target M: 0.001
E
