#include <algorithm>
#include <array>
#include <vector>

#include "abut/base/sort_unique.hpp"
#include "abut/solid/ccg/sweeps.hpp"

// How the sweeps cut a mesh, or a part of it, into chunks.

namespace abut::solid {
namespace {

/// Cells per chunk: its work arrays fit the second-level cache several times.
inline constexpr std::int32_t chunk_size = 512;

/// Cells of a region that are worth the schedule of the whole mesh.
inline constexpr std::size_t one_chunk = 1024;

}  // namespace

/// Chunks of cells with the faces they are the first side of, and which of them read each other's results.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_chunks() {
    const CcgArrays<Dim>& a = arrays_;
    const auto position = [](const auto& sorted, auto value) {
        return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
    };
    const auto begin_chunk = [&](std::int32_t cell, std::int32_t end) {
        const auto face = static_cast<std::int32_t>(std::partition_point(a.face_cells.begin(), a.face_cells.end(),
                                                                         [&](const auto& side) { return side[0] < cell; }) -
                                                    a.face_cells.begin());
        const std::int32_t boundary = position(a.boundary_faces, face);
        const auto condensed = std::ranges::lower_bound(a.simplices.condensed(), cell, {}, &CondensedCell::cell);
        chunks_.push_back({.cell = cell,
                           .face = face,
                           .boundary = boundary,
                           .row_face = position(a.row_faces, BoundaryFace{boundary}),
                           .boundary_cell = position(a.boundary_cells, cell),
                           .condensed = static_cast<std::int32_t>(condensed - a.simplices.condensed().begin()),
                           .simplices = cell < end && a.simplices.contains(cell),
                           .has_finite = finite_.any_in(cell, end)});
    };
    std::vector<std::int32_t> chunk_of(a.cells.size());
    for (std::size_t body = 0; body + 1 < a.body_begin.size(); ++body)
        for (std::int32_t cell = a.body_begin[body]; cell < a.body_begin[body + 1]; cell += chunk_size) {
            const std::int32_t end = std::min(cell + chunk_size, a.body_begin[body + 1]);
            std::fill(chunk_of.begin() + cell, chunk_of.begin() + end, static_cast<std::int32_t>(chunks_.size()));
            begin_chunk(cell, end);
        }
    const auto n_chunks = static_cast<std::int32_t>(chunks_.size());
    begin_chunk(a.n_cells(), a.n_cells());

    // y of a face is written over its displacement, which the sweep before last reads: both sides have their gradients when
    // `face_gradients` of a chunk runs, since it needs the stresses of both, and these need them.
    std::array<std::vector<std::vector<std::int32_t>>, n_stages - 1> needs;
    for (auto& stage : needs) stage.resize(static_cast<std::size_t>(n_chunks));
    const auto need = [&](Stage stage, std::int32_t cell, std::int32_t of_cell) {
        auto& row = needs[stage - 1][chunk_of[cell]];
        if (const std::int32_t chunk = chunk_of[of_cell]; row.empty() || row.back() != chunk) row.push_back(chunk);
    };
    for (const auto& [first, second] : a.face_cells) {
        need(displacement_gradients, second, first);  // a face's displacement is made with its first side
        need(stresses, first, second);
        need(stresses, second, first);
        need(face_gradients, first, second);
    }
    for (std::int32_t f = 0; f < a.n_faces(); ++f)
        if (a.boundary_index[f] == no_face)
            for (const std::int32_t c : a.stencils[f].cells) need(reconstruction, a.face_cells[f][0], c);
    for (const BoundaryFace b : a.row_faces)
        for (std::int32_t i = a.boundary.offsets[number_of(b)]; i < a.boundary.offsets[number_of(b) + 1]; ++i)
            need(reconstruction, a.cell_of(b), a.boundary.cells[i]);
    for (std::int32_t c = 0; c < a.n_cells(); ++c) {
        for (const Stage stage : {reconstruction, displacement_gradients, stresses, face_gradients, cell_gradients})
            need(stage, c, c);
        for (std::int32_t i = a.of_cell.offsets[c]; i < a.of_cell.offsets[c + 1]; ++i)
            need(cell_gradients, c, a.face_cells[a.of_cell.rows[i]][0]);
        if (const std::int32_t p = a.boundary_cell_position[c]; p >= 0)
            for (std::int32_t i = a.of_boundary_cell.offsets[p]; i < a.of_boundary_cell.offsets[p + 1]; ++i)
                need(cell_gradients, c, a.cell_of(a.of_boundary_cell.rows[i]));
    }
    for (auto& stage : needs)
        for (auto& row : stage) sort_unique(row);
    schedule_ = SweepSchedule<n_stages>(n_chunks, needs);
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::compute_only(const Region<Dim>& region) {
    const std::size_t n_chunks = chunks_.size() - 1;
    const auto want = [&](Stage stage, std::int32_t cell) {
        const auto behind = std::ranges::upper_bound(chunks_, cell, {}, &Chunk::cell);
        is_wanted_[stage][static_cast<std::size_t>(behind - chunks_.begin()) - 1] = true;
    };
    is_wanted_[loading].clear();
    for (const Stage stage : {reconstruction, displacement_gradients, stresses, face_gradients, cell_gradients})
        is_wanted_[stage].assign(n_chunks, false);
    for (const std::int32_t f : region.reconstructed) want(reconstruction, arrays_.face_cells[f][0]);
    for (const BoundaryFace b : region.reconstructed_boundary) want(reconstruction, arrays_.cell_of(b));
    for (const std::int32_t c : region.displacement_gradient_cells) want(displacement_gradients, c);
    for (const std::int32_t c : region.stress_cells) want(stresses, c);
    for (const std::int32_t f : region.energy_gradient_faces) want(face_gradients, arrays_.face_cells[f][0]);
    for (const BoundaryFace b : region.faces) want(face_gradients, arrays_.cell_of(b));
    for (const std::int32_t c : region.cells) {
        want(face_gradients, c);
        want(cell_gradients, c);
    }
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::divide_into_chunks(Region<Dim>& region) const {
    region.chunks.clear();
    if (region.cells.size() < one_chunk) {  // all in one: it costs no more than its cells
        const auto n = [](const auto& list) { return static_cast<std::int32_t>(list.size()); };
        region.chunks = {{},
                         {n(region.faces), n(region.cells), n(region.reconstructed), n(region.reconstructed_boundary),
                          n(region.displacement_gradient_cells), n(region.stress_cells), n(region.energy_gradient_faces)}};
        return;
    }
    const auto position = [](const auto& list, auto first) {
        return static_cast<std::int32_t>(std::ranges::lower_bound(list, first) - list.begin());
    };
    for (const Chunk& chunk : chunks_)
        region.chunks.push_back(
            {.face = position(region.faces, BoundaryFace{chunk.boundary}),
             .cell = position(region.cells, chunk.cell),
             .reconstructed = position(region.reconstructed, chunk.face),
             .reconstructed_boundary = position(region.reconstructed_boundary, BoundaryFace{chunk.boundary}),
             .displacement_gradient_cell = position(region.displacement_gradient_cells, chunk.cell),
             .stress_cell = position(region.stress_cells, chunk.cell),
             .energy_gradient_face = position(region.energy_gradient_faces, chunk.face)});
}

#define ABUT_INSTANTIATE(Dim)                                       \
    template void CcgSweeps<Dim>::set_chunks();                     \
    template void CcgSweeps<Dim>::compute_only(const Region<Dim>&); \
    template void CcgSweeps<Dim>::divide_into_chunks(Region<Dim>&) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
template void CcgSweeps<2, float>::set_chunks();
template void CcgSweeps<3, float>::set_chunks();
template void CcgSweeps<2, float>::compute_only(const Region<2>&);
template void CcgSweeps<3, float>::compute_only(const Region<3>&);
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
