#!/bin/bash
# Eigen: the sum of the same 1,000 numbers at two addresses
# Packages of Debian 12: libeigen3-dev=3.4.0-4. Needs g++.
# Guess: one program on one thread adds the entries of a vector in the same order, wherever the vector lies. Restarts and parts of larger
#   arrays then give bitwise identical sums.
# Seen: sum() and mean() of a vector and of its copy that lies 8 bytes further, a tail of a larger vector, differ in three of four cases: the
#   packets begin at the next address that is a multiple of 16. dot, squaredNorm and products with a matrix are the same.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libeigen3-dev=3.4.0-4
for deb in *.deb; do dpkg -x "$deb" .; done

cat > a.cpp <<'C'
#include <Eigen/Dense>
#include <cstdint>
#include <cstdio>
std::uint64_t state = 1;
double number() {  // in [-1, 1), the same on every machine
    state = 6364136223846793005u * state + 1442695040888963407u;
    return double(std::int64_t(state)) * 0x1p-63;
}
int main() {
    const int n = 1000;
    const auto draw = [] { return number(); };
    int sum = 0, mean = 0, dot = 0, norm = 0, product = 0;
    for (int i = 0; i < 100; ++i) {
        const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(n, draw), other = Eigen::VectorXd::NullaryExpr(n, draw);
        const Eigen::MatrixXd matrix = Eigen::MatrixXd::NullaryExpr(9, n, draw);
        Eigen::VectorXd larger(n + 1);
        larger << 0.0, x;
        const auto copy = larger.tail(n);
        sum += x.sum() != copy.sum();
        mean += x.mean() != copy.mean();
        dot += x.dot(other) != copy.dot(other);
        norm += x.squaredNorm() != copy.squaredNorm();
        product += (matrix * x) != (matrix * copy);
    }
    std::printf("of 100 cases differ: sum %d, mean %d, dot %d, squaredNorm %d, matrix * vector %d\n", sum, mean, dot, norm, product);
}
C
g++ -O2 -I"$work/usr/include/eigen3" a.cpp -o a
./a | tee output
diff output - <<'C'
of 100 cases differ: sum 74, mean 73, dot 0, squaredNorm 0, matrix * vector 0
C
