#include "abut/solid/local_levels.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::solid {
namespace {

/// Sets the positions of some cells at dt from now.
template <int Dim>
void set_positions(const dynamics::FreeFlight& flight, double dt, std::span<const std::int32_t> cells,
                   std::span<Vector<Dim>> position) {
    parallel_each(static_cast<std::ptrdiff_t>(cells.size()), [&](std::ptrdiff_t i) {
        const auto first = static_cast<std::size_t>(cells[i]) * Dim;
        for (int d = 0; d < Dim; ++d) position[cells[i]][d] = flight.at(first + d, dt);
    });
}

}  // namespace

template <int Dim>
LocalLevels<Dim>::LocalLevels(const mesh::Mesh<Dim>& mesh, Ccg<Dim>& ccg, const Loads<Dim>& loads, std::int32_t n_levels,
                              std::span<const std::int32_t> level)
    : ccg_(ccg), loads_(loads), all_cells_(static_cast<std::size_t>(mesh.n_cells())) {
    for (std::size_t i = 0; i < level.size(); ++i)
        if (level[i] != level[i - i % Dim])
            throw BadInput(mesh.name + ": the components of cell " + std::to_string(mesh.cell_label[i / Dim]) +
                               " are on different levels. A cell takes its steps as a whole.",
                           {.cell = static_cast<std::int64_t>(i / Dim)});
    std::iota(all_cells_.begin(), all_cells_.end(), 0);
    set_regions(n_levels, level);
    set_surface_cells(mesh);
    for (auto* array : {&at_start_, &moved_, &gradient_}) array->assign(all_cells_.size(), Vector<Dim>::Zero());
}

template <int Dim>
void LocalLevels<Dim>::set_regions(std::int32_t n_levels, std::span<const std::int32_t> level) {
    std::vector<std::int32_t> evaluated(all_cells_.size(), 0);  // level at which each cell is
    for (std::int32_t l = 1; l < n_levels; ++l) {
        std::vector<std::int32_t> as_fine;
        for (const std::int32_t c : all_cells_)
            if (level[static_cast<std::size_t>(c) * Dim] >= l) as_fine.push_back(c);
        // K is symmetric: what these cells depend on depends on them.
        for (const std::int32_t c : ccg_.region_of_cells(as_fine).input_cells) evaluated[c] = l;
    }
    for (std::int32_t l = 0; l < n_levels; ++l) {
        std::vector<std::int32_t> cells;
        for (const std::int32_t c : all_cells_)
            if (evaluated[c] == l) cells.push_back(c);
        regions_.push_back(ccg_.region_of_cells(cells));
    }
}

template <int Dim>
void LocalLevels<Dim>::set_surface_cells(const mesh::Mesh<Dim>& mesh) {
    for (const BoundaryFace b : ccg_.boundary_faces())
        surface_cells_.insert(surface_cells_.end(), ccg_.cells_of(b).begin(), ccg_.cells_of(b).end());
    for (const std::int32_t face : mesh.boundary_faces) surface_cells_.push_back(mesh.face_cells[face][0]);
    sort_unique(surface_cells_);
}

/// Linear: the midpoint is exact.
template <int Dim>
std::int64_t LocalLevels<Dim>::add_bulk_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double dt,
                                                std::span<Vector<Dim>> impulse) {
    const Region<Dim>& region = regions_[level];
    if (region.cells.empty()) return 0;
    set_positions<Dim>(flight, 0.5 * dt, region.input_cells, moved_);
    ccg_.evaluate_cells(region, moved_, loads_.end(), {}, gradient_);
    loads_.add_impulse(region.cells, gradient_, dt, impulse);
    return static_cast<std::int64_t>(region.cells.size());
}

/// The gradient is linear in the corrections: those of cells that do not move.
template <int Dim>
void LocalLevels<Dim>::add_contact_impulse(std::span<const std::int32_t> input_cells,
                                           const FaceCorrections<Dim>& corrections, double dt,
                                           std::span<Vector<Dim>> impulse) {
    if (!std::ranges::equal(input_cells, contact_region_.cells)) contact_region_ = ccg_.region_of_cells(input_cells);
    for (const std::int32_t c : contact_region_.input_cells) moved_[c].setZero();
    ccg_.evaluate_cells(contact_region_, moved_, ccg_.load_free(), corrections, gradient_);
    for (std::size_t i = 0; i < contact_region_.cells.size(); ++i) impulse[contact_region_.cells[i]] -= dt * gradient_[i];
}

template <int Dim>
std::span<const Vector<Dim>> LocalLevels<Dim>::start_of(const dynamics::FreeFlight& flight,
                                                        std::span<const std::int32_t> cells) {
    set_positions<Dim>(flight, 0.0, cells, at_start_);
    return at_start_;
}

template <int Dim>
std::span<const Vector<Dim>> LocalLevels<Dim>::end_of(const dynamics::FreeFlight& flight, double dt,
                                                      std::span<const std::int32_t> cells) {
    set_positions<Dim>(flight, dt, cells, moved_);
    return moved_;
}

template class LocalLevels<2>;
template class LocalLevels<3>;

}  // namespace abut::solid
