#!/bin/bash
# GCC: a product of two vectors in the plane, compiled as C and as C++ for a processor with fused multiply-add
# Packages of Debian 12: gcc-12=12.2.0-14+deb12u1, g++-12 and cpp-12 of the same version. Needs python3.
# Guess: strict standards, -std=c17 and -std=c++20, keep a * b - c * d as it is written; -std=gnu17 and -std=gnu++20 may fuse it. One
#   function in a C library and in a C++ program has the same bits, and the product of a vector with itself is exactly 0 in both.
# Seen: c17 alone keeps it. C++ is fused with c++20 as with gnu++20: one of the two products is not rounded. That of (0.1, 0.3) with itself
#   is 1.7e-18, so that a point lies beside a line that goes through it. With -ffp-contract=off none is fused.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
version=12.2.0-14+deb12u1
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install gcc-12=$version g++-12=$version cpp-12=$version
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH=$(find "$work" -name "*.so*" -printf "%h\n" | sort -u | paste -sd:)
export LD_LIBRARY_PATH

echo "double area(double ax, double ay, double bx, double by) { return ax * by - ay * bx; }" | tee area.c > area.cpp
fused() {
    usr/bin/x86_64-linux-gnu-"$1" -O2 -march=haswell -S "${@:2}" -o area.s
    grep -cE "vfn?m(add|sub)" area.s || true
}
{
    for standard in c17 gnu17; do echo "$standard: $(fused gcc-12 -std=$standard area.c) fused"; done
    for standard in c++20 gnu++20; do echo "$standard: $(fused g++-12 -std=$standard area.cpp) fused"; done
    echo "c++20, off: $(fused g++-12 -std=c++20 -ffp-contract=off area.cpp) fused"
    python3 - <<'P'
from fractions import Fraction
x, y = 0.1, 0.3
print("(%g, %g) with itself: %g, fused %.1e" % (x, y, x * y - y * x, float(Fraction(x) * Fraction(y) - Fraction(y * x))))
P
} | tee output
diff output - <<'P'
c17: 0 fused
gnu17: 1 fused
c++20: 1 fused
gnu++20: 1 fused
c++20, off: 0 fused
(0.1, 0.3) with itself: 0, fused 1.7e-18
P
