#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "abut/geometry/box.hpp"

namespace abut::benchmark {

/// Triangles as every library takes them.
struct Body {
    std::vector<Vector<3>> vertices;
    std::vector<std::array<std::int32_t, 3>> triangles;

    [[nodiscard]] std::array<Vector<3>, 3> corners(std::size_t triangle) const {
        const auto& [a, b, c] = triangles[triangle];
        return {vertices[static_cast<std::size_t>(a)], vertices[static_cast<std::size_t>(b)],
                vertices[static_cast<std::size_t>(c)]};
    }
    void translate(const Vector<3>& way) {
        for (Vector<3>& vertex : vertices) vertex += way;
    }
    /// A box around each triangle, grown by `margin` on all sides.
    [[nodiscard]] std::vector<geometry::Box<3>> boxes(double margin) const;
};

/// Two bodies in near contact, a fifth of a triangle's side apart.
struct DetectionScene {
    std::array<Body, 2> bodies;
    double side;      ///< of a triangle, about [m]
    double distance;  ///< pairs that come as near are wanted [m]: half a side
};

/// "press": two cylinders side by side, in contact along a line. "plug": a plug in a sleeve, in contact all around; the
/// sleeve has an outer wall as well. About n triangles a body, meshes that do not match.
[[nodiscard]] DetectionScene detection_scene(const std::string& name, int n);

}  // namespace abut::benchmark
