#include "abut/solid/body_interference.hpp"

#include "abut/base/sort_unique.hpp"

namespace abut::solid {

template <int Dim>
std::vector<std::array<std::int32_t, 2>> overlapping_bodies(const mesh::Mesh<Dim>& mesh,
                                                            std::span<const BodyInterference> interference,
                                                            std::size_t n_obstacles, double time) {
    const std::int32_t first_group = mesh.n_bodies() + static_cast<std::int32_t>(n_obstacles);
    const auto bodies_of = [&](std::int32_t side) {
        if (side < first_group) return std::vector{side};
        std::vector<std::int32_t> bodies;
        for (const std::int32_t face : mesh.groups[static_cast<std::size_t>(side - first_group)].faces)
            bodies.push_back(mesh.cell_body[mesh.face_cells[face][0]]);
        sort_unique(bodies);
        return bodies;
    };
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const BodyInterference& one : interference)
        if (time < one.time)
            for (const std::int32_t a : bodies_of(one.bodies[0]))
                for (const std::int32_t b : bodies_of(one.bodies[1])) pairs.push_back({a, b});
    return pairs;
}

#define ABUT_INSTANTIATE(Dim)                                             \
    template std::vector<std::array<std::int32_t, 2>> overlapping_bodies( \
        const mesh::Mesh<Dim>&, std::span<const BodyInterference>, std::size_t, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
