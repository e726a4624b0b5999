#include <algorithm>
#include <array>
#include <functional>
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

/// Position of the first element of a sorted list that is not less.
template <class List, class Value, class Key = std::identity>
std::int32_t position(const List& sorted, const Value& value, const Key& key = {}) {
    return static_cast<std::int32_t>(std::ranges::lower_bound(sorted, value, {}, key) - std::ranges::begin(sorted));
}

}  // namespace

/// Chunks of cells with the faces they are the first side of, and which of them read each other's results.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::set_chunks() {
    const CcgArrays<Dim>& a = state_.arrays;
    const auto begin_chunk = [&](std::int32_t cell, std::int32_t end) {
        const auto face = static_cast<std::int32_t>(std::partition_point(a.face_cells.begin(), a.face_cells.end(),
                                                                         [&](const auto& side) { return side[0] < cell; }) -
                                                    a.face_cells.begin());
        chunks_.push_back({.cell = cell,
                           .face = face,
                           .boundary = position(a.boundary_faces, face),
                           .kind = cell < end ? kind_of(cell) : Kind::linear});
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
    for (const BoundaryFace b : a.affine.faces)
        for (const std::int32_t c : a.stencils[a.face_of(b)].cells) {
            need(displacement_gradients, a.cell_of(b), c);
            need(cell_gradients, c, a.cell_of(b));
        }
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

    const std::vector<bool> cells(a.cells.size(), true), faces(a.faces.size(), true);
    wanted_ = lists_of({.loaded = cells,
                        .displacement_gradients = cells,
                        .stresses = cells,
                        .cell_gradients = cells,
                        .reconstructed = faces,
                        .face_gradients = faces});
}

template <int Dim, class Real>
SweepLists CcgSweeps<Dim, Real>::lists_of(const WantedElements& wanted) const {
    const CcgArrays<Dim>& a = state_.arrays;
    SweepLists lists;
    const auto append_cells = [](OfChunks<Run>& runs, const Chunk& from, const Chunk& to, const std::vector<bool>& cells) {
        append_runs(runs, from.cell, to.cell, [&](std::int32_t c) { return cells[c]; });
    };
    const auto append_interior_faces = [&](OfChunks<Run>& runs, const Chunk& from, const Chunk& to,
                                           const std::vector<bool>& faces) {
        append_runs(runs, from.face, to.face, [&](std::int32_t f) { return faces[f] && a.boundary_index[f] == no_face; });
    };
    const auto append_rows = [&](OfChunks<BoundaryFace>& rows, const Chunk& from, const Chunk& to,
                                 const std::vector<bool>& faces) {
        const std::int32_t end = position(a.row_faces, BoundaryFace{to.boundary});
        for (std::int32_t i = position(a.row_faces, BoundaryFace{from.boundary}); i < end; ++i)
            if (faces[a.face_of(a.row_faces[i])]) rows.push_back(a.row_faces[i]);
        rows.end_chunk();
    };
    const auto append_among = []<class Cell>(OfChunks<Cell>& among, std::span<const Cell> all, const Chunk& from,
                                             const Chunk& to, const std::vector<bool>& cells) {
        const std::int32_t end = position(all, to.cell, &Cell::cell);
        for (std::int32_t i = position(all, from.cell, &Cell::cell); i < end; ++i)
            if (cells[all[i].cell]) among.push_back(all[i]);
        among.end_chunk();
    };
    const std::span<const CondensedCell> condensed = a.simplices.condensed();
    const std::span<const AffineCell> affine = a.affine.cells;
    for (std::size_t k = 0; k + 1 < chunks_.size(); ++k) {
        const Chunk &from = chunks_[k], &to = chunks_[k + 1];
        append_cells(lists.loaded, from, to, wanted.loaded);
        append_interior_faces(lists.reconstructed, from, to, wanted.reconstructed);
        append_rows(lists.reconstructed_rows, from, to, wanted.reconstructed);
        append_cells(lists.displacement_gradients, from, to, wanted.displacement_gradients);
        append_among(lists.condensed_gradients, condensed, from, to, wanted.displacement_gradients);
        append_among(lists.affine_traces, affine, from, to, wanted.displacement_gradients);
        append_cells(lists.stresses, from, to, wanted.stresses);
        append_among(lists.condensed_stresses, condensed, from, to, wanted.stresses);
        append_among(lists.affine_gradients, affine, from, to, wanted.stresses);
        append_interior_faces(lists.face_gradients, from, to, wanted.face_gradients);
        append_rows(lists.row_gradients, from, to, wanted.face_gradients);
        append_cells(lists.cell_gradients, from, to, wanted.cell_gradients);
        append_runs(lists.boundary_cell_gradients, position(a.boundary_cells, from.cell),
                    position(a.boundary_cells, to.cell),
                    [&](std::int32_t i) { return wanted.cell_gradients[a.boundary_cells[i]]; });
    }
    return lists;
}

template <int Dim, class Real>
void CcgSweeps<Dim, Real>::compute_only(const Region<Dim>& region) {
    const auto marks = [](std::size_t n, const std::vector<std::int32_t>& elements) {
        std::vector<bool> wanted(n, false);
        for (const std::int32_t i : elements) wanted[i] = true;
        return wanted;
    };
    const std::size_t n_cells = state_.arrays.cells.size(), n_faces = state_.arrays.faces.size();
    WantedElements wanted{.loaded = marks(n_cells, region.input_cells),
                          .displacement_gradients = marks(n_cells, region.displacement_gradient_cells),
                          .stresses = marks(n_cells, region.stress_cells),
                          .cell_gradients = marks(n_cells, region.cells),
                          .reconstructed = marks(n_faces, region.reconstructed),
                          .face_gradients = marks(n_faces, region.energy_gradient_faces)};
    for (const BoundaryFace b : region.reconstructed_boundary) wanted.reconstructed[state_.arrays.face_of(b)] = true;
    for (const BoundaryFace b : region.faces) wanted.face_gradients[state_.arrays.face_of(b)] = true;
    for (const std::int32_t c : region.cells)  // contact may ask for boundary faces that no cell needs
        for (const HalfFace& half_face : state_.arrays.half_faces_of(c))
            if (state_.arrays.boundary_index[half_face.face] != no_face) wanted.face_gradients[half_face.face] = true;
    wanted_ = lists_of(wanted);
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
