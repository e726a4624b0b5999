#include "abut/solid/part/share_out.hpp"

#include <algorithm>
#include <string>

#include "abut/base/error.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/solid_points.hpp"

namespace abut::solid {
namespace {

std::vector<std::int32_t> rigid_bodies(std::span<const Kinematics> kinematics) {
    std::vector<std::int32_t> bodies;
    for (std::size_t body = 0; body < kinematics.size(); ++body)
        if (!properties_of(kinematics[body]).deforms) bodies.push_back(static_cast<std::int32_t>(body));
    return bodies;
}

bool is_rigid(std::span<const Kinematics> kinematics, std::int32_t body) {
    return !properties_of(kinematics, static_cast<std::size_t>(body)).deforms;
}

template <int Dim>
void require_one_per_body(const mesh::Mesh<Dim>& mesh, std::span<const Kinematics> kinematics) {
    if (!kinematics.empty() && std::ssize(kinematics) != mesh.n_bodies())
        throw BadInput(mesh.name + ": " + std::to_string(kinematics.size()) + " kinematics are given for " +
                           std::to_string(mesh.n_bodies()) + " bodies. Give one per body, or none.",
                       {.value = static_cast<double>(kinematics.size()), .allowed = static_cast<double>(mesh.n_bodies())});
}

}  // namespace

int copy_layers(std::span<const Kinematics> kinematics) {
    int more = properties_of(Kinematics{}).more_layers;
    for (const Kinematics of_body : kinematics) more = std::max(more, properties_of(of_body).more_layers);
    return mesh::default_layers + more;
}

template <int Dim>
mesh::MeshPart<Dim> part_of(const mesh::Mesh<Dim>& whole, std::span<const int> owner, int rank,
                            std::span<const Kinematics> kinematics, int more_layers) {
    require_one_per_body(whole, kinematics);
    return mesh::part_of(whole, owner, rank, copy_layers(kinematics) + more_layers, rigid_bodies(kinematics));
}

template <int Dim>
PartPoints points_of(const mesh::MeshPart<Dim>& part, std::span<const Kinematics> kinematics) {
    require_one_per_body(part.mesh, kinematics);
    constexpr std::int32_t points_per_body = points_per_rigid_body<Dim>;
    PartPoints points;
    std::int32_t n_rigid_cells = 0;  // so far: those before a cell are all here
    for (std::size_t c = 0; c < part.cell_number.size(); ++c) {
        if (is_rigid(kinematics, part.mesh.cell_body[c])) {
            ++n_rigid_cells;
            continue;
        }
        points.number.push_back(part.cell_number[c] - n_rigid_cells);
        points.owner.push_back(part.cell_owner[c]);
    }
    points.n_points = part.n_cells - n_rigid_cells;
    for (const std::int32_t body : rigid_bodies(kinematics)) {
        const auto [first, last] = cells_of_body(part.mesh, body);
        if (first == last)
            throw BadInput(part.mesh.name + ": rigid body " + std::to_string(body) +
                           " has no cells in this part. Make it with solid::part_of.");
        for (std::int32_t i = 0; i < points_per_body; ++i) points.number.push_back(points.n_points + i);
        points.owner.insert(points.owner.end(), points_per_body, part.cell_owner[static_cast<std::size_t>(first)]);
        points.n_points += points_per_body;
    }
    return points;
}

template <int Dim>
std::vector<double> cell_weights(const mesh::Mesh<Dim>& whole, std::span<const Kinematics> kinematics,
                                 std::span<const double> of_points) {
    require_one_per_body(whole, kinematics);
    const auto n_deformable = static_cast<std::size_t>(
        std::ranges::count_if(whole.cell_body, [&](std::int32_t body) { return !is_rigid(kinematics, body); }));
    const std::size_t n_points = n_deformable + points_per_rigid_body<Dim> * rigid_bodies(kinematics).size();
    if (!of_points.empty() && of_points.size() != n_points)
        throw BadInput(whole.name + ": " + std::to_string(of_points.size()) + " weights are given for " +
                           std::to_string(n_points) + " points. Give one per point, or none.",
                       {.value = static_cast<double>(of_points.size()), .allowed = static_cast<double>(n_points)});
    if (n_deformable == 0 || (of_points.empty() && n_points == n_deformable)) return {};
    std::vector<double> weights;
    std::size_t point = 0;
    for (std::int32_t c = 0; c < whole.n_cells(); ++c) {
        const bool rigid = is_rigid(kinematics, whole.cell_body[c]);
        weights.push_back(rigid ? 0.0 : of_points.empty() ? 1.0 : of_points[point]);
        if (!rigid) ++point;
    }
    return weights;
}

#define ABUT_INSTANTIATE(Dim)                                                                                            \
    template mesh::MeshPart<Dim> part_of(const mesh::Mesh<Dim>&, std::span<const int>, int, std::span<const Kinematics>, \
                                         int);                                                                           \
    template PartPoints points_of(const mesh::MeshPart<Dim>&, std::span<const Kinematics>);                              \
    template std::vector<double> cell_weights(const mesh::Mesh<Dim>&, std::span<const Kinematics>, std::span<const double>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
