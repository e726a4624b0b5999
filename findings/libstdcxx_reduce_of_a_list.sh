#!/bin/bash
# libstdc++: std::reduce and std::transform_reduce without a policy, over a vector and over a list
# Packages of Debian 12: libstdc++-12-dev=12.2.0-14+deb12u1. Needs g++ 12.
# Guess: on one thread, with no policy, they add from the first to the last, as std::accumulate and std::inner_product do: bits change only
#   with std::execution::par. Whatever they do, the same numbers give the same sum.
# Seen: over a vector they add four numbers as (a + b) + (c + d) before they add them to the sum; over a list they go one by one. Of 1e16,
#   1, -1e16 and 1 a vector has the sum 0, and a list, as std::accumulate, 1. A prefix whose length is no multiple of 4 changes sums again:
#   the sum of a sum and the rest is not the sum of all.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libstdc++-12-dev=12.2.0-14+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done

cat > sums.cpp <<'C'
#include <cstdio>
#include <list>
#include <numeric>
#include <random>
#include <vector>

int main() {
    const std::vector<double> four{1e16, 1, -1e16, 1}, ones(4, 1.0);
    const std::list<double> list(four.begin(), four.end());
    std::printf("accumulate %g, inner_product %g\n", std::accumulate(four.begin(), four.end(), 0.0),
                std::inner_product(four.begin(), four.end(), ones.begin(), 0.0));
    std::printf("reduce of a vector %g, of a list %g, transform_reduce %g\n", std::reduce(four.begin(), four.end(), 0.0),
                std::reduce(list.begin(), list.end(), 0.0), std::transform_reduce(four.begin(), four.end(), ones.begin(), 0.0));

    std::mt19937 generator(1);
    std::vector<double> random(1000);
    for (double& number : random)
        number = std::generate_canonical<double, 53>(generator);
    const double all = std::reduce(random.begin(), random.end(), 0.0);
    for (const int cut : {500, 502}) {
        const double goes_on = std::reduce(random.begin() + cut, random.end(), std::reduce(random.begin(), random.begin() + cut, 0.0));
        std::printf("sum of 1000 in two parts from %d: %s\n", cut, goes_on == all ? "the same" : "another");
    }
}
C
g++ -std=c++20 -O1 -nostdinc++ -isystem usr/include/c++/12 -isystem usr/include/x86_64-linux-gnu/c++/12 sums.cpp -o sums
./sums | tee output
diff output - <<'E'
accumulate 1, inner_product 1
reduce of a vector 0, of a list 1, transform_reduce 0
sum of 1000 in two parts from 500: the same
sum of 1000 in two parts from 502: another
E
