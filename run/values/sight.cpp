#include "abut/run/values/sight.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "abut/run/values/cell_velocity.hpp"
#include "abut/run/values/frame_piece.hpp"
#include "abut/run/values/gathered_cells.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/fragments.hpp"

namespace abut::run {
namespace {

/// Pairs with the boundary faces of the whole.
template <int Dim>
std::vector<solid::ActingPair<Dim>> with_whole_faces(std::vector<solid::ActingPair<Dim>> pairs,
                                                     const GatheredCells<Dim>& gathered) {
    std::vector<solid::BoundaryFace> faces;
    for (const solid::ActingPair<Dim>& pair : pairs) faces.insert(faces.end(), {pair.face_1, pair.face_2});
    const std::vector<solid::BoundaryFace> of_whole = gathered.faces(faces);
    if (of_whole.size() != faces.size()) return {};
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].face_1 = of_whole[2 * i];
        pairs[i].face_2 = of_whole[2 * i + 1];
    }
    return pairs;
}

template <int Dim>
solid::ContactField of_whole(const solid::ContactField& field, const GatheredCells<Dim>& gathered) {
    return {.pressure = gathered.boundary(field.pressure),
            .gap = gathered.boundary(field.gap),
            .friction = gathered.boundary(field.friction),
            .slip = gathered.boundary(field.slip),
            .sliding = gathered.boundary(field.sliding)};
}

template <int Dim>
void set_cells(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid, const GatheredCells<Dim>& gathered,
               Sight<Dim>& sight) {
    const solid::CellView<Dim> cells = solid.cells();
    const auto brought = [&](const std::vector<Vector<Dim>>& of_part) {
        return gathered.template cells<Vector<Dim>>([&](std::int32_t c) { return of_part[static_cast<std::size_t>(c)]; });
    };
    sight.displacement = brought(cells.displacement(run.q));
    sight.velocity = brought(cell_velocity(run, solid));
    sight.displacement_gradient =
        gathered.template cells<Matrix<Dim>>([&](std::int32_t c) { return cells.displacement_gradient(c, run.q); });
    sight.stress = gathered.template cells<Matrix<Dim>>([&](std::int32_t c) { return cells.stress(c); });
    sight.out_of_plane_stress =
        gathered.template cells<double>([&](std::int32_t c) { return cells.out_of_plane_stress(c); });
    if (solid.ccg().any_inelastic())
        sight.plastic_strain = gathered.template cells<double>([&](std::int32_t c) { return cells.plastic_strain(c); });
    if (!solid.bonds().may_break()) return;
    const std::vector<double> fragment = fragment_of_cells(solid);
    sight.fragment = gathered.template cells<double>([&](std::int32_t c) { return fragment[static_cast<std::size_t>(c)]; });
}

/// Leaves stresses and gradients of cells behind that are not those of the whole state.
template <int Dim>
void set_contact(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid, const GatheredCells<Dim>& gathered,
                 Sight<Dim>& sight) {
    const solid::ContactState<Dim> contact = solid.contact_at(run.q);
    sight.contact = of_whole(contact.field(), gathered);
    sight.pairs = with_whole_faces(contact.acting_pairs(), gathered);
    sight.bond = gathered.boundary(left_of_bonds(solid));
}

}  // namespace

template <int Dim>
std::vector<Vector<Dim>> Sight<Dim>::vertex_displacement() const {
    std::vector<Vector<Dim>> result(mesh->vertices.size(), Vector<Dim>::Zero());
    std::vector<int> n_cells(mesh->vertices.size(), 0);
    for (std::size_t c = 0; c < displacement_gradient.size(); ++c)
        for (const std::int32_t vertex : mesh->cell_vertices[static_cast<std::int32_t>(c)]) {
            const auto v = static_cast<std::size_t>(vertex);
            result[v] += displacement[c] + displacement_gradient[c] * (mesh->vertices[v] - mesh->cell_centroid[c]);
            ++n_cells[v];
        }
    for (std::size_t v = 0; v < result.size(); ++v) result[v] /= std::max(1, n_cells[v]);
    return result;
}

template <int Dim>
Sight<Dim> sight_of(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid, const mesh::Mesh<Dim>& whole,
                    Evaluated evaluated) {
    Sight<Dim> sight;
    sight.moment = {.steps = run.steps, .time = run.time, .impulses = solid.contact().impulses()};
    sight.mesh = &whole;
    sight.options = &solid.options();
    sight.any_turns = solid.moment_arms() == dynamics::MomentArms::mid_step;
    const GatheredCells<Dim> gathered(solid, whole);
    if (evaluated != Evaluated::no) set_cells(run, solid, gathered, sight);
    if (evaluated == Evaluated::cells_alone) return sight;
    set_contact(run, solid, gathered, sight);
    if (evaluated == Evaluated::yes) return sight;
    static_cast<void>(solid.potential(run.q));  // leaves the stresses of this state behind
    set_cells(run, solid, gathered, sight);
    return sight;
}

template <int Dim>
Sight<Dim> sight_of(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    return sight_of(run, solid, solid.mesh());
}

#define ABUT_INSTANTIATE(Dim)                                                                                    \
    template struct Sight<Dim>;                                                                                  \
    template Sight<Dim> sight_of<Dim>(const dynamics::RunView<Dim>&, solid::Solid<Dim>&, const mesh::Mesh<Dim>&, \
                                      Evaluated);                                                                \
    template Sight<Dim> sight_of<Dim>(const dynamics::RunView<Dim>&, solid::Solid<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
