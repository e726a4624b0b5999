#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "abut/mesh/shapes/surface_builder.hpp"

namespace abut::mesh {
namespace {

/// Splits each triangle of unit vectors into four.
class Subdivision {
public:
    using Triangle = std::array<std::int32_t, 3>;
    std::vector<Vector<3>> vertices;
    std::vector<Triangle> triangles;

    void refine() {
        middles_.clear();
        middles_.reserve(2 * triangles.size());
        std::vector<Triangle> finer;
        finer.reserve(4 * triangles.size());
        for (const auto& [a, b, c] : triangles) {
            const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        triangles = std::move(finer);
    }

private:
    std::int32_t middle(std::int32_t a, std::int32_t b) {
        const auto key = static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b));
        const auto [entry, is_new] = middles_.emplace(key, static_cast<std::int32_t>(vertices.size()));
        if (is_new)
            vertices.push_back((vertices[static_cast<std::size_t>(a)] + vertices[static_cast<std::size_t>(b)]).normalized());
        return entry->second;
    }
    std::unordered_map<std::uint64_t, std::int32_t> middles_;
};

/// Corners (0, +-1, +-golden) and so on round, triangles outward.
Subdivision icosahedron() {
    const double golden = std::numbers::phi;
    Subdivision shape;
    for (int axis = 0; axis < 3; ++axis)
        for (const double s : {1.0, -1.0})
            for (const double t : {golden, -golden}) {
                Vector<3> x = Vector<3>::Zero();
                x[(axis + 1) % 3] = s;
                x[(axis + 2) % 3] = t;
                shape.vertices.push_back(x.normalized());
            }
    // Three corners make a face where all are neighbours.
    const auto are_neighbours = [&](std::int32_t i, std::int32_t j) {
        return (shape.vertices[static_cast<std::size_t>(i)] - shape.vertices[static_cast<std::size_t>(j)]).norm() < 1.1;
    };
    for (std::int32_t i = 0; i < 12; ++i)
        for (std::int32_t j = i + 1; j < 12; ++j)
            for (std::int32_t k = j + 1; k < 12; ++k) {
                if (!are_neighbours(i, j) || !are_neighbours(j, k) || !are_neighbours(k, i)) continue;
                const auto corners = Matrix<3>::from_columns(shape.vertices[static_cast<std::size_t>(i)],
                                                             shape.vertices[static_cast<std::size_t>(j)],
                                                             shape.vertices[static_cast<std::size_t>(k)]);
                shape.triangles.push_back(corners.determinant() > 0.0 ? Subdivision::Triangle{i, j, k}
                                                                      : Subdivision::Triangle{i, k, j});
            }
    return shape;
}

}  // namespace

SurfaceMesh sphere_surface(const SphereSurfaceOptions& options) {
    require_length(options.name, "radius", options.radius);
    require_finite(options.name, "centre", options.centre);
    require_count(options.name, "n_subdivisions", options.n_subdivisions, 0);
    require_size(options.name, 20.0 * std::pow(4.0, options.n_subdivisions));
    Subdivision shape = icosahedron();
    for (int i = 0; i < options.n_subdivisions; ++i) shape.refine();
    SurfaceBuilder builder(options.name, options.centre, 2);
    for (const Vector<3>& x : shape.vertices) builder.add_vertex(options.radius * x);
    for (const auto& [a, b, c] : shape.triangles) builder.add_triangle(a, b, c);
    return std::move(builder).mesh();
}

}  // namespace abut::mesh
