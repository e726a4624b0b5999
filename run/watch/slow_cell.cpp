#include "abut/run/watch/slow_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/failure.hpp"
#include "abut/run/watch/thresholds.hpp"
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

/// Median of values, which are sorted in part.
double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

template <int Dim>
std::optional<SlowCell> slow_cell(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::vector<double> times, of_body;
    std::optional<std::pair<double, std::int32_t>> fastest;
    const auto body_of = [&](std::int32_t cell) { return scene.mesh.cell_body[static_cast<std::size_t>(cell)]; };
    const auto time_of = [&](std::int32_t cell) {
        return crossing_time(scene.mesh, cell, scene.solid.materials[static_cast<std::size_t>(body_of(cell))]);
    };
    for (std::int32_t cell = 0; cell < scene.mesh.n_cells(); ++cell) {
        const auto body = static_cast<std::size_t>(body_of(cell));
        if (!solid::properties_of(kinematics_of(scene, result, body)).deforms) continue;
        times.push_back(time_of(cell));
        if (!fastest || times.back() < fastest->first) fastest = {times.back(), cell};
    }
    if (!fastest) return std::nullopt;
    const auto [time, slow] = *fastest;
    for (std::int32_t cell = 0; cell < scene.mesh.n_cells(); ++cell)
        if (body_of(cell) == body_of(slow)) of_body.push_back(time_of(cell));
    const double share = time / median(std::move(times));
    return SlowCell{slow, time, share, time / median(std::move(of_body)),
                    fmt::format("{}: a wave takes {:.3g} s through it, {:.2g} of the median", name_of_cell(scene.mesh, slow),
                                time, share)};
}

template <int Dim>
void require_even_cells(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    if (!std::isnan(result.options.dt) || result.options.integrator == SolidIntegrator::memm_async) return;
    const auto slow = slow_cell(scene, result);
    if (!slow || slow->of_body >= least_cell_share) return;
    throw BadInput(
        fmt::format("{}: a wave takes {:.3g} s through it, {:.2g} of the median of its body, {:g} is needed: the step of "
                    "the whole run is as short, {:.3g} s. Give the mesh cells of more even size there, by another `size` or "
                    "without slivers in its surface. Whoever wants the mesh as it is gives the step by --dt",
                    name_of_cell(scene.mesh, slow->cell), slow->time, slow->of_body, least_cell_share, result.run.dt),
        {.cell = slow->cell, .value = slow->of_body, .allowed = least_cell_share});
}

template std::optional<SlowCell> slow_cell<2>(const Scene<2>&, const RunResult<2>&);
template std::optional<SlowCell> slow_cell<3>(const Scene<3>&, const RunResult<3>&);
template void require_even_cells<2>(const Scene<2>&, const RunResult<2>&);
template void require_even_cells<3>(const Scene<3>&, const RunResult<3>&);

}  // namespace abut::run
