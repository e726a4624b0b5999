#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "abut/mesh/shapes/arguments.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"

namespace abut::mesh {

/// A surface while it is being made, about z and then turned.
class SurfaceBuilder {
public:
    SurfaceBuilder(const std::string& name, const Vector<3>& centre, int axis) : centre_(centre), axis_(axis) {
        mesh_.name = name;
        mesh_.body_names = {name};
    }

    /// x, y, z becomes y, z, x or z, x, y: a rotation, so that inside stays inside.
    std::int32_t add_vertex(const Vector<3>& x) {
        Vector<3> turned;
        for (int i = 0; i < 3; ++i) turned[(i + axis_ + 1) % 3] = x[i];
        mesh_.vertices.push_back(centre_ + turned);
        return static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
    }
    void add_triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
        mesh_.faces.append(std::array{a, b, c});
        mesh_.face_body.push_back(0);
    }
    /// Cut along a-c.
    void add_quadrangle(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
        add_triangle(a, b, c);
        add_triangle(a, c, d);
    }
    /// Between two rings of vertices, one after the other.
    void add_band(const std::vector<std::int32_t>& ring, const std::vector<std::int32_t>& next) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::size_t j = (i + 1) % ring.size();
            add_quadrangle(ring[i], ring[j], next[j], next[i]);
        }
    }
    SurfaceMesh mesh() && { return std::move(mesh_); }

private:
    Vector<3> centre_;
    int axis_;
    SurfaceMesh mesh_;
};

}  // namespace abut::mesh
