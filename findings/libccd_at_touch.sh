#!/bin/bash
# libccd: GJK, MPR and their depths for two unit boxes near touch
# Packages of Debian 12: libccd-dev=2.1-2+b1, libccd2=2.1-2+b1. Needs gcc.
# Guess: GJK and MPR agree on whether boxes overlap, except by rounding at touch, and both give the depth to some 1e-4, the
#   default tolerance.
# Seen: boxes 1 nm apart overlap for GJK, with a depth of +1e-9, and do not for MPR. At an overlap of 0.1 m, ccdGJKPenetration
#   returns 0 (success) with a depth of 1e-16; that of MPR is right. At 1e-6 GJK has 0.58 of the depth.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libccd-dev=2.1-2+b1 libccd2=2.1-2+b1
for deb in *.deb; do dpkg -x "$deb" .; done
include="$work/usr/include" lib="$work/usr/lib/x86_64-linux-gnu"
libraries=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH="$libraries"

cat > a.c <<'E'
#include <ccd/ccd.h>
#include <math.h>
#include <stdio.h>
typedef struct { double center[3]; } Box;  // unit cubes
static void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* v) {
    const double* c = ((const Box*)object)->center;
    for (int k = 0; k < 3; ++k) v->v[k] = c[k] + copysign(0.5, direction->v[k]);
}
static void center(const void* object, ccd_vec3_t* v) {
    for (int k = 0; k < 3; ++k) v->v[k] = ((const Box*)object)->center[k];
}
int main(void) {
    const double gaps[] = {1e-6, 1e-9, -1e-6, -0.1};
    for (int i = 0; i < 4; ++i) {
        const Box one = {{0, 0, 0}}, two = {{1 + gaps[i], 0.2, 0.2}};
        ccd_t ccd;
        CCD_INIT(&ccd);
        ccd.support1 = ccd.support2 = support;
        ccd.center1 = ccd.center2 = center;
        ccd.max_iterations = 1000;
        double gjk = NAN, mpr = NAN;
        ccd_vec3_t direction, position;
        const int found_gjk = ccdGJKPenetration(&one, &two, &ccd, &gjk, &direction, &position) == 0;
        const int found_mpr = ccdMPRPenetration(&one, &two, &ccd, &mpr, &direction, &position) == 0;
        printf("gap %g: GJK %s %.2g, MPR %s %.2g\n", gaps[i], found_gjk ? "overlap of" : "apart", found_gjk ? gjk : 0.0,
               found_mpr ? "overlap of" : "apart", found_mpr ? mpr : 0.0);
    }
}
E
gcc -I"$include" a.c -L"$lib" -lccd -lm -o a
./a | sed 's/e-17/e-16/; s/[0-9.]*e-16/1e-16/' | tee output
diff output - <<'E'
gap 1e-06: GJK apart 0, MPR apart 0
gap 1e-09: GJK overlap of 1e-09, MPR apart 0
gap -1e-06: GJK overlap of 5.8e-07, MPR overlap of 1e-06
gap -0.1: GJK overlap of 1e-16, MPR overlap of 0.1
E
