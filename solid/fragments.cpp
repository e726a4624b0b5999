#include "abut/solid/fragments.hpp"

#include <algorithm>
#include <cstddef>

#include "abut/base/disjoint_sets.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/group_motions.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

/// Cells of each body, of all ranks (n_bodies).
template <int Dim>
std::vector<std::int64_t> cells_of_bodies(const Solid<Dim>& solid) {
    const mesh::Mesh<Dim>& mesh = solid.mesh();
    std::vector<double> own(mesh.body_names.size(), 0.0);
    for (const std::int32_t cell : solid.cells().own().position)
        ++own[static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(cell)])];
    const std::vector<double> of_ranks = solid.ranks().gather(own);
    std::vector<std::int64_t> n_cells(own.size(), 0);
    for (std::size_t i = 0; i < of_ranks.size(); ++i) n_cells[i % own.size()] += static_cast<std::int64_t>(of_ranks[i]);
    return n_cells;
}

}  // namespace

template <int Dim>
std::vector<std::int32_t> fragment_of_bodies(const Solid<Dim>& solid) {
    constexpr std::int32_t none = -1, not_numbered = -2;
    const auto n = static_cast<std::size_t>(solid.mesh().n_bodies());
    std::vector<std::int32_t> fragment(n, none);
    DisjointSets held(n);
    const BondView<Dim> bonds = solid.bonds();
    for (std::size_t p = 0; p < bonds.places().size(); ++p) {
        const auto& bodies = bonds.places()[p].bodies;
        for (const std::int32_t body : bodies) fragment[static_cast<std::size_t>(body)] = not_numbered;
        if (!bonds.is_broken(p)) held.join(bodies[0], bodies[1]);
    }
    std::int32_t n_fragments = 0;
    for (std::size_t body = 0; body < n; ++body) {
        if (fragment[body] == none) continue;
        const auto first = static_cast<std::size_t>(held.find(static_cast<std::int32_t>(body)));
        fragment[body] = first == body ? n_fragments++ : fragment[first];
    }
    return fragment;
}

template <int Dim>
std::vector<Fragment<Dim>> fragments(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid) {
    const std::vector<std::int32_t> of_bodies = fragment_of_bodies(solid);
    const std::int32_t n = *std::ranges::max_element(of_bodies) + 1;
    std::vector<std::int32_t> group = of_bodies;  // bodies without bonds are one more group
    std::ranges::replace(group, -1, n);
    const AllPoints<Dim> points(run, solid);
    const std::vector<std::int64_t> n_cells = cells_of_bodies(solid);
    std::vector<Fragment<Dim>> fragments;
    if (solid.ranks().rank() > 0) return fragments;
    std::vector<GroupMotion<Dim>> motions = group_motions<Dim>(points, group, static_cast<std::size_t>(n) + 1);
    motions.pop_back();
    for (const GroupMotion<Dim>& motion : motions)
        fragments.push_back(
            {.mass = motion.mass, .centre = motion.centre, .velocity = motion.velocity, .spin = motion.spin});
    const auto visit_fragment_of = [&](std::int32_t body, const auto& visit) {
        const std::int32_t fragment = of_bodies[static_cast<std::size_t>(body)];
        if (fragment >= 0) visit(fragments[static_cast<std::size_t>(fragment)]);
    };
    for (std::int32_t body = 0; body < solid.mesh().n_bodies(); ++body)
        visit_fragment_of(body, [&](Fragment<Dim>& fragment) {
            fragment.bodies.push_back(body);
            fragment.n_cells += n_cells[static_cast<std::size_t>(body)];
        });
    return fragments;
}

#define ABUT_INSTANTIATE(Dim)                                                 \
    template std::vector<std::int32_t> fragment_of_bodies(const Solid<Dim>&); \
    template std::vector<Fragment<Dim>> fragments(const dynamics::RunView<Dim>&, const Solid<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
