#!/bin/bash
# MuJoCo: how deep spheres rest in a plane, alone and below another sphere
# Packages of Debian 12: libmujoco-dev=2.2.2-3, libmujoco2.2.2=2.2.2-3. Needs gcc.
# Guess: contact is a spring with a damper, as solref describes it by a time and a ratio: a body that is heavier lies deeper, in the
#   ratio of the weights, and below a stack the lowest contact is the deepest.
# Seen: spheres of 10 g, 1 kg and 1000 kg all lie 0.142 mm deep, since the spring is scaled by the mass that it moves. Below another sphere
#   the depth follows the ratio of their masses: 1 kg below 10 g lies 0.144 mm deep, below 1 kg 0.267 mm, below 100 kg 6.61 mm. The contact
#   between the two is as deep as the lower one, whatever it bears.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libmujoco-dev=2.2.2-3 libmujoco2.2.2=2.2.2-3
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

cat > a.c <<'C'
#include <mujoco/mujoco.h>
#include <stdio.h>
enum { size = 2000 };
static void body(char* text, double height, double mass) {
    sprintf(text, "<body pos='0 0 %g'><joint type='slide' axis='0 0 1'/><geom type='sphere' size='0.1' mass='%g'/></body>", height, mass);
}
static void rest(double lower, double upper) {  // masses [kg] of the spheres, none above if 0
    char text[size], first[size / 3], second[size / 3] = "", error[size];
    body(first, 0.1, lower);
    if (upper > 0) body(second, 0.3, upper);
    sprintf(text, "<mujoco><option iterations='1000' tolerance='1e-14'/><worldbody><geom type='plane' size='9 9 1'/>%s%s</worldbody></mujoco>",
            first, second);
    FILE* file = fopen("model.xml", "w");
    fputs(text, file);
    fclose(file);
    mjModel* model = mj_loadXML("model.xml", NULL, error, size);
    mjData* data = mj_makeData(model);
    while (data->time < 20) mj_step(model, data);
    const double z = data->xpos[5];
    printf("%g kg", lower);
    if (upper > 0) printf(" below %g kg", upper);
    printf(": %.3g mm in the plane", 1e3 * (0.1 - z));
    if (upper > 0) printf(", %.3g mm between them", 1e3 * (0.2 - (data->xpos[8] - z)));
    printf("\n");
    mj_deleteData(data);
    mj_deleteModel(model);
}
int main(void) {
    rest(0.01, 0);
    rest(1, 0);
    rest(1000, 0);
    rest(1, 0.01);
    rest(1, 1);
    rest(1, 100);
}
C
gcc a.c -I"$work/usr/include" -L"$work/usr/lib/x86_64-linux-gnu" -lmujoco -o a
./a | tee output
diff output - <<'C'
0.01 kg: 0.142 mm in the plane
1 kg: 0.142 mm in the plane
1000 kg: 0.142 mm in the plane
1 kg below 0.01 kg: 0.144 mm in the plane, 0.144 mm between them
1 kg below 1 kg: 0.267 mm in the plane, 0.267 mm between them
1 kg below 100 kg: 6.61 mm in the plane, 6.61 mm between them
C
