#include "abut/run/values/frame_piece.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "abut/run/values/cell_velocity.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/fragments.hpp"

namespace abut::run {
namespace {

/// The part of a frame that needs no other rank than by a few gathered values.
template <int Dim>
class PieceMaker {
public:
    PieceMaker(FramePiece<Dim>& piece, solid::Solid<Dim>& solid)
        : piece_(piece),
          solid_(solid),
          mesh_(*piece.mesh),
          any_turns_(solid.moment_arms() == dynamics::MomentArms::mid_step),
          is_own_(mesh_.cell_measure.size(), 0) {
        solid::OwnCells own = solid.cells().own();
        piece.cells = std::move(own.number);
        positions_ = std::move(own.position);
        piece.number = solid.ranks().rank();
        piece.n_pieces = solid.ranks().n_ranks();
        for (const std::int32_t cell : piece.cells) is_own_[static_cast<std::size_t>(cell)] = 1;
    }

    void take_cells(const dynamics::RunView<Dim>& run) {
        static_cast<void>(solid_.potential(run.q));  // leaves the stresses of this state behind
        const auto displacement = solid_.cells().displacement(run.q);
        const auto velocity = cell_velocity(run, solid_);
        const std::vector<double> fragment = fragment_of_cells(solid_);
        for (const std::int32_t position : positions_) {
            const auto c = static_cast<std::size_t>(position);
            piece_.displacement.push_back(displacement[c]);
            piece_.velocity.push_back(velocity[c]);
            piece_.stress.push_back(solid_.cells().stress(position));
            piece_.out_of_plane_stress.push_back(solid_.cells().out_of_plane_stress(position));
            if (!fragment.empty()) piece_.fragment.push_back(fragment[c]);
            if (solid_.ccg().any_inelastic()) piece_.plastic_strain.push_back(solid_.cells().plastic_strain(position));
        }
    }

    void take_vertices(const dynamics::RunView<Dim>& run) {
        const std::vector<int> around = count_around();
        for (std::size_t v = 0; v < around.size(); ++v)
            if (around[v] > 0) piece_.vertices.push_back(static_cast<std::int32_t>(v));
        if (any_turns_)
            for (const std::int32_t position : positions_)
                own_gradients_.push_back(solid_.cells().displacement_gradient(position, run.q));
        const std::vector<Vector<Dim>> of_all = vertex_means(around);
        for (const std::int32_t v : piece_.vertices)
            piece_.vertex_displacement.push_back(of_all[static_cast<std::size_t>(v)]);
    }

    /// Boundary faces of own cells come in the order of the whole mesh, in a part as well.
    void take_boundary(const solid::ContactField& contact) {
        const mesh::Mesh<Dim>& part = solid_.mesh();
        std::vector<char> is_own_here(part.cell_measure.size(), 0);
        for (const std::int32_t position : positions_) is_own_here[static_cast<std::size_t>(position)] = 1;
        const std::vector<double> bonds = left_of_bonds(solid_);
        for (std::size_t b = 0; b < part.boundary_faces.size(); ++b) {
            if (!is_own_here[first_cell(part, b)]) continue;
            if (!bonds.empty()) piece_.bond.push_back(bonds[b]);
            piece_.pressure.push_back(contact.pressure[b]);
            piece_.gap.push_back(gap_in_contact(contact.gap[b]));
            if (contact.friction.empty()) continue;
            piece_.friction.push_back(contact.friction[b]);
            piece_.slip.push_back(contact.slip[b]);
            piece_.sliding.push_back(contact.sliding[b]);
        }
        for (std::size_t b = 0; b < mesh_.boundary_faces.size(); ++b)
            if (is_own_[first_cell(mesh_, b)]) piece_.boundary.push_back(static_cast<std::int32_t>(b));
    }

private:
    [[nodiscard]] static std::size_t first_cell(const mesh::Mesh<Dim>& mesh, std::size_t boundary) {
        return static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(mesh.boundary_faces[boundary])][0]);
    }

    /// Own cells around each vertex.
    [[nodiscard]] std::vector<int> count_around() const {
        std::vector<int> around(mesh_.vertices.size(), 0);
        for (const std::int32_t cell : piece_.cells)
            for (const std::int32_t v : mesh_.cell_vertices[cell]) ++around[static_cast<std::size_t>(v)];
        return around;
    }

    /// Means over all cells around a vertex, one after the other by number, of where each carries it: by its
    /// displacement and, where a body turns, by its displacement gradient. Other ranks bring those of their cells.
    [[nodiscard]] std::vector<Vector<Dim>> vertex_means(const std::vector<int>& around) const {
        std::vector<Vector<Dim>> of_cells(mesh_.cell_measure.size(), Vector<Dim>::Zero());
        std::vector<Matrix<Dim>> gradients(any_turns_ ? of_cells.size() : 0, Matrix<Dim>::Zero());
        for (std::size_t i = 0; i < piece_.cells.size(); ++i) {
            of_cells[static_cast<std::size_t>(piece_.cells[i])] = piece_.displacement[i];
            if (any_turns_) gradients[static_cast<std::size_t>(piece_.cells[i])] = own_gradients_[i];
        }
        const std::vector<double> shared = solid_.ranks().gather(values_at_seams());
        const std::size_t width = 1 + Dim + (any_turns_ ? Dim * Dim : 0);
        for (std::size_t i = 0; i < shared.size(); i += width) {
            const auto cell = static_cast<std::size_t>(shared[i]);
            of_cells[cell] = Vector<Dim>(&shared[i + 1]);
            if (any_turns_) gradients[cell] = Matrix<Dim>(&shared[i + 1 + Dim]);
        }
        std::vector<Vector<Dim>> mean(mesh_.vertices.size(), Vector<Dim>::Zero());
        std::vector<int> count(mesh_.vertices.size(), 0);
        for (std::size_t cell = 0; cell < of_cells.size(); ++cell)
            for (const std::int32_t v : mesh_.cell_vertices[static_cast<std::int32_t>(cell)]) {
                const auto vertex = static_cast<std::size_t>(v);
                if (around[vertex] == 0) continue;
                if (any_turns_)
                    mean[vertex] += of_cells[cell] + gradients[cell] * (mesh_.vertices[vertex] - mesh_.cell_centroid[cell]);
                else
                    mean[vertex] += of_cells[cell];
                ++count[vertex];
            }
        for (const std::int32_t v : piece_.vertices) mean[static_cast<std::size_t>(v)] /= count[static_cast<std::size_t>(v)];
        return mean;
    }

    /// Number, displacement and, where a body turns, displacement gradient of own cells that share a vertex with a cell of
    /// another rank.
    [[nodiscard]] std::vector<double> values_at_seams() const {
        std::vector<char> at_seam(mesh_.vertices.size(), 0);
        for (std::int32_t cell = 0; cell < mesh_.n_cells(); ++cell)
            if (!is_own_[static_cast<std::size_t>(cell)])
                for (const std::int32_t v : mesh_.cell_vertices[cell]) at_seam[static_cast<std::size_t>(v)] = 1;
        std::vector<double> values;
        for (std::size_t i = 0; i < piece_.cells.size(); ++i) {
            bool shared = false;
            for (const std::int32_t v : mesh_.cell_vertices[piece_.cells[i]])
                shared = shared || at_seam[static_cast<std::size_t>(v)] != 0;
            if (!shared) continue;
            values.push_back(piece_.cells[i]);
            values.insert(values.end(), piece_.displacement[i].begin(), piece_.displacement[i].end());
            if (!any_turns_) continue;
            values.insert(values.end(), own_gradients_[i].data(), own_gradients_[i].data() + Dim * Dim);
        }
        return values;
    }

    FramePiece<Dim>& piece_;
    solid::Solid<Dim>& solid_;
    const mesh::Mesh<Dim>& mesh_;
    bool any_turns_;                          // then the mean displacement of its cells does not take a vertex where it is
    std::vector<char> is_own_;                // of the cells of the scene
    std::vector<std::int32_t> positions_;     // of own cells in the mesh of the solid
    std::vector<Matrix<Dim>> own_gradients_;  // of displacement; empty where no body turns
};

}  // namespace

template <int Dim>
std::vector<double> left_of_bonds(const solid::Solid<Dim>& solid) {
    if (solid.bonds().places().empty()) return {};
    std::vector<double> left(solid.mesh().boundary_faces.size(), 0.0), area(left);
    std::size_t number = 0;
    for (const solid::BondPlace<Dim>& place : solid.bonds().places()) {
        for (const solid::BoundaryFace b : place.faces) {
            if (b == solid::no_face) continue;
            area[static_cast<std::size_t>(b)] += place.area;
            left[static_cast<std::size_t>(b)] += solid.bonds().share(number) * place.area;
        }
        ++number;
    }
    for (std::size_t b = 0; b < left.size(); ++b) left[b] /= area[b];  // 0/0 where none is
    return left;
}

template <int Dim>
std::vector<double> fragment_of_cells(const solid::Solid<Dim>& solid) {
    if (!solid.bonds().may_break()) return {};
    const std::vector<std::int32_t> of_bodies = solid::fragment_of_bodies(solid);
    std::vector<double> of_cells;
    for (const std::int32_t body : solid.mesh().cell_body) of_cells.push_back(of_bodies[static_cast<std::size_t>(body)]);
    return of_cells;
}

template <int Dim>
FramePiece<Dim> frame_piece(std::int64_t frame, const mesh::Mesh<Dim>& mesh, const dynamics::RunView<Dim>& run,
                            solid::Solid<Dim>& solid) {
    FramePiece<Dim> piece;
    piece.frame = frame;
    piece.time = run.time;
    piece.mesh = &mesh;
    PieceMaker<Dim> maker(piece, solid);
    const solid::ContactField contact = solid.contact_at(run.q).field();
    maker.take_cells(run);
    maker.take_vertices(run);
    maker.take_boundary(contact);
    return piece;
}

template std::vector<double> left_of_bonds(const solid::Solid<2>&);
template std::vector<double> left_of_bonds(const solid::Solid<3>&);
template std::vector<double> fragment_of_cells(const solid::Solid<2>&);
template std::vector<double> fragment_of_cells(const solid::Solid<3>&);
template FramePiece<2> frame_piece(std::int64_t, const mesh::Mesh<2>&, const dynamics::RunView<2>&, solid::Solid<2>&);
template FramePiece<3> frame_piece(std::int64_t, const mesh::Mesh<3>&, const dynamics::RunView<3>&, solid::Solid<3>&);

}  // namespace abut::run
