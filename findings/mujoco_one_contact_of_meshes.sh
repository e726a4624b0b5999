#!/bin/bash
# MuJoCo: a cube that stands on a cube, as boxes and as meshes
# Packages of Debian 12: libmujoco-dev=2.2.2-3, libmujoco2.2.2=2.2.2-3. Needs gcc and python3.
# Guess: a unit cube that stands on another, 1 mm deep, has the same contacts as a box and as a mesh of 12 triangles: one at
#   each of four corners, or some that carry it as evenly.
# Seen: as boxes 4 contacts, one at each corner. As meshes 1, at a corner of the common face: what stands on all of its face is
#   held at one point.
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
#include <math.h>
#include <mujoco/mujoco.h>
#include <stdio.h>
int main(int count, char** files) {
    char error[1000];
    for (int k = 1; k < count; ++k) {
        mjModel* model = mj_loadXML(files[k], NULL, error, sizeof error);
        if (!model) return puts(error), 1;
        mjData* data = mj_makeData(model);
        mj_forward(model, data);
        printf("%s: %d contacts, at distances from the middle of", files[k], data->ncon);
        for (int i = 0; i < data->ncon; ++i)
            printf(" (%.2f, %.2f)", fabs(data->contact[i].pos[0] - 0.5), fabs(data->contact[i].pos[1] - 0.5));
        puts(" m");
    }
}
E
echo "<mujoco><worldbody><geom type='box' size='.5 .5 .5' pos='.5 .5 .5'/>
    <body pos='.5 .5 1.499'><freejoint/><geom type='box' size='.5 .5 .5'/></body></worldbody></mujoco>" > boxes.xml
# What a mesh is placed by is its corner here: its own centre is moved back by MuJoCo.
echo "<mujoco><asset><mesh name='c' file='cube.stl'/></asset><worldbody><geom type='mesh' mesh='c'/>
    <body pos='0 0 0.999'><freejoint/><geom type='mesh' mesh='c'/></body></worldbody></mujoco>" > meshes.xml
gcc a.c -o a -I"$include" -L"$lib" -lmujoco -lm -Wl,-rpath-link,"$libraries"
./a boxes.xml meshes.xml | tee output
diff output - <<'E'
boxes.xml: 4 contacts, at distances from the middle of (0.50, 0.50) (0.50, 0.50) (0.50, 0.50) (0.50, 0.50) m
meshes.xml: 1 contacts, at distances from the middle of (0.50, 0.50) m
E
