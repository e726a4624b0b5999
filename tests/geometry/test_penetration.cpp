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
