#!/bin/bash
# Eigen: norms, least and largest entries of a residual or of time steps, one of which is NaN
# Packages of Debian 12: libeigen3-dev=3.4.0-4. Needs g++.
# Guess: a norm that holds NaN is NaN, so that a test of convergence fails. The least of time steps is NaN as well, or NaN is passed over
#   always.
# Seen: norm() is NaN wherever the NaN stands. lpNorm<Infinity>() and minCoeff() of 1,000 numbers are NaN where it stands first, and pass over
#   it at all 999 other places: a residual converges without its worst entry. With minCoeff<PropagateNaN>() they are NaN always, and
#   lpNorm has no such form.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libeigen3-dev=3.4.0-4
for deb in *.deb; do dpkg -x "$deb" .; done

cat > a.cpp <<'C'
#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <limits>
int main() {
    const int n = 1000;
    int norm = 0, largest = 0, least = 0, first = 0, propagated = 0;
    for (int place = 0; place < n; ++place) {
        Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0);
        x[place] = std::numeric_limits<double>::quiet_NaN();
        norm += std::isnan(x.norm());
        largest += std::isnan(x.lpNorm<Eigen::Infinity>());
        least += std::isnan(x.minCoeff());
        propagated += std::isnan(x.minCoeff<Eigen::PropagateNaN>());
        if (place == 0) first = std::isnan(x.lpNorm<Eigen::Infinity>()) + std::isnan(x.minCoeff());
    }
    std::printf("NaN at %d places: norm %d, lpNorm<Infinity> %d, minCoeff %d, minCoeff<PropagateNaN> %d\n", n, norm, largest, least, propagated);
    std::printf("NaN at the first place: %d of lpNorm<Infinity> and minCoeff are NaN\n", first);
}
C
for options in -O0 -O2; do
    g++ $options -I"$work/usr/include/eigen3" a.cpp -o a
    ./a
done | tee output
diff output - <<'C'
NaN at 1000 places: norm 1000, lpNorm<Infinity> 1, minCoeff 1, minCoeff<PropagateNaN> 1000
NaN at the first place: 2 of lpNorm<Infinity> and minCoeff are NaN
NaN at 1000 places: norm 1000, lpNorm<Infinity> 1, minCoeff 1, minCoeff<PropagateNaN> 1000
NaN at the first place: 2 of lpNorm<Infinity> and minCoeff are NaN
C
