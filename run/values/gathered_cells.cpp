#include "abut/run/values/gathered_cells.hpp"

#include <algorithm>
#include <limits>

namespace abut::run {
namespace {

/// The first boundary face of each cell, one more at the end: they are numbered by their cell.
template <int Dim>
std::vector<std::int32_t> boundary_begin(const mesh::Mesh<Dim>& mesh) {
    std::vector<std::int32_t> begin(mesh.cell_measure.size() + 1, 0);
    for (const std::int32_t face : mesh.boundary_faces)
        ++begin[static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(face)][0]) + 1];
    for (std::size_t c = 1; c < begin.size(); ++c) begin[c] += begin[c - 1];
    return begin;
}

}  // namespace

template <int Dim>
GatheredCells<Dim>::GatheredCells(const solid::Solid<Dim>& solid, const mesh::Mesh<Dim>& whole)
    : solid_(solid), whole_(whole) {
    if (solid.ranks().is_one()) return;
    own_ = solid.cells().own();
    for (const double number : first_gets(std::vector<double>(own_.number.begin(), own_.number.end())))
        numbers_.push_back(static_cast<std::int32_t>(number));
}

template <int Dim>
std::vector<double> GatheredCells<Dim>::first_gets(std::span<const double> own) const {
    return solid_.ranks().gather_to_first(own);
}

template <int Dim>
std::vector<double> GatheredCells<Dim>::boundary(std::span<const double> of_part) const {
    if (solid_.ranks().is_one()) return {of_part.begin(), of_part.end()};
    if (solid_.ranks().largest(of_part.empty() ? 0.0 : 1.0) == 0.0) return {};
    const std::vector<std::int32_t> begin_here = boundary_begin(solid_.mesh());
    std::vector<double> own;
    for (const std::int32_t cell : own_.position) {
        const auto c = static_cast<std::size_t>(cell);
        own.insert(own.end(), of_part.begin() + begin_here[c], of_part.begin() + begin_here[c + 1]);
    }
    const std::vector<double> all = first_gets(own);
    std::vector<double> ordered(all.size());
    if (all.empty()) return ordered;
    const std::vector<std::int32_t> begin = boundary_begin(whole_);
    auto from = all.begin();
    for (const std::int32_t cell : numbers_) {
        const auto c = static_cast<std::size_t>(cell);
        const std::int32_t n = begin[c + 1] - begin[c];
        std::copy_n(from, n, ordered.begin() + begin[c]);
        from += n;
    }
    return ordered;
}

template <int Dim>
std::vector<solid::BoundaryFace> GatheredCells<Dim>::faces(std::span<const solid::BoundaryFace> here) const {
    if (solid_.ranks().is_one()) return {here.begin(), here.end()};
    const mesh::Mesh<Dim>& part = solid_.mesh();
    std::vector<double> own;  // place in the list, number of the cell in the whole, position in the cell
    for (std::size_t i = 0; i < here.size(); ++i) {
        if (here[i] == solid::no_face) continue;
        const std::int32_t cell = solid::cell_of(part, here[i]);
        const auto at = std::ranges::lower_bound(own_.position, cell);
        if (at == own_.position.end() || *at != cell) continue;
        const auto of_cell = part.cell_faces[cell];
        const auto position = std::ranges::find(of_cell, solid::mesh_face(part, here[i])) - of_cell.begin();
        own.insert(own.end(), {static_cast<double>(i),
                               static_cast<double>(own_.number[static_cast<std::size_t>(at - own_.position.begin())]),
                               static_cast<double>(position)});
    }
    const std::vector<double> all = first_gets(own);
    if (solid_.ranks().rank() > 0) return {};
    std::vector<solid::BoundaryFace> found(here.size(), solid::no_face);
    for (std::size_t i = 0; i < all.size(); i += 3) {
        const std::int32_t face =
            whole_.cell_faces[static_cast<std::int32_t>(all[i + 1])][static_cast<std::size_t>(all[i + 2])];
        const auto number = std::ranges::lower_bound(whole_.boundary_faces, face) - whole_.boundary_faces.begin();
        found[static_cast<std::size_t>(all[i])] = static_cast<solid::BoundaryFace>(number);
    }
    return found;
}

template class GatheredCells<2>;
template class GatheredCells<3>;

}  // namespace abut::run
