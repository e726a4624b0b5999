// A run goes on with another mesh, between two of its steps: of the same cells.
#include <catch2/catch.hpp>
#include <random>

#include "abut/solid/bond_view.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/changing_run.hpp"

namespace abut::test {
namespace {

/// With other numbers for all cells, vertices and faces.
template <int Dim>
NewMesh<Dim> renumbered(const mesh::Mesh<Dim>& mesh) {
    std::mt19937 random(5);
    std::vector<std::int32_t> cells = in_order(mesh.cell_measure.size()), vertices = in_order(mesh.vertices.size());
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
        const auto of_body = std::ranges::equal_range(mesh.cell_body, body);
        const auto begin = cells.begin() + (of_body.begin() - mesh.cell_body.begin());
        std::shuffle(begin, begin + std::ssize(of_body), random);
    }
    std::shuffle(vertices.begin(), vertices.end(), random);
    return {rebuilt<Dim>(mesh, cells, vertices, mesh.vertices), cells};
}

/// In space of tetrahedra, whose faces stay planar.
template <int Dim>
mesh::Mesh<Dim> stacked_simplices() {
    if constexpr (Dim == 2) {
        return stacked<2>();
    } else {
        return together(
            mesh::structured_box<3>({-1.0, -1.0, 0.0}, {1.0, 1.0, 0.6}, {4, 3, 2}, CellShape::tetrahedron, "lower"),
            mesh::structured_box<3>({-0.5, -0.4, 0.61}, {0.3, 0.7, 1.2}, {3, 3, 2}, CellShape::tetrahedron, "upper"));
    }
}

template <int Dim>
constexpr int n_steps = Dim == 2 ? 200 : 100;

template <int Dim>
void check_same_bits(ChangingRun<Dim>& run, ChangingRun<Dim>& other) {
    CHECK(std::ranges::equal(run.memm().q(), other.memm().q()));
    CHECK(std::ranges::equal(run.memm().p_before(), other.memm().p_before()));
    CHECK(std::ranges::equal(run.memm().p_after(), other.memm().p_after()));
    CHECK(run.balance() == other.balance());
    CHECK(run.solid().work() == other.solid().work());
    CHECK(run.solid().evaluations() == other.solid().evaluations());
    CHECK(run.solid().contact().report().events == other.solid().contact().report().events);
    CHECK(run.solid().bonds().broken_share() == other.solid().bonds().broken_share());
    const auto of_run = run.solid().outside_work(run.memm().q()), of_other = other.solid().outside_work(other.memm().q());
    CHECK(of_run.steps == of_other.steps);
    CHECK(std::ranges::equal(run.solid().contact().impulses(), other.solid().contact().impulses(), {},
                             &solid::BodyImpulse<Dim>::impulse, &solid::BodyImpulse<Dim>::impulse));
}

/// Of displacements and velocities by the old numbers of cells, over the largest of each.
template <int Dim>
std::array<double, 2> differences(const ChangingRun<Dim>& run, const ChangingRun<Dim>& other,
                                  const std::vector<std::int32_t>& old_cells) {
    const auto of = [&](const std::vector<Vector<Dim>>& values, const std::vector<Vector<Dim>>& of_renumbered) {
        double largest = 0.0, worst = 0.0;
        for (std::size_t c = 0; c < old_cells.size(); ++c) {
            raise(largest, values[old_cells[c]].norm());
            raise(worst, (values[old_cells[c]] - of_renumbered[c]).norm());
        }
        return worst / largest;
    };
    return {of(run.solid().cells().displacement(run.memm().q()), other.solid().cells().displacement(other.memm().q())),
            of(run.solid().cells().velocity(run.memm().p_after()), other.solid().cells().velocity(other.memm().p_after()))};
}

/// Rounding grows to as much in a run whose numbers are others before its first step, when there is nothing to be
/// remembered.
template <int Dim>
void check_renumbering(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, const std::vector<Motion<Dim>>& motion,
                       int steps) {
    const NewMesh<Dim> other = renumbered(mesh);
    ChangingRun<Dim> whole(mesh, options, motion), from_start(mesh, options, motion), changed(mesh, options, motion);
    whole.run(steps);
    from_start.change(other);
    from_start.run(steps);
    changed.run(steps / 2);
    const double before = changed.balance();
    const solid::Left<Dim> left = changed.change(other);
    CHECK(left.cells == 0);
    CHECK(std::abs(left.mass) < 1e-13);
    CHECK(std::abs(changed.balance() - before) < 1e-14);
    changed.run(steps);
    CHECK((changed.pairs() > 0 || !options.bonds.empty()));
    const auto expected = differences(whole, from_start, other.old_cells),
               found = differences(whole, changed, other.old_cells);
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(expected[i] < 1e-5);
        CHECK(found[i] <= 10.0 * expected[i]);
    }
    const auto rounding = Approx(0.0).margin(100.0 * expected[1]);
    CHECK(changed.solid().work() - whole.solid().work() == rounding);
    CHECK(changed.solid().dissipated().total() - whole.solid().dissipated().total() == rounding);
    for (std::size_t c = 0; c < other.old_cells.size(); ++c)
        CHECK(changed.solid().cells().plastic_strain(static_cast<std::int32_t>(c)) -
                  whole.solid().cells().plastic_strain(other.old_cells[c]) ==
              rounding);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a run that is handed over to a solid of the same mesh has the same bits", "[solid][change]",
                       ((int Dim), Dim), 2, 3) {
    for (const NamedOptions<Dim>& one : all_that_remembers<Dim>()) {
        const SolidOptions<Dim>& options = one.options;
        CAPTURE(one.name);
        const std::vector<Motion<Dim>> motion = thrown<Dim>();
        ChangingRun<Dim> whole(stacked<Dim>(), options, motion), changed(stacked<Dim>(), options, motion);
        whole.run(n_steps<Dim>);
        for (const int part : {5, 2}) {
            changed.run(n_steps<Dim> / part);
            changed.change(same_mesh(changed.mesh()));
        }
        changed.run(n_steps<Dim>);
        CHECK(changed.pairs() > 0);
        check_same_bits(whole, changed);
    }
    const auto rubs = rubbing<Dim>(solid::ContactLaw::pair_potential);
    const solid::RunRemedies remedies{.filter = true, .restart = 7};
    ChangingRun<Dim> cleared(stacked<Dim>(), rubs, thrown<Dim>(), remedies);
    ChangingRun<Dim> handed_over(stacked<Dim>(), rubs, thrown<Dim>(), remedies);
    cleared.run(n_steps<Dim>);
    handed_over.run(n_steps<Dim> / 2);
    handed_over.change(same_mesh(handed_over.mesh()));
    handed_over.run(n_steps<Dim>);
    check_same_bits(cleared, handed_over);
    CHECK(handed_over.restarts().restarts == n_steps<Dim> / 7);
    CHECK(handed_over.restarts().paid == cleared.restarts().paid);

    const Bonded<Dim> bonded;
    ChangingRun<Dim> whole(bonded.mesh, bonded.options, bonded.motion), changed(bonded.mesh, bonded.options, bonded.motion);
    whole.run(200);
    changed.run(100);
    changed.change(same_mesh(changed.mesh()));
    changed.run(200);
    CHECK(whole.solid().dissipated().in_bonds > 0.0);
    check_same_bits(whole, changed);
}

TEMPLATE_TEST_CASE_SIG("a run whose cells, points and faces get other numbers ends with the same result", "[solid][change]",
                       ((int Dim), Dim), 2, 3) {
    for (const NamedOptions<Dim>& one : all_that_remembers<Dim>()) {
        const SolidOptions<Dim>& options = one.options;
        CAPTURE(one.name);
        if (!options.boundary.traction.empty() && options.boundary.traction[0].from_outside) continue;  // by face of a group
        check_renumbering<Dim>(without_ties(stacked_simplices<Dim>()), options, thrown<Dim>(), n_steps<Dim>);
    }
    const Bonded<Dim> bonded;
    check_renumbering<Dim>(without_ties(bonded.mesh), bonded.options, bonded.motion, 200);
}

}  // namespace abut::test
