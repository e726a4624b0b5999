#!/bin/bash
# MuJoCo: distance of two boxes that overlap
# Packages of Debian 12: libmujoco-dev=2.2.2-3, libmujoco2.2.2=2.2.2-3. Needs gcc.
# Guess: contact.dist of a unit box that stands on a unit box is the gap where they are apart and the depth, with a minus, where
#   they overlap, as for a sphere on a box.
# Seen: apart it is the gap, 1 mm. At an overlap of 10 mm the four contacts of the boxes have -5 mm, half of it, and that of a
#   sphere on a box -10 mm. So the force that answers a depth has another stiffness below a box than below a sphere.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libmujoco-dev=2.2.2-3 libmujoco2.2.2=2.2.2-3 libccd2=2.1-2+b1 libqhull-r8.0=2020.2-5 libtinyxml2-9=9.0.0+dfsg-3.1 \
    liblodepng0=0.0~git20220618.b4ed2cd-3
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.c <<'E'
#include <mujoco/mujoco.h>
#include <stdio.h>
int main(int count, char** files) {
    char error[1000];
    for (int k = 1; k < count; ++k) {
        mjModel* model = mj_loadXML(files[k], NULL, error, sizeof error);
        if (!model) return puts(error), 1;
        mjData* data = mj_makeData(model);
        mj_forward(model, data);
        printf("%s:", files[k]);
        for (int i = 0; i < data->ncon; ++i) printf(" %.2f", 1e3 * data->contact[i].dist);
        puts(" mm");
    }
}
E
scene() {  # what is above, its height
    echo "<mujoco><default><geom margin='0.01'/></default><worldbody><geom type='box' size='.5 .5 .5'/>
        <body pos='0 0 $2'><freejoint/><geom type='$1' size='.5 .5 .5'/></body></worldbody></mujoco>"
}
scene box 1.001 > box_apart.xml
scene box 0.99 > box_within.xml
scene sphere 1.001 > sphere_apart.xml
scene sphere 0.99 > sphere_within.xml
gcc a.c -o a -I"$include" -L"$lib" -lmujoco -Wl,-rpath-link,"$libraries"
./a box_apart.xml box_within.xml sphere_apart.xml sphere_within.xml | tee output
diff output - <<'E'
box_apart.xml: 1.00 1.00 1.00 1.00 mm
box_within.xml: -5.00 -5.00 -5.00 -5.00 mm
sphere_apart.xml: 1.00 mm
sphere_within.xml: -10.00 mm
E
