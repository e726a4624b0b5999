#include "abut/geometry/triangulate.hpp"

#include <algorithm>
#include <string>

#include "abut/base/error.hpp"
#include "abut/geometry/overlap/overlap.hpp"

namespace abut::geometry {
namespace {

/// 2 A / (longest edge)^2: 0 for a flat triangle, sin 60 at best. In units of the longest edge, so that nothing overflows.
double quality(const Vector<3>& a, const Vector<3>& b, const Vector<3>& c) {
    const double longest = std::max({(b - a).stableNorm(), (c - b).stableNorm(), (a - c).stableNorm()});
    if (!(longest > 0.0)) return 0.0;
    return Vector<3>((b - a) / longest).cross(Vector<3>((c - a) / longest)).norm();
}

/// The best way to cut the part of a polygon between each two of its corners, from short parts to long ones.
class BestCut {
public:
    explicit BestCut(FaceVertices<3> polygon) : polygon_(polygon) {
        const std::size_t n = polygon.size();
        for (std::size_t width = 2; width < n; ++width)
            for (std::size_t i = 0; i + width < n; ++i) choose_apex(i, i + width);
    }
    void append_triangles(std::size_t i, std::size_t j, std::vector<LocalTriangle>& triangles) const {
        if (j < i + 2) return;
        const std::size_t apex = apex_[i][j];
        append_triangles(i, apex, triangles);
        triangles.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(apex), static_cast<std::int32_t>(j)});
        append_triangles(apex, j, triangles);
    }

private:
    void choose_apex(std::size_t i, std::size_t j) {
        worst_[i][j] = -1.0;
        apex_[i][j] = i + 1;
        for (std::size_t k = i + 1; k < j; ++k) {
            double worst = quality(polygon_[i], polygon_[k], polygon_[j]);
            if (k > i + 1) worst = std::min(worst, worst_[i][k]);
            if (j > k + 1) worst = std::min(worst, worst_[k][j]);
            if (worst <= worst_[i][j]) continue;
            worst_[i][j] = worst;
            apex_[i][j] = k;
        }
    }

    template <class Value>
    using Table = std::array<std::array<Value, max_polygon_vertices>, max_polygon_vertices>;
    FaceVertices<3> polygon_;
    Table<double> worst_{};
    Table<std::size_t> apex_{};
};

}  // namespace

std::vector<LocalTriangle> cut_into_triangles(FaceVertices<3> polygon) {
    if (polygon.size() > static_cast<std::size_t>(max_polygon_vertices))
        throw BadInput("a polygon has " + std::to_string(polygon.size()) + " corners, at most " +
                           std::to_string(max_polygon_vertices) + " are allowed. Cut it into smaller ones.",
                       {.value = static_cast<double>(polygon.size()), .allowed = static_cast<double>(max_polygon_vertices)});
    if (polygon.size() < 3) return {};
    if (polygon.size() == 3) return {{0, 1, 2}};
    std::vector<LocalTriangle> triangles;
    BestCut(polygon).append_triangles(0, polygon.size() - 1, triangles);
    return triangles;
}

}  // namespace abut::geometry
