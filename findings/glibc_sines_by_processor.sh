#!/bin/bash
# glibc: one program on a processor with fused multiply-add, and the same program where glibc does not use it
# Packages of Debian 12: libc6=2.36-9+deb12u14. Needs gcc and a processor with fused multiply-add (FMA) and AVX2.
# Guess: bits change with compilers and versions of the library. One binary beside one libm computes bitwise identical results on all
#   processors of its kind, unless the program asks which one it is on.
# Seen: libm asks. With its variants for FMA, sin, cos, exp, log, pow and atan2 have another last bit for up to 67 of 100,000 arguments,
#   tan for two, cbrt and hypot for none. A rotation or a law with an exponential has other bits on an older processor, and a chaotic motion
#   follows them. GLIBC_TUNABLES makes a new processor compute as an old one.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libc6=2.36-9+deb12u14
for deb in *.deb; do dpkg -x "$deb" .; done
library="$work/lib/x86_64-linux-gnu"

cat > a.c <<'C'
#include <math.h>
#include <stdio.h>
int main(void) {
    for (int i = 0; i < 100000; ++i) {
        const double x = 0.1 + i * 0x1p-13;
        printf("%a %a %a %a %a %a %a %a %a\n", sin(x), cos(x), exp(x), log(x), pow(x, 1.5), atan2(x, 1), tan(x), cbrt(x), hypot(x, 1.1));
    }
}
C
gcc -O2 -fno-builtin -ffp-contract=off a.c -lm -o a
run() { "$library/ld-linux-x86-64.so.2" --library-path "$library" ./a; }
run > new
GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2 run > old
awk 'NR == FNR { for (i = 1; i <= NF; ++i) seen[NR, i] = $i; next }
     { for (i = 1; i <= NF; ++i) differ[i] += $i != seen[FNR, i] }
     END { split("sin cos exp log pow atan2 tan cbrt hypot", name, " ")
           for (i = 1; i <= 9; ++i) printf "%s %d%s", name[i], differ[i], i < 9 ? ", " : " of 100000\n" }' new old | tee output
diff output - <<'C'
sin 62, cos 63, exp 67, log 1, pow 67, atan2 26, tan 2, cbrt 0, hypot 0 of 100000
C
