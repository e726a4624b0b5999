#!/bin/bash
# MuJoCo: mass and inertia of a body whose mesh is not convex
# Packages of Debian 12: libmujoco-dev=2.2.2-3, libmujoco2.2.2=2.2.2-3. Needs gcc and python3.
# Guess: a closed mesh with a density gets the mass of its volume, since an exact integral over its triangles is at hand; or
#   that of its convex hull, with which it collides.
# Seen: an angle of three unit cubes at 1,000 kg/m^3 has neither 3,000 kg nor the 3,500 kg of its hull but 3,416 kg; a
#   unit cube has its 1,000 kg. With exactmeshinertia="true" of the compiler, which is off by default, it is 3,000 kg.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libmujoco-dev=2.2.2-3 libmujoco2.2.2=2.2.2-3 libccd2=2.1-2+b1 libqhull-r8.0=2020.2-5 libtinyxml2-9=9.0.0+dfsg-3.1 \
    liblodepng0=0.0~git20220618.b4ed2cd-3
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

# A prism with triangles `top` over the outline `corner`, of height 1, as a binary STL.
cat > prism.py <<'E'
import struct
def prism(name, corner, top):
    n, t = len(corner), []
    for a, b, c in top:
        t += [[(*corner[i], 1) for i in (a, b, c)], [(*corner[i], 0) for i in (a, c, b)]]
    for i in range(n):
        p, q = corner[i], corner[(i + 1) % n]
        t += [[(*p, 0), (*q, 0), (*q, 1)], [(*p, 0), (*q, 1), (*p, 1)]]
    with open(name, "wb") as file:
        file.write(bytes(80) + struct.pack("<I", len(t)))
        for triangle in t:
            file.write(struct.pack("<3f", 0, 0, 0) + b"".join(struct.pack("<3f", *p) for p in triangle) + bytes(2))
prism("cube.stl", [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
prism("angle.stl", [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)])
E
python3 prism.py
cat > a.c <<'E'
#include <mujoco/mujoco.h>
#include <stdio.h>
int main(int count, char** files) {
    char error[1000];
    for (int k = 1; k < count; ++k) {
        mjModel* model = mj_loadXML(files[k], NULL, error, sizeof error);
        if (!model) return puts(error), 1;
        printf("%s: cube %.0f kg, angle %.0f kg\n", files[k], model->body_mass[1], model->body_mass[2]);
    }
}
E
scene() {  # exactmeshinertia
    echo "<mujoco><compiler exactmeshinertia='$1'/><asset><mesh name='c' file='cube.stl'/><mesh name='a' file='angle.stl'/></asset>
        <worldbody><body><freejoint/><geom type='mesh' mesh='c' density='1000'/></body>
        <body pos='9 0 0'><freejoint/><geom type='mesh' mesh='a' density='1000'/></body></worldbody></mujoco>"
}
scene false > usual.xml
scene true > exact.xml
gcc a.c -o a -I"$include" -L"$lib" -lmujoco -Wl,-rpath-link,"$libraries"
./a usual.xml exact.xml | tee output
diff output - <<'E'
usual.xml: cube 1000 kg, angle 3416 kg
exact.xml: cube 1000 kg, angle 3000 kg
E
