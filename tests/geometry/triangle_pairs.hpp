#pragma once
#include <array>
#include <catch2/catch.hpp>
#include <limits>
#include <vector>

#include "polygons.hpp"

namespace abut::test {

using geometry::DecisionCounts;
using geometry::TrianglePair;
using Corners = std::array<Point, 3>;

inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Batch {
    std::vector<OverlapArea<3>> areas;
    DecisionCounts counts;
};

inline Batch many(const std::vector<TrianglePair>& pairs) {
    Batch batch{std::vector<OverlapArea<3>>(pairs.size()), {}};
    batch.counts = geometry::overlap_areas(pairs, batch.areas);
    return batch;
}

inline OverlapArea<3> alone(const TrianglePair& pair, AreaMethod method = AreaMethod::fast) {
    return geometry::overlap_area<3>(pair.face_1, pair.face_2, pair.shift, method);
}

inline double twice_area(const Corners& c) {
    const Point a = c[1] - c[0], b = c[2] - c[0];
    return a.x() * b.y() - a.y() * b.x();
}

inline double extent_of(const TrianglePair& pair) {
    double size = pair.shift.cwiseAbs().maxCoeff();
    for (const Corners& face : {pair.face_1, pair.face_2})
        for (const Point& corner : face) size = std::max(size, (corner - pair.face_1[0]).cwiseAbs().maxCoeff());
    return size;
}

// Decision and area are those of exact arithmetic; areas below the smallest normal number are rounded up to that.
inline void check_against_exact(const std::vector<TrianglePair>& pairs) {
    const Batch batch = many(pairs);
    CHECK(batch.counts.total() == static_cast<std::int64_t>(pairs.size()));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const OverlapArea<3> exact = alone(pairs[k], AreaMethod::exact), &got = batch.areas[k];
        const double size = extent_of(pairs[k]), limit = 8 * epsilon * size * size + std::numeric_limits<double>::min();
        const bool is_right = (got.area > 0.0) == (exact.area > 0.0) && std::abs(got.area - exact.area) <= limit;
        if (is_right) continue;
        CAPTURE(k, got.area, exact.area, size);
        CHECK((got.area > 0.0) == (exact.area > 0.0));
        CHECK(std::abs(got.area - exact.area) <= limit);
    }
}

}  // namespace abut::test
