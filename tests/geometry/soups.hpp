#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "abut/geometry/health/face_soup.hpp"
#include "abut/geometry/health/surface_health.hpp"

namespace abut::test {

/// A soup that owns its arrays.
struct Faces {
    std::vector<Vector<3>> vertices;
    std::vector<std::int32_t> offsets{0};
    std::vector<std::int32_t> corners;

    void add(const std::vector<std::int32_t>& face) {
        corners.insert(corners.end(), face.begin(), face.end());
        offsets.push_back(static_cast<std::int32_t>(corners.size()));
    }
    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
    [[nodiscard]] geometry::FaceSoup soup() const { return {vertices, offsets, corners}; }
};

inline Faces faces(std::vector<Vector<3>> vertices, const std::vector<std::vector<std::int32_t>>& loops) {
    Faces result;
    result.vertices = std::move(vertices);
    for (const auto& loop : loops) result.add(loop);
    return result;
}

/// One face with corners of its own.
inline Faces one_face(std::vector<Vector<3>> corners) {
    std::vector<std::int32_t> loop;
    for (std::size_t i = 0; i < corners.size(); ++i) loop.push_back(static_cast<std::int32_t>(i));
    return faces(std::move(corners), {loop});
}

/// Two triangles that share no index.
inline Faces two_triangles(const std::vector<Vector<3>>& corners) { return faces(corners, {{0, 1, 2}, {3, 4, 5}}); }

/// The faces of the unit cube, outward.
inline Faces cube() {
    return faces({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                 {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// An octahedron, each triangle cut into four n_times, its corners on the unit sphere: 8 4^n faces, outward.
inline Faces sphere(int n_times) {
    Faces result = faces({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                         {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
    for (int i = 0; i < n_times; ++i) {
        Faces finer;
        finer.vertices = result.vertices;
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle;
        const auto between = [&](std::int32_t a, std::int32_t b) {
            const auto [entry, is_new] = middle.emplace(std::minmax(a, b), static_cast<std::int32_t>(finer.vertices.size()));
            if (is_new)
                finer.vertices.push_back(
                    (finer.vertices[static_cast<std::size_t>(a)] + finer.vertices[static_cast<std::size_t>(b)])
                        .normalized());
            return entry->second;
        };
        for (std::size_t f = 0; f < result.corners.size(); f += 3) {
            const std::int32_t a = result.corners[f], b = result.corners[f + 1], c = result.corners[f + 2];
            const std::int32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
            for (const auto& face : {std::vector{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.add(face);
        }
        result = std::move(finer);
    }
    return result;
}

/// A torus about z, of the radii 2 and `tube`, n x n quadrangles cut into triangles. It passes through itself if tube > 2.
inline Faces torus(int n, double tube) {
    Faces result;
    const auto vertex = [n](int i, int j) { return static_cast<std::int32_t>((i + n) % n * n + (j + n) % n); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = 2.0 * std::numbers::pi * i / n, v = 2.0 * std::numbers::pi * j / n;
            const double r = 2.0 + tube * std::cos(v);
            result.vertices.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            result.add({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            result.add({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    return result;
}

/// A band of n quadrangles around z that is turned over once where its ends meet.
inline Faces moebius_strip(int n) {
    Faces result;
    for (int i = 0; i < n; ++i) {
        const double u = 2.0 * std::numbers::pi * i / n;
        for (const double s : {-0.3, 0.3})
            result.vertices.push_back(
                {(1.0 + s * std::cos(u / 2)) * std::cos(u), (1.0 + s * std::cos(u / 2)) * std::sin(u), s * std::sin(u / 2)});
    }
    for (std::int32_t i = 0; i < n; ++i) {
        const bool last = i == n - 1;
        const std::int32_t a = 2 * i, b = 2 * i + 1, c = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
        result.add({a, c, b});
        result.add({b, c, d});
    }
    return result;
}

/// What every edge of a triangle looks the same in, times `size`, and away from the origin by `shift`.
inline std::vector<Vector<3>> corner_triangle(double size = 1.0, const Vector<3>& shift = Vector<3>::Zero()) {
    return {shift, shift + Vector<3>(size, 0, 0), shift + Vector<3>(0, size, 0)};
}

inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinite = std::numeric_limits<double>::infinity();

inline std::vector<Vector<3>> regular_polygon(int n) {
    std::vector<Vector<3>> corners;
    for (int i = 0; i < n; ++i)
        corners.push_back({std::cos(2.0 * std::numbers::pi * i / n), std::sin(2.0 * std::numbers::pi * i / n), 0.0});
    return corners;
}

/// Appends a copy of `other` that shares no vertex with what is there.
inline void append(Faces& faces, const Faces& other, const Vector<3>& shift) {
    const auto n = static_cast<std::int32_t>(faces.vertices.size());
    for (const Vector<3>& x : other.vertices) faces.vertices.push_back(x + shift);
    for (std::int32_t face = 0; face < other.size(); ++face) {
        std::vector<std::int32_t> loop;
        for (const std::int32_t v : other.soup().vertices_of(face)) loop.push_back(v + n);
        faces.add(loop);
    }
}

inline geometry::SurfaceReport checked(const Faces& faces, const geometry::HealthOptions& options = {}) {
    return geometry::check_surface(faces.soup(), options);
}

}  // namespace abut::test
