#!/bin/bash
# nanoflann: points within a radius of another, 250 mm from each other on a line
# Packages of Debian 12: libnanoflann-dev=1.4.3+ds-2. Needs g++.
# Guess: radiusSearch(x, 0.4, ...) finds the points up to 0.4 m away and says how far they are; a point at x itself is found always.
# Seen: with L2_Simple_Adaptor the radius and the distances found are squares of lengths: 0.4 finds points 0.5 m away, and says 0.25.
#   With a radius of 1 length and square are one, so that such a test shows nothing. Points *at* the radius are left out: 0.0625 finds
#   none at 0.25 m, as the next neighbours of a grid are, and with radius 0 the point at x is missing.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libnanoflann-dev=1.4.3+ds-2
for deb in *.deb; do dpkg -x "$deb" .; done

cat > a.cpp <<'E'
#include <cmath>
#include <cstdio>
#include <nanoflann.hpp>
#include <utility>
#include <vector>
struct Line {
    size_t kdtree_get_point_count() const { return 11; }
    double kdtree_get_pt(size_t i, size_t) const { return 0.25 * double(i); }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};
int main() {
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Line>, Line, 1>;
    const Line line;
    Tree tree(1, line, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    tree.buildIndex();
    const double x = 1.25;
    for (double radius : {0.4, 1.0, 0.25, 0.0625, 0.0}) {
        std::vector<std::pair<uint32_t, double>> found;
        tree.radiusSearch(&x, radius, found, nanoflann::SearchParams());
        double furthest = -1.0, said = -1.0;
        for (auto [i, distance] : found)
            if (std::abs(0.25 * i - x) > furthest) furthest = std::abs(0.25 * i - x), said = distance;
        std::printf("radius %g: %zu points", radius, found.size());
        if (!found.empty()) std::printf(", the furthest %g m away, said to be %g", furthest, said);
        std::printf("\n");
    }
}
E
g++ -I"$work/usr/include" a.cpp -o a
./a | tee output
diff output - <<'E'
radius 0.4: 5 points, the furthest 0.5 m away, said to be 0.25
radius 1: 7 points, the furthest 0.75 m away, said to be 0.5625
radius 0.25: 3 points, the furthest 0.25 m away, said to be 0.0625
radius 0.0625: 1 points, the furthest 0 m away, said to be 0
radius 0: 0 points
E
