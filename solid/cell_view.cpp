// What a solid tells of the cells of its mesh, and the path between them and its points.
#include "abut/solid/cell_view.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

template <int Dim>
std::vector<double> as_numbers(const std::vector<Vector<Dim>>& vectors) {
    std::vector<double> numbers;
    for (const Vector<Dim>& vector : vectors) numbers.insert(numbers.end(), vector.begin(), vector.end());
    return numbers;
}

/// Sums of counts and the lowest weight, of all ranks.
StencilReport of_all(const dynamics::Ranks& ranks, StencilReport own) {
    const std::vector<double> all =
        ranks.gather(std::vector<double>{static_cast<double>(own.faces), static_cast<double>(own.extrapolated),
                                         static_cast<double>(own.lowered_floor), own.worst_weight});
    own.faces = own.extrapolated = own.lowered_floor = 0;
    for (std::size_t i = 0; i < all.size(); i += 4) {
        own.faces += static_cast<std::int64_t>(all[i]);
        own.extrapolated += static_cast<std::int64_t>(all[i + 1]);
        own.lowered_floor += static_cast<std::int64_t>(all[i + 2]);
        own.worst_weight = std::min(own.worst_weight, all[i + 3]);
    }
    return own;
}

/// Adds the faces of a list that count.
template <class Counts>
void add_lowered(const std::vector<std::int32_t>& faces, const Counts& counts, StencilReport& report) {
    std::ranges::copy_if(faces, std::back_inserter(report.lowered_faces), counts);
    report.lowered_floor = std::ssize(report.lowered_faces);
}

}  // namespace

template <int Dim>
OwnCells CellView<Dim>::own() const {
    OwnCells own;
    std::vector<bool> is_own(solid_.mesh_.cell_body.size(), false), is_own_body(solid_.mesh_.body_names.size(), false);
    for (const std::int32_t c : solid_.part_->own_cells()) is_own[solid_.bodies_->mesh_cell(c)] = true;
    for (const std::int32_t i : solid_.part_->own_rigid()) is_own_body[solid_.bodies_->rigid().mesh_body(i)] = true;
    std::int32_t deformable = 0, begin = 0;  // bodies that deform so far; where a body begins in the whole mesh
    for (std::int32_t body = 0; body < solid_.mesh_.n_bodies(); ++body) {
        const auto [first, last] = cells_of_body(solid_.mesh_, body);
        const bool rigid = solid_.bodies_->is_rigid(body);
        for (std::int32_t c = first; c < last; ++c) {
            if (rigid ? !is_own_body[body] : !is_own[c]) continue;
            const std::int32_t in_body =
                rigid ? c - first
                      : static_cast<std::int32_t>(solid_.part_->cell_numbers()[solid_.bodies_->deformable_cell(c).first]) -
                            solid_.part_->body_begin()[deformable];
            own.number.push_back(begin + in_body);
            own.position.push_back(c);
        }
        begin += rigid ? last - first : solid_.part_->body_begin()[deformable + 1] - solid_.part_->body_begin()[deformable];
        if (!rigid) ++deformable;
    }
    return own;
}

template <int Dim>
std::int32_t CellView<Dim>::of_mesh(std::int32_t of_operators) const {
    return solid_.bodies_->mesh_cell(of_operators);
}

template <int Dim>
Matrix<Dim> CellView<Dim>::stress(std::int32_t cell) const {
    const auto [deformable, body] = solid_.bodies_->deformable_cell(cell);
    if (deformable < 0) return Matrix<Dim>::Zero();
    const Matrix<Dim>& turn = solid_.frames_->end()[static_cast<std::size_t>(body)].turn;
    return turn * solid_.ccg_.stress_under_pushes(deformable) * turn.transpose();
}

template <int Dim>
double CellView<Dim>::out_of_plane_stress(std::int32_t cell) const {
    if constexpr (Dim == 3) return 0.0;
    const std::int32_t deformable = solid_.bodies_->deformable_cell(cell).first;
    if (deformable < 0) return 0.0;
    if (const auto of_law = solid_.ccg_.out_of_plane_stress(deformable)) return *of_law;
    const auto body = static_cast<std::size_t>(solid_.mesh_.cell_body[static_cast<std::size_t>(cell)]);
    return solid_.options_.materials[body].poisson * stress(cell).trace();
}

template <int Dim>
double CellView<Dim>::plastic_strain(std::int32_t cell) const {
    const std::int32_t deformable = solid_.bodies_->deformable_cell(cell).first;
    return deformable < 0 ? 0.0 : solid_.ccg_.plastic_strain(deformable);
}

template <int Dim>
Matrix<Dim> CellView<Dim>::displacement_gradient(std::int32_t cell, std::span<const double> q) const {
    const auto [deformable, body] = solid_.bodies_->deformable_cell(cell);
    if (deformable >= 0) {
        const Matrix<Dim>& turn = solid_.frames_->end()[static_cast<std::size_t>(body)].turn;
        return turn * solid_.ccg_.displacement_gradient(deformable) + turn - Matrix<Dim>::Identity();
    }
    for (std::size_t i = 0; i < solid_.bodies_->rigid().size(); ++i)
        if (solid_.bodies_->rigid().mesh_body(i) == solid_.mesh_.cell_body[cell])
            return solid_.bodies_->rigid().place_by(i, own_points_of(i, as_vectors<Dim>(q))).map - Matrix<Dim>::Identity();
    return Matrix<Dim>::Zero();
}

/// The part of q that belongs to an own rigid body.
template <int Dim>
std::span<const Vector<Dim>> CellView<Dim>::own_points_of(std::size_t rigid, std::span<const Vector<Dim>> q) const {
    constexpr std::size_t n = RigidBodies<Dim>::points_per_body;
    const auto own = solid_.part_->own_rigid();
    const auto found = std::ranges::find(own, static_cast<std::int32_t>(rigid));
    if (found == own.end())
        throw Misuse("solid: the displacement gradient of rigid body " +
                     std::to_string(solid_.bodies_->rigid().mesh_body(rigid)) +
                     " is asked for on a rank that does not own its points. Ask the rank that owns the body.");
    return q.subspan(solid_.part_->own_cells().size() + n * static_cast<std::size_t>(found - own.begin()), n);
}

template <int Dim>
std::vector<Vector<Dim>> CellView<Dim>::vertex_displacement(std::span<const double> q) const {
    solid_.require(features_of(solid_.ranks()) | FeatureSet{Feature::vertex_displacement});
    const std::vector<Vector<Dim>> of_cells = displacement(q);
    std::vector<Vector<Dim>> result(solid_.mesh_.vertices.size(), Vector<Dim>::Zero());
    std::vector<int> n_cells(solid_.mesh_.vertices.size(), 0);
    for (std::int32_t c = 0; c < solid_.mesh_.n_cells(); ++c) {
        const Matrix<Dim> gradient = displacement_gradient(c, q);
        for (const std::int32_t v : solid_.mesh_.cell_vertices[c]) {
            result[v] += of_cells[c] + gradient * (solid_.mesh_.vertices[v] - solid_.mesh_.cell_centroid[c]);
            ++n_cells[v];
        }
    }
    for (std::size_t v = 0; v < result.size(); ++v) result[v] /= std::max(1, n_cells[v]);
    return result;
}

template <int Dim>
std::vector<Vector<Dim>> CellView<Dim>::displacement(std::span<const double> q) const {
    std::vector<Vector<Dim>> kept;
    return solid_.bodies_->of_cells(solid_.part_->filled(as_vectors<Dim>(q), kept));
}

template <int Dim>
std::vector<Vector<Dim>> CellView<Dim>::velocity(std::span<const double> p) const {
    std::vector<Vector<Dim>> kept;
    return solid_.bodies_->velocities(solid_.part_->filled(as_vectors<Dim>(p), kept));
}

template <int Dim>
std::vector<double> CellView<Dim>::to_q(std::span<const Vector<Dim>> of_cells) const {
    return as_numbers<Dim>(solid_.part_->own(solid_.bodies_->of_points(of_cells)));
}

template <int Dim>
std::vector<double> CellView<Dim>::to_p(std::span<const Vector<Dim>> cell_velocity) const {
    return as_numbers<Dim>(solid_.part_->own(solid_.bodies_->momenta(cell_velocity)));
}

template <int Dim>
StencilReports CellView<Dim>::stencils() const {
    const Ccg<Dim>& ccg = solid_.ccg_;
    StencilReports reports{ccg.stencil_report(), ccg.boundary().report};
    if (solid_.ranks().is_one()) return reports;
    const mesh::Mesh<Dim>& mesh = solid_.bodies_->deformable();
    std::vector<bool> is_own(mesh.cell_measure.size(), false);
    for (const std::int32_t cell : solid_.part_->own_cells()) is_own[static_cast<std::size_t>(cell)] = true;
    const auto counts = [&](std::int32_t face) {
        return is_own[static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(face)][0])];
    };
    StencilReport interior, boundary;
    for (std::int32_t face = 0; face < mesh.n_faces(); ++face)
        if (!mesh.is_boundary(face) && counts(face))
            interior.add(face, std::ranges::min(ccg.stencils()[static_cast<std::size_t>(face)].weights));
    for (const auto& [face, lowest] : ccg.boundary().lowest_weights)
        if (counts(mesh_face(mesh, face))) boundary.add(mesh_face(mesh, face), lowest);
    add_lowered(reports.interior.lowered_faces, counts, interior);
    add_lowered(reports.boundary.lowered_faces, counts, boundary);
    return {of_all(solid_.ranks(), std::move(interior)), of_all(solid_.ranks(), std::move(boundary))};
}

template <int Dim>
const FiniteExtremes& CellView<Dim>::finite_extremes() const {
    return solid_.finite_extremes_;
}

template class CellView<2>;
template class CellView<3>;

}  // namespace abut::solid
