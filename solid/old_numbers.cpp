#include "abut/solid/old_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"

namespace abut::solid {
namespace {

constexpr std::int32_t face_was_not_there = -1;
constexpr double same_place = 1e-9;  // of the size of a cell

template <int Dim>
class CellMatch {
public:
    CellMatch(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after, std::int32_t old_cell, std::int32_t cell)
        : before_(before),
          after_(after),
          old_cell_(old_cell),
          cell_(cell),
          near_(same_place * std::pow(before.cell_measure[static_cast<std::size_t>(old_cell)], 1.0 / Dim)) {}

    /// Old number of a face of the cell.
    [[nodiscard]] std::int32_t old_face(std::int32_t face) const {
        const auto faces = before_.cell_faces[old_cell_];
        const auto found = std::ranges::find_if(faces, [&](std::int32_t old) { return is_same(face, old); });
        if (found == faces.end())
            throw BadInput(
                after_.name + ": cell " + std::to_string(after_.cell_label[static_cast<std::size_t>(cell_)]) +
                    " is said to have been cell " + std::to_string(before_.cell_label[static_cast<std::size_t>(old_cell_)]) +
                    ", but its corners are elsewhere. Give each cell its old number; cells that are split or moved "
                    "are others.",
                {.cell = cell_});
        return *found;
    }

private:
    [[nodiscard]] bool is_same(std::int32_t face, std::int32_t old) const {
        const auto corners = after_.face_vertices[face], old_corners = before_.face_vertices[old];
        const auto is_there = [&](std::int32_t v) {
            return std::ranges::any_of(old_corners, [&](std::int32_t w) {
                return (after_.vertices[static_cast<std::size_t>(v)] - before_.vertices[static_cast<std::size_t>(w)])
                           .norm() <= near_;
            });
        };
        return corners.size() == old_corners.size() && std::ranges::all_of(corners, is_there);
    }

    const mesh::Mesh<Dim>& before_;
    const mesh::Mesh<Dim>& after_;
    std::int32_t old_cell_, cell_;
    double near_;  // [m]
};

}  // namespace

template <int Dim>
std::vector<std::int32_t> old_faces(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after,
                                    std::span<const std::int32_t> old_cells) {
    std::vector<std::int32_t> old(static_cast<std::size_t>(after.n_faces()), face_was_not_there);
    for (std::int32_t cell = 0; cell < after.n_cells(); ++cell) {
        const CellMatch<Dim> match(before, after, old_cells[static_cast<std::size_t>(cell)], cell);
        for (const std::int32_t face : after.cell_faces[cell]) old[static_cast<std::size_t>(face)] = match.old_face(face);
    }
    return old;
}

template <int Dim>
std::vector<std::int32_t> old_boundary_faces(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after,
                                             std::span<const std::int32_t> old_faces) {
    std::vector<std::int32_t> old;
    for (const std::int32_t face : after.boundary_faces) {
        const std::int32_t was = old_faces[static_cast<std::size_t>(face)];
        const auto at = std::ranges::lower_bound(before.boundary_faces, was);
        const bool is_boundary = was >= 0 && at != before.boundary_faces.end() && *at == was;
        old.push_back(is_boundary ? static_cast<std::int32_t>(at - before.boundary_faces.begin()) : face_was_not_there);
    }
    return old;
}

template <int Dim>
void check_corners(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after,
                   std::span<const std::int32_t> old_boundary_faces) {
    for (std::size_t b = 0; b < old_boundary_faces.size(); ++b) {
        if (old_boundary_faces[b] < 0) continue;
        const std::int32_t face = after.boundary_faces[b];
        const std::int32_t old = before.boundary_faces[static_cast<std::size_t>(old_boundary_faces[b])];
        const std::int32_t cell = after.face_cells[static_cast<std::size_t>(face)][0];
        const double near = same_place * std::pow(after.cell_measure[static_cast<std::size_t>(cell)], 1.0 / Dim);
        if (!std::ranges::equal(after.face_vertices[face], before.face_vertices[old], [&](std::int32_t v, std::int32_t w) {
                return (after.vertices[static_cast<std::size_t>(v)] - before.vertices[static_cast<std::size_t>(w)]).norm() <=
                       near;
            }))
            throw BadInput(
                after.name + ": the corners of a face of cell " +
                    std::to_string(after.cell_label[static_cast<std::size_t>(cell)]) +
                    " come in another order than before, and contact goes by that. Keep the order of the vertices of "
                    "each cell.",
                {.cell = cell});
    }
}

#define ABUT_INSTANTIATE(Dim)                                                                             \
    template std::vector<std::int32_t> old_faces(const mesh::Mesh<Dim>&, const mesh::Mesh<Dim>&,          \
                                                 std::span<const std::int32_t>);                          \
    template std::vector<std::int32_t> old_boundary_faces(const mesh::Mesh<Dim>&, const mesh::Mesh<Dim>&, \
                                                          std::span<const std::int32_t>);                 \
    template void check_corners(const mesh::Mesh<Dim>&, const mesh::Mesh<Dim>&, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
