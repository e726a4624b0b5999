#include "abut/run/slow_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/run/failure.hpp"
#include "abut/run/scene.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::run {
namespace {

/// How long a longitudinal wave takes through a cell, in its narrowest direction about [s].
template <int Dim>
double crossing_time(const mesh::Mesh<Dim>& mesh, std::int32_t cell, const solid::Material& material) {
    double surface = 0.0;
    for (const std::int32_t face : mesh.cell_faces[cell]) surface += mesh.face_measure[static_cast<std::size_t>(face)];
    return 2.0 * Dim * mesh.cell_measure[static_cast<std::size_t>(cell)] / surface *
           std::sqrt(material.density / material.wave_modulus());
}

}  // namespace

template <int Dim>
std::optional<SlowCell> slow_cell(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::vector<std::pair<double, std::int32_t>> times;
    for (std::int32_t cell = 0; cell < scene.mesh.n_cells(); ++cell) {
        const auto body = static_cast<std::size_t>(scene.mesh.cell_body[static_cast<std::size_t>(cell)]);
        if (!solid::properties_of(kinematics_of(scene, result, body)).deforms) continue;
        times.emplace_back(crossing_time(scene.mesh, cell, scene.solid.materials[body]), cell);
    }
    if (times.empty()) return std::nullopt;
    const auto [time, cell] = *std::ranges::min_element(times);
    const auto middle = times.begin() + std::ssize(times) / 2;
    std::ranges::nth_element(times, middle);
    const double share = time / middle->first;
    return SlowCell{cell, time, share,
                    fmt::format("{}: a wave takes {:.3g} s through it, {:.2g} of the median", name_of_cell(scene.mesh, cell),
                                time, share)};
}

template std::optional<SlowCell> slow_cell<2>(const Scene<2>&, const RunResult<2>&);
template std::optional<SlowCell> slow_cell<3>(const Scene<3>&, const RunResult<3>&);

}  // namespace abut::run
