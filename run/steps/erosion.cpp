#include "abut/run/steps/erosion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/mesh/without_cells.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/watch/step_figures.hpp"
#include "abut/solid/step_of_breaking.hpp"

namespace abut::run {
namespace {

template <int Dim>
double worst_weight_of(const solid::Solid<Dim>& solid) {
    return std::min(solid.ccg().stencil_report().worst_weight, solid.ccg().boundary().report.worst_weight);
}

}  // namespace

template <int Dim>
Erosion<Dim>::Erosion(Start<Dim>& start)
    : start_(start), acts_(may_lose_cells(start.scene)), worst_weight_(worst_weight_of(*start.solid)) {
    if (!acts_) return;
    first_cells_.resize(start.scene.mesh.cell_measure.size());
    std::iota(first_cells_.begin(), first_cells_.end(), 0);
}

template <int Dim>
std::vector<solid::LeavingCell> Erosion<Dim>::leaving(const dynamics::RunView<Dim>& run) {
    solid::Solid<Dim>& solid = *start_.solid;
    std::vector<solid::LeavingCell> leaving = solid::cells_beyond_limits(solid);
    if (start_.scene.leaving)
        for (const std::int32_t cell : start_.scene.leaving(run, solid)) {
            if (cell < 0 || cell >= solid.mesh().n_cells())
                throw BadInput(fmt::format("erosion: the function of the scene lets cell {} leave, counted from 0, of {} "
                                           "cells that are there. Give numbers of cells as they are now.",
                                           cell, solid.mesh().n_cells()),
                               {.cell = cell});
            leaving.push_back({cell, solid::LeavingReason::function});
        }
    if (leaving.empty()) return leaving;
    std::ranges::stable_sort(leaving, {}, &solid::LeavingCell::cell);
    leaving.erase(std::ranges::unique(leaving, {}, &solid::LeavingCell::cell).begin(), leaving.end());
    std::vector<std::int32_t> cells;
    for (const solid::LeavingCell& one : leaving) cells.push_back(one.cell);
    for (const std::int32_t cell : solid::remnants<Dim>(solid, cells))
        leaving.push_back({cell, solid::LeavingReason::remnant});
    std::ranges::sort(leaving, {}, &solid::LeavingCell::cell);
    return leaving;
}

template <int Dim>
solid::RunState Erosion<Dim>::take_out(std::span<const solid::LeavingCell> leaving,
                                       const dynamics::IntegratorState& motion) {
    std::vector<std::int32_t> cells;
    for (const solid::LeavingCell& one : leaving) cells.push_back(one.cell);
    solid::Solid<Dim>& before = *start_.solid;
    Rest rest = rest_without(cells);
    require_stable(*rest.solid);
    std::vector<std::int32_t> old_cells;  // in the present mesh
    std::vector<std::int32_t> present(start_.scene.mesh.cell_measure.size(), -1);
    for (std::size_t c = 0; c < first_cells_.size(); ++c)
        present[static_cast<std::size_t>(first_cells_[c])] = static_cast<std::int32_t>(c);
    for (const std::int32_t first : rest.first_cells) old_cells.push_back(present[static_cast<std::size_t>(first)]);

    const std::int32_t n_bodies = start_.scene.mesh.n_bodies();
    ErosionReport<Dim>& report = start_.result.erosion;
    const Vector<Dim> given = momentum_from_outside(motion.time, n_bodies, before);
    solid::Change<Dim> changed = solid::change(before, motion, *rest.solid, old_cells);
    report.impulse_of_weight += given - momentum_from_outside(motion.time, n_bodies, *rest.solid);
    report.left += changed.left;
    for (const solid::LeavingCell& one : leaving)
        report.cells.push_back({first_cells_[static_cast<std::size_t>(one.cell)], motion.steps, motion.time, one.reason});
    first_cells_ = std::move(rest.first_cells);
    start_.take_rest(std::move(rest.scene), std::move(rest.solid), changed.state.motion);
    return std::move(changed.state);
}

template <int Dim>
void Erosion<Dim>::resume(const dynamics::IntegratorState& motion) {
    Rest rest = rest_without({});
    worst_weight_ = worst_weight_of(*rest.solid);
    first_cells_ = std::move(rest.first_cells);
    start_.take_rest(std::move(rest.scene), std::move(rest.solid), motion);
}

template <int Dim>
auto Erosion<Dim>::rest_without(std::span<const std::int32_t> cells) const -> Rest {
    const mesh::Mesh<Dim>& first = start_.scene.mesh;
    std::vector<char> is_gone(first.cell_measure.size(), 0);
    for (const ErodedCell& one : start_.result.erosion.cells) is_gone[static_cast<std::size_t>(one.cell)] = 1;
    for (const std::int32_t cell : cells)
        is_gone[static_cast<std::size_t>(first_cells_[static_cast<std::size_t>(cell)])] = 1;
    require_cells(is_gone);
    std::vector<std::int32_t> gone;
    for (std::int32_t cell = 0; cell < first.n_cells(); ++cell)
        if (is_gone[static_cast<std::size_t>(cell)] != 0) gone.push_back(cell);
    auto [mesh, first_cells] = mesh::without_cells<Dim>(first, gone);
    Rest rest{std::make_unique<Scene<Dim>>(start_.scene), nullptr, std::move(first_cells)};
    rest.scene->mesh = std::move(mesh);
    rest.solid = std::make_unique<solid::Solid<Dim>>(rest.scene->mesh, start_.solid->options());
    return rest;
}

template <int Dim>
void Erosion<Dim>::require_cells(const std::vector<char>& is_gone) const {
    const mesh::Mesh<Dim>& first = start_.scene.mesh;
    std::vector<char> has_cells(first.body_names.size(), 0);
    for (std::size_t cell = 0; cell < is_gone.size(); ++cell)
        if (is_gone[cell] == 0) has_cells[static_cast<std::size_t>(first.cell_body[cell])] = 1;
    if (const auto none = std::ranges::find(has_cells, 0); none != has_cells.end())
        throw LimitExceeded(
            fmt::format("erosion: all that is left of body '{}' leaves, and a body keeps one cell at least. End the run "
                        "before, or give the body higher limits of erosion.",
                        first.body_names[static_cast<std::size_t>(none - has_cells.begin())]));
}

/// Asks for the stable step where stencils extrapolate farther than any before; else the rest is softer than the whole.
template <int Dim>
void Erosion<Dim>::require_stable(solid::Solid<Dim>& solid) {
    const double worst = worst_weight_of(solid);
    if (worst >= worst_weight_) return;
    const double dt = start_.options.allow_unstable ? start_.result.run.dt : solid::step_of_breaking(solid).dt;
    if (start_.result.run.dt > dt)
        throw LimitExceeded(
            fmt::format("erosion: the stable step of what is left is {:.4g} s, and the run takes {:.4g} s. Take a cfl of "
                        "{:.2g}.",
                        dt, start_.result.run.dt, 0.9 * start_.options.cfl * dt / start_.result.run.dt),
            {.value = start_.result.run.dt, .allowed = dt});
    worst_weight_ = worst;
}

template class Erosion<2>;
template class Erosion<3>;

}  // namespace abut::run
