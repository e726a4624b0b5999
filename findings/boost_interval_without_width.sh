#!/bin/bash
# Boost.Interval: products and quotients of two numbers, with and without optimization
# Packages of Debian 12: libboost1.74-dev=1.74.0+ds1-21. Needs g++ 12.
# Guess: interval<double> contains the exact result, whatever the level of optimization: this is what it is for, and its arithmetic sets
#   the direction of rounding by itself.
# Seen: with -O2 no quotient of two numbers, and with -O3 no product either, contains the exact result unless that is a double: both
#   bounds are one value. Probably GCC computes it once, as both look alike to it. No width is left that would tell. With -frounding-math, or
#   without optimization, all contain it. A sign that is decided by such a filter is taken for proven and can be wrong.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libboost1.74-dev=1.74.0+ds1-21
for deb in *.deb; do dpkg -x "$deb" .; done

cat > a.cpp <<'C'
#include <boost/numeric/interval.hpp>
#include <cstdint>
#include <cstdio>
using Interval = boost::numeric::interval<double>;
using Exact = __float128;  // 113 bits: products of two doubles in [1, 2), and their differences, are exact
std::uint64_t state = 1;
double number() {  // in [1, 2), the same on every machine
    state = 6364136223846793005u * state + 1442695040888963407u;
    return 1.0 + double(state >> 12) * 0x1p-52;
}
int main() {
    int product = 0, quotient = 0, difference = 0, widths = 0;
    for (int i = 0; i < 1000; ++i) {
        const double a = number(), b = number();
        const Interval x(a), y(b), xy = x * y, x_y = x / y, squares = x * x - y * y;
        product += Exact(xy.lower()) > Exact(a) * b || Exact(xy.upper()) < Exact(a) * b;
        quotient += Exact(x_y.lower()) * b > a || Exact(x_y.upper()) * b < a;
        const Exact exact = Exact(a) * a - Exact(b) * b;
        difference += squares.lower() > exact || squares.upper() < exact;
        widths += x_y.lower() < x_y.upper();
    }
    std::printf("of 1000 miss the exact value: x * y %d, x / y %d, x * x - y * y %d; quotients with a width %d\n", product, quotient,
                difference, widths);
}
C
for options in "-O0" "-O2" "-O3" "-O3 -frounding-math"; do
    read -ra list <<< "$options"
    g++ "${list[@]}" -I"$work/usr/include" a.cpp -o a
    echo "$options: $(./a)"
done | tee output
diff output - <<'C'
-O0: of 1000 miss the exact value: x * y 0, x / y 0, x * x - y * y 0; quotients with a width 1000
-O2: of 1000 miss the exact value: x * y 0, x / y 1000, x * x - y * y 0; quotients with a width 0
-O3: of 1000 miss the exact value: x * y 1000, x / y 1000, x * x - y * y 951; quotients with a width 0
-O3 -frounding-math: of 1000 miss the exact value: x * y 0, x / y 0, x * x - y * y 0; quotients with a width 1000
C
