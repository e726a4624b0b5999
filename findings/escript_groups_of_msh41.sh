#!/bin/bash
# escript (finley): groups of a mesh of Gmsh, in MSH 2.2 and in MSH 4.1, which Gmsh writes by default
# Packages of Debian 12: python3-escript=5.6-4+b3, libboost-numpy1.74.0=1.74.0+ds1-21, libgmsh4.8=4.8.4+ds2-3, python3-gmsh=4.8.4+ds2-3.
#   Needs the python3 of Debian with numpy.
# Guess: ReadGmsh reads both, and a value that is set by the name of a physical volume is that of its cells.
# Seen: both are read, names too. Of MSH 4.1 the cells have the numbers of their elementary volumes (1, 2) for those of the physical ones
#   (7, 8), which the names stand for: a value set by name reaches no cell, in silence. Of MSH 2.2 it is right.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-escript=5.6-4+b3 libboost-numpy1.74.0=1.74.0+ds1-21 libgmsh4.8=4.8.4+ds2-3 python3-gmsh=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3-escript:$work/usr/lib/python3/dist-packages" PYTHONWARNINGS=ignore

cat > make.py <<'E'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
for number, name in (1, "left"), (2, "right"):
    gmsh.model.occ.addBox(2 * number, 0, 0, 1, 1, 1)
    gmsh.model.occ.synchronize()
    gmsh.model.addPhysicalGroup(3, [number], 6 + number)
    gmsh.model.setPhysicalName(3, 6 + number, name)
gmsh.model.mesh.generate(3)
for version in 2.2, 4.1:
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.write(f"{version}.msh")
E
cat > read.py <<'E'
from esys.escript import Function, Scalar, integrate
from esys.finley import ReadGmsh

for version in "2.2", "4.1":
    mesh = ReadGmsh(version + ".msh", 3)
    density = Scalar(0, Function(mesh))
    density.setTaggedValue("left", 1000)
    print("MSH %s: left is tag %d, cells have %s, mass %.0f of 1000" %
          (version, mesh.getTag("left"), sorted(Function(mesh).getListOfTags()), integrate(density)))
E
/usr/bin/python3 make.py
/usr/bin/python3 read.py 2> /dev/null | tee seen
diff seen - <<'E'
MSH 2.2: left is tag 7, cells have [7, 8], mass 1000 of 1000
MSH 4.1: left is tag 7, cells have [1, 2], mass 0 of 1000
E
