#include "abut/run/values/frame_piece.hpp"

#include <algorithm>
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
#include "abut/solid/kinematics/properties.hpp"

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
        piece.cells = std::move(own.position);
        piece.cell_number = std::move(own.number);
        piece.number = solid.ranks().rank();
        piece.n_pieces = solid.ranks().n_ranks();
        for (const std::int32_t cell : piece.cells) is_own_[static_cast<std::size_t>(cell)] = 1;
    }

    void take_cells(const dynamics::RunView<Dim>& run) {
        static_cast<void>(solid_.potential(run.q));  // leaves the stresses of this state behind
        const auto displacement = solid_.cells().displacement(run.q);
        const auto velocity = cell_velocity(run, solid_);
        const std::vector<double> fragment = fragment_of_cells(solid_);
        for (const std::int32_t position : piece_.cells) {
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
            for (const std::int32_t position : piece_.cells)
                own_gradients_.push_back(solid_.cells().displacement_gradient(position, run.q));
        const std::vector<Vector<Dim>> of_all = vertex_means(around);
        for (const std::int32_t v : piece_.vertices)
            piece_.vertex_displacement.push_back(of_all[static_cast<std::size_t>(v)]);
    }

    /// Boundary faces of own cells come in the order of the whole mesh.
    void take_boundary(const solid::ContactField& contact) {
        const std::vector<double> bonds = left_of_bonds(solid_);
        for (std::size_t b = 0; b < mesh_.boundary_faces.size(); ++b) {
            if (!is_own_[first_cell(b)]) continue;
            piece_.boundary.push_back(static_cast<std::int32_t>(b));
            if (!bonds.empty()) piece_.bond.push_back(bonds[b]);
            piece_.pressure.push_back(contact.pressure[b]);
            piece_.gap.push_back(gap_in_contact(contact.gap[b]));
            if (contact.friction.empty()) continue;
            piece_.friction.push_back(contact.friction[b]);
            piece_.slip.push_back(contact.slip[b]);
            piece_.sliding.push_back(contact.sliding[b]);
        }
        number_faces();
    }

private:
    [[nodiscard]] std::size_t first_cell(std::size_t boundary) const {
        return static_cast<std::size_t>(mesh_.face_cells[static_cast<std::size_t>(mesh_.boundary_faces[boundary])][0]);
    }

    /// Boundary faces are numbered by their cell: all ranks tell of whose cells theirs are.
    void number_faces() {
        std::vector<double> mine;  // numbers of the cells
        auto own = piece_.cells.begin();
        for (const std::int32_t b : piece_.boundary) {
            while (static_cast<std::size_t>(*own) != first_cell(static_cast<std::size_t>(b))) ++own;
            mine.push_back(piece_.cell_number[static_cast<std::size_t>(own - piece_.cells.begin())]);
        }
        std::vector<double> all = solid_.ranks().gather(mine);
        std::ranges::sort(all);
        std::size_t next = 0;
        for (std::size_t i = 0; i < mine.size(); ++i) {
            if (i == 0 || mine[i] != mine[i - 1])
                next = static_cast<std::size_t>(std::ranges::lower_bound(all, mine[i]) - all.begin());
            piece_.face_number.push_back(static_cast<std::int32_t>(next++));
        }
    }

    /// Own cells around each vertex.
    [[nodiscard]] std::vector<int> count_around() const {
        std::vector<int> around(mesh_.vertices.size(), 0);
        for (const std::int32_t cell : piece_.cells)
            for (const std::int32_t v : mesh_.cell_vertices[cell]) ++around[static_cast<std::size_t>(v)];
        return around;
    }

    /// Means over all cells around a vertex, one after the other by number, of where each carries it: by its
    /// displacement and, where a body turns, by its displacement gradient.
    [[nodiscard]] std::vector<Vector<Dim>> vertex_means(const std::vector<int>& around) const {
        const std::vector<Carried> carried = carried_by_cells();
        std::vector<Vector<Dim>> mean(mesh_.vertices.size(), Vector<Dim>::Zero());
        std::vector<int> count(mesh_.vertices.size(), 0);
        for (std::size_t cell = 0; cell < carried.size(); ++cell)
            for (const std::int32_t v : mesh_.cell_vertices[static_cast<std::int32_t>(cell)]) {
                const auto vertex = static_cast<std::size_t>(v);
                if (around[vertex] == 0) continue;
                const Carried& by = carried[cell];
                if (any_turns_)
                    mean[vertex] += by.displacement + by.gradient * (mesh_.vertices[vertex] - mesh_.cell_centroid[cell]);
                else
                    mean[vertex] += by.displacement;
                ++count[vertex];
            }
        for (const std::int32_t v : piece_.vertices) mean[static_cast<std::size_t>(v)] /= count[static_cast<std::size_t>(v)];
        return mean;
    }

    /// How a cell carries its vertices.
    struct Carried {
        Vector<Dim> displacement = Vector<Dim>::Zero();
        Matrix<Dim> gradient = Matrix<Dim>::Zero();  // where a body turns
    };
    /// Motion of the cells here: owners tell that of copies, except in rigid bodies, which share no vertex between
    /// ranks.
    [[nodiscard]] std::vector<Carried> carried_by_cells() const {
        std::vector<Carried> carried(mesh_.cell_measure.size());
        for (std::size_t i = 0; i < piece_.cells.size(); ++i) {
            Carried& own = carried[static_cast<std::size_t>(piece_.cells[i])];
            own.displacement = piece_.displacement[i];
            if (any_turns_) own.gradient = own_gradients_[i];
        }
        if (solid_.ranks().is_one()) return carried;
        const std::vector<std::size_t> cells = cells_that_deform();
        std::vector<Carried> entries;  // of these cells, then of the points of rigid bodies
        for (const std::size_t cell : cells) entries.push_back(carried[cell]);
        entries.resize(cells.size() + (Dim + 1) * n_rigid_bodies());
        constexpr int width = sizeof(Carried) / sizeof(double);
        solid_.ranks().fill({reinterpret_cast<double*>(entries.data()), width * entries.size()}, width,
                            dynamics::CopySet::all);
        for (std::size_t i = 0; i < cells.size(); ++i) carried[cells[i]] = entries[i];
        return carried;
    }
    [[nodiscard]] bool deforms(std::int32_t body) const {
        return solid::properties_of(solid_.options().kinematics, static_cast<std::size_t>(body)).deforms;
    }
    [[nodiscard]] std::vector<std::size_t> cells_that_deform() const {
        std::vector<std::size_t> cells;
        for (std::size_t cell = 0; cell < mesh_.cell_body.size(); ++cell)
            if (deforms(mesh_.cell_body[cell])) cells.push_back(cell);
        return cells;
    }
    [[nodiscard]] std::size_t n_rigid_bodies() const {
        std::size_t n = 0;
        for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body) n += deforms(body) ? 0 : 1;
        return n;
    }

    FramePiece<Dim>& piece_;
    solid::Solid<Dim>& solid_;
    const mesh::Mesh<Dim>& mesh_;
    bool any_turns_;                          // then the mean displacement of its cells does not take a vertex where it is
    std::vector<char> is_own_;                // of the cells here
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
FramePiece<Dim> frame_piece(std::int64_t frame, const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    FramePiece<Dim> piece;
    piece.frame = frame;
    piece.time = run.time;
    piece.mesh = &solid.mesh();
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
template FramePiece<2> frame_piece(std::int64_t, const dynamics::RunView<2>&, solid::Solid<2>&);
template FramePiece<3> frame_piece(std::int64_t, const dynamics::RunView<3>&, solid::Solid<3>&);

}  // namespace abut::run
