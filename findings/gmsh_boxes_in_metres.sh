#!/bin/bash
# Gmsh with OpenCASCADE: where bounding boxes end, and what a fragment glues, for bodies of any size
# Packages of Debian 12: libgmsh4.8=4.8.4+ds2-3, python3-gmsh=4.8.4+ds2-3. Needs the python3 of Debian with numpy.
# Guess: getEntitiesInBoundingBox finds the floor of a unit box by its own corners, as it does for the kernel of Gmsh. Tolerances are
#   relative: two cubes of 1 micrometre, given in metres, that are 9 % of their edge apart stay apart in a fragment.
# Seen: boxes of OpenCASCADE are larger by 1e-7 on each side, and none is found by its own corners. What is 1e-7 apart is glued,
#   whatever the size: the two cubes share a face (11 in place of 12). In micrometres the same cubes stay apart.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libgmsh4.8=4.8.4+ds2-3 python3-gmsh=4.8.4+ds2-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH PYTHONPATH="$work/usr/lib/python3/dist-packages"

cat > boxes.py <<'E'
import gmsh

gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
model = gmsh.model

model.add("own kernel")
corners = [model.geo.addPoint(x, y, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
sides = [model.geo.addLine(corners[i], corners[(i + 1) % 4]) for i in range(4)]
model.geo.addPlaneSurface([model.geo.addCurveLoop(sides)])
model.geo.synchronize()
print("own kernel: %d floor found" % len(model.getEntitiesInBoundingBox(0, 0, 0, 1, 1, 0, 2)))

model.add("OpenCASCADE")
model.occ.addBox(0, 0, 0, 1, 1, 1)
model.occ.synchronize()
print("OpenCASCADE: %d floors found, box from %g" % (len(model.getEntitiesInBoundingBox(0, 0, 0, 1, 1, 0, 2)), model.getBoundingBox(3, 1)[0]))

for unit, edge in ("metres", 1e-6), ("micrometres", 1.0):
    model.add(unit)
    cubes = [model.occ.addBox(x * edge, 0, 0, edge, edge, edge) for x in (0, 1.09)]
    model.occ.fragment([(3, cubes[0])], [(3, cubes[1])])
    model.occ.synchronize()
    print("cubes of 1 micrometre in %s: %d faces" % (unit, len(model.getEntities(2))))
E
/usr/bin/python3 boxes.py | tee seen
diff seen - <<'E'
own kernel: 1 floor found
OpenCASCADE: 0 floors found, box from -1e-07
cubes of 1 micrometre in metres: 11 faces
cubes of 1 micrometre in micrometres: 12 faces
E
