#include <array>
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "abut/geometry/nearest/penetration.hpp"

using namespace abut;

namespace {

/// A box with normals outwards.
class BoxSurface {
public:
    BoxSurface(const Vector<3>& lower, const Vector<3>& upper) {
        for (int i = 0; i < 8; ++i)
            vertices_.push_back({(i & 1 ? upper : lower)[0], (i & 2 ? upper : lower)[1], (i & 4 ? upper : lower)[2]});
    }
    [[nodiscard]] geometry::FaceSoup soup() const { return {vertices_, offsets, corners}; }

private:
    static constexpr std::array<std::int32_t, 7> offsets{0, 4, 8, 12, 16, 20, 24};
    static constexpr std::array<std::int32_t, 24> corners{0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4,
                                                          2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    std::vector<Vector<3>> vertices_;
};

/// The boundary of a box of n x n squares on each side, with normals outwards.
class FineBox {
public:
    FineBox(const Vector<3>& lower, double size, std::int32_t n) {
        for (int axis = 0; axis < 3; ++axis)
            for (const bool is_upper : {false, true}) add_side(lower, size, n, axis, is_upper);
    }
    [[nodiscard]] geometry::FaceSoup soup() const { return {vertices_, offsets_, corners_}; }

private:
    void add_side(const Vector<3>& lower, double size, std::int32_t n, int axis, bool is_upper) {
        const auto first = static_cast<std::int32_t>(vertices_.size());
        for (std::int32_t j = 0; j <= n; ++j)
            for (std::int32_t i = 0; i <= n; ++i) {
                Vector<3> x = lower;
                x[axis] += is_upper ? size : 0.0;
                x[(axis + 1) % 3] += size * i / n;
                x[(axis + 2) % 3] += size * j / n;
                vertices_.push_back(x);
            }
        for (std::int32_t j = 0; j < n; ++j)
            for (std::int32_t i = 0; i < n; ++i) {
                const std::int32_t v = first + j * (n + 1) + i;
                if (is_upper)
                    corners_.insert(corners_.end(), {v, v + 1, v + n + 2, v + n + 1});
                else
                    corners_.insert(corners_.end(), {v, v + n + 1, v + n + 2, v + 1});
                offsets_.push_back(static_cast<std::int32_t>(corners_.size()));
            }
    }

    std::vector<Vector<3>> vertices_;
    std::vector<std::int32_t> offsets_{0}, corners_;
};

const BoxSurface unit_box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});

}  // namespace

TEST_CASE("a box that is pressed into another one is as deep in it as its face is below the other's", "[geometry]") {
    for (const double depth : {0.15, 0.01}) {
        const BoxSurface upper({0.3, 0.0, 1.0 - depth}, {1.3, 1.0, 2.0 - depth});
        CHECK(geometry::penetration_depth(unit_box.soup(), upper.soup()) == Approx(depth));
        CHECK(geometry::penetration_depth(upper.soup(), unit_box.soup()) ==
              geometry::penetration_depth(unit_box.soup(), upper.soup()));
    }
}

TEST_CASE("bars that cross with all corners outside of each other are as deep as half their thickness", "[geometry]") {
    const BoxSurface along_x({-5.0, -0.5, -0.5}, {5.0, 0.5, 0.5}), along_y({-0.3, -5.0, -0.3}, {0.3, 5.0, 0.3});
    CHECK(geometry::penetration_depth(along_x.soup(), along_y.soup()) == Approx(0.5));  // the thin one's edge in the middle
}

TEST_CASE("boxes that are apart or touch are not deep in each other, and one inside is as deep as its farthest point",
          "[geometry]") {
    CHECK(geometry::penetration_depth(unit_box.soup(), BoxSurface({0.0, 0.0, 1.1}, {1.0, 1.0, 2.0}).soup()) == 0.0);
    CHECK(geometry::penetration_depth(unit_box.soup(), BoxSurface({0.2, 0.2, 1.0}, {0.8, 0.8, 2.0}).soup()) == 0.0);
    CHECK(geometry::penetration_depth(unit_box.soup(), BoxSurface({0.3, 0.3, 0.3}, {0.6, 0.6, 0.6}).soup()) == Approx(0.4));
}

TEST_CASE("the depth by a sample of the points is that by all of them where a whole side is as deep", "[geometry]") {
    // Four corners of each square of the side that is inside, times all squares of the other box.
    constexpr std::int32_t n = 40;
    const FineBox lower({0.0, 0.0, 0.0}, 1.0, n), upper({0.3, 0.2, 0.85}, 1.0, n);
    REQUIRE(4.0 * 0.7 * 0.8 * n * n * lower.soup().size() > 20e6);  // from where on some are looked at
    CHECK(geometry::penetration_depth(lower.soup(), upper.soup()) == Approx(0.15));
}
