#include <array>
#include <cstdint>

#include "abut/mesh/shapes/surface_builder.hpp"

namespace abut::mesh {
namespace {

/// Steele, Lea, Flood (2014), Fast splittable pseudorandom number generators: a counter, and a mix of its bits.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// In [0, 1), a multiple of 2^-53.
    double operator()() {
        state_ += 0x9e3779b97f4a7c15U;
        std::uint64_t z = state_;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
        z = (z ^ z >> 27) * 0x94d049bb133111ebU;
        return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
    }
    Vector<3> in_unit_cube() {
        const double x = (*this)(), y = (*this)(), z = (*this)();
        return {x, y, z};
    }

private:
    std::uint64_t state_;
};

}  // namespace

SurfaceMesh random_triangles(const RandomTrianglesOptions& options) {
    require_count(options.name, "n", options.n, 1);
    require_size(options.name, options.n);
    require_length(options.name, "box_size", options.box_size);
    require_length(options.name, "size", options.size);
    require_finite(options.name, "lower", options.lower);
    SurfaceBuilder builder(options.name, options.lower, 2);
    Random random(options.seed);
    for (int i = 0; i < options.n; ++i) {
        const Vector<3> centre = options.box_size * random.in_unit_cube();
        std::array<std::int32_t, 3> corners{};
        for (std::int32_t& corner : corners)
            corner = builder.add_vertex(centre + options.size * (random.in_unit_cube() - Vector<3>::Constant(0.5)));
        builder.add_triangle(corners[0], corners[1], corners[2]);
    }
    return std::move(builder).mesh();
}

}  // namespace abut::mesh
