#!/bin/bash
# Eigen: inverses of 3x3 matrices of edges, of cells of 1 mm and of 0.1 mm in metres
# Packages of Debian 12: libeigen3-dev=3.4.0-4. Needs g++.
# Guess: computeInverseWithCheck judges a matrix as FullPivLU does, relative to its own size: edges at right angles are invertible,
#   whatever their unit, and edges in one plane are not.
# Seen: the determinant is compared with 1e-12, a volume. Edges of 0.1 mm at right angles are "not invertible" in metres, and
#   computeInverseAndDetWithCheck leaves the inverse as it was. Edges of 1 km in one plane up to roundings are
#   invertible. FullPivLU is right in any unit.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libeigen3-dev=3.4.0-4
for deb in *.deb; do dpkg -x "$deb" .; done

cat > a.cpp <<'C'
#include <Eigen/Dense>
#include <cstdio>
void judge(const char* name, const Eigen::Matrix3d& edges) {
    Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
    double volume;
    bool accepted;
    edges.computeInverseAndDetWithCheck(inverse, volume, accepted);
    std::printf("%s: %sinvertible, %s, FullPivLU: %sinvertible\n", name, accepted ? "" : "not ", inverse.isZero(0) ? "left as it was" : "inverted",
                edges.fullPivLu().isInvertible() ? "" : "not ");
}
int main() {
    const Eigen::Matrix3d cube = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d flat;  // three edges in one plane, up to the rounding of the third
    flat << 0.1, 0.2, 0.1 + 0.2, 0.3, 0.7, 0.3 + 0.7, 0.9, 0.4, 0.9 + 0.4;
    judge("cube of 1 mm in m", 1e-3 * cube);
    judge("cube of 0.1 mm in m", 1e-4 * cube);
    judge("cube of 0.1 mm in mm", 1e-1 * cube);
    judge("flat, 1 m", flat);
    judge("flat, 1 km", 1e3 * flat);
    judge("flat, 1000 km", 1e6 * flat);
}
C
g++ -O2 -I"$work/usr/include/eigen3" a.cpp -o a
./a | tee output
diff output - <<'C'
cube of 1 mm in m: invertible, inverted, FullPivLU: invertible
cube of 0.1 mm in m: not invertible, left as it was, FullPivLU: invertible
cube of 0.1 mm in mm: invertible, inverted, FullPivLU: invertible
flat, 1 m: not invertible, left as it was, FullPivLU: not invertible
flat, 1 km: invertible, inverted, FullPivLU: not invertible
flat, 1000 km: invertible, inverted, FullPivLU: not invertible
C
