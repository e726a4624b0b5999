// A run goes on without some of its cells.
#include <catch2/catch.hpp>

#include "abut/solid/bond_view.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/outside_view.hpp"
#include "solid/changing_run.hpp"

namespace abut::test {
namespace {

/// Two bodies that fly at each other, the upper one aside and with a spin; nothing is outside.
struct Collision {
    std::string name;
    Kinematics kinematics;  // of the upper body
    solid::ContactLaw law = solid::ContactLaw::pair_potential;
    double friction = 0.0;
    Kinematics below = kinematics;

    template <int Dim>
    [[nodiscard]] SolidOptions<Dim> options() const {
        SolidOptions<Dim> options = bodies<Dim>(2);
        options.kinematics = {below, kinematics};
        options.law = law;
        options.friction.coefficient = friction;
        return options;
    }
};

/// The cell that reaches down farthest of those of the upper body, in its middle.
template <int Dim>
std::int32_t lowest_cell(const mesh::Mesh<Dim>& mesh) {
    const auto height = [&](std::int32_t c) {
        return mesh.cell_centroid[c][Dim - 1] + 0.1 * (mesh.cell_centroid[c] - mesh.cell_centroid.back()).norm();
    };
    std::int32_t lowest = mesh.n_cells() - 1;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (mesh.cell_body[c] == 1 && height(c) < height(lowest)) lowest = c;
    return lowest;
}

/// One that has no free face.
template <int Dim>
std::int32_t inner_cell(const mesh::Mesh<Dim>& mesh) {
    for (std::int32_t c = mesh.n_cells() - 1; c > 0; --c)
        if (std::ranges::none_of(mesh.cell_faces[c], [&](std::int32_t f) { return mesh.is_boundary(f); })) return c;
    FAIL("all cells have free faces");
    return -1;
}

template <int Dim>
Vector<Dim> momentum_of_run(const ChangingRun<Dim>& run) {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (std::size_t i = 0; i < run.solid().masses().size(); ++i)
        sum += dynamics::RunView<Dim>(run.memm()).momentum(static_cast<std::ptrdiff_t>(i));
    return sum;
}

/// What is left keeps what it has, from the change on: where bodies may turn the angular momentum, too.
template <int Dim>
void check_conservation(ChangingRun<Dim>& run, std::int64_t until) {
    const bool turns = run.solid().moment_arms() == dynamics::MomentArms::mid_step;
    const double energy = run.balance(), scale = std::max(std::abs(energy), run.memm().staggered_kinetic_energy());
    const Vector<Dim> momentum = momentum_of_run(run);
    const auto moment_now = [&] {
        return dynamics::pseudo_angular_momentum<Dim>({run.memm()}, run.memm().dt(), run.solid().rest_positions(),
                                                      run.solid().masses());
    };
    const AxialVector<Dim> moment = moment_now();
    while (run.memm().steps() < until) {
        run.run(run.memm().steps() + 1);
        REQUIRE(std::abs(run.balance() - energy) <= 1e-12 * scale);
        REQUIRE((momentum_of_run(run) - momentum).norm() <= 1e-13);
        if (turns) REQUIRE((moment_now() - moment).norm() <= 1e-13);
    }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("what leaves with a cell in contact is told, and what is left keeps mass, momentum and H~",
                       "[solid][change]", ((int Dim), Dim), 2, 3) {
    constexpr auto by_faces = solid::ContactLaw::reconstruction, by_nodes = solid::ContactLaw::pair_potential;
    const Collision collision =
        GENERATE_COPY(Collision{"small", Kinematics::small}, Collision{"floating", Kinematics::floating},
                      Collision{"finite", Kinematics::finite}, Collision{"by faces", Kinematics::small, by_faces},
                      Collision{"friction by faces", Kinematics::small, by_faces, 0.3},
                      Collision{"friction by nodes", Kinematics::floating, by_nodes, 0.3},
                      Collision{"on a rigid body", Kinematics::finite, by_nodes, 0.0, Kinematics::rigid});
    const bool at_contact = GENERATE(true, false);
    CAPTURE(collision.name, at_contact);
    ChangingRun<Dim> run(stacked<Dim>(), collision.options<Dim>(), thrown<Dim>());
    while (run.pairs() == 0 && run.memm().steps() < 300) run.run(run.memm().steps() + 5);
    REQUIRE(run.solid().contact_counts().active_pairs > 0);
    const std::int32_t cell = at_contact ? lowest_cell(run.mesh()) : inner_cell(run.mesh());
    const double mass = run.mesh().cell_measure[cell];  // the density is 1
    const Vector<Dim> before = run.solid().cells().velocity(run.memm().p_before())[cell];
    const Vector<Dim> after = run.solid().cells().velocity(run.memm().p_after())[cell];
    const double energy = run.balance();
    const Vector<Dim> momentum = momentum_of_run(run);

    const solid::Left<Dim> left = run.change(mesh_without(run.mesh(), {cell}));
    CHECK(left.cells == 1);
    CHECK(left.mass == Approx(mass).epsilon(1e-12));
    CHECK((left.momentum - 0.5 * mass * (before + after)).norm() <= 1e-14);
    if (collision.kinematics != Kinematics::floating)  // whose points are beside the centroids of their cells
        CHECK(left.kinetic == Approx(0.5 * mass * before.dot(after)).epsilon(1e-9));
    CHECK((momentum - momentum_of_run(run) - left.momentum).norm() <= 1e-14);
    CHECK(std::abs(energy - run.balance() - left.energy()) <= 1e-14);
    CHECK(run.solid().mesh().n_cells() == stacked<Dim>().n_cells() - 1);
    CHECK(dynamics::measure(run.memm(), run.solid()).parasitic < 0.2 * thrown<Dim>()[1].velocity.norm());
    check_conservation(run, run.memm().steps() + 200);
    CHECK(run.pairs() > 0);
    CHECK(run.solid().contact().report().missed_contacts == 0);
    CHECK((run.solid().contact().report().friction_dissipated > 0.0) == (collision.friction > 0.0));
}

TEST_CASE("a body falls on the cells behind one that has left", "[solid][change]") {
    // A column above the middle one of five columns, a little narrower: it enters the gap, whose bottom is a row of cells below.
    const mesh::Mesh<2> mesh =
        together(mesh::structured_box<2>({-2.5, -2.0}, {2.5, 0.0}, {5, 2}, CellShape::quadrangle, "lower"),
                 mesh::structured_box<2>({-0.4, 0.1}, {0.4, 1.1}, {2, 2}, CellShape::quadrangle, "upper"));
    SolidOptions<2> options = bodies<2>(2);
    options.law = solid::ContactLaw::pair_potential;
    const auto fall = [&](bool with_gap) {
        ChangingRun<2> run(mesh, options, std::vector<Motion<2>>{Motion<2>(), moving<2>({0.0, -0.1})});
        run.run(5);
        std::int32_t middle = 0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            if ((mesh.cell_centroid[c] - Vector<2>(0.0, -0.5)).norm() < 1e-9) middle = c;
        if (with_gap) run.change(mesh_without(run.mesh(), {middle}));
        double lowest = 0.0;
        while (run.memm().time() < 25.0) {
            run.run(run.memm().steps() + 1);
            double depth = 0.0;
            const auto u = run.solid().cells().displacement(run.memm().q());
            for (std::int32_t c = 0; c < run.mesh().n_cells(); ++c)
                if (run.mesh().cell_body[c] == 1) raise(depth, -u[c].y());
            raise(lowest, depth);
        }
        return lowest;
    };
    CHECK(fall(true) - fall(false) == Approx(1.0).margin(0.02));  // the height of the cell
}

TEST_CASE("cells that are left remember how they have flowed, bonds how they have opened, faces what a program has set",
          "[solid][change]") {
    ChangingRun<2> metal(stacked<2>(), of_metal<2>(Kinematics::small), thrown<2>());
    metal.run(150);
    std::vector<double> strain;
    for (std::int32_t c = 0; c < metal.mesh().n_cells(); ++c) strain.push_back(metal.solid().cells().plastic_strain(c));
    REQUIRE(*std::ranges::max_element(strain) > 0.0);
    const NewMesh<2> left = mesh_without(metal.mesh(), {lowest_cell(metal.mesh()), 3});
    metal.change(left);
    for (std::size_t c = 0; c < left.old_cells.size(); ++c)
        REQUIRE(metal.solid().cells().plastic_strain(static_cast<std::int32_t>(c)) == strain[left.old_cells[c]]);

    const Bonded<2> bonded;
    ChangingRun<2> bonds(bonded.mesh, bonded.options, bonded.motion);
    bonds.run(100);
    std::vector<double> shares;
    for (std::size_t p = 0; p < bonds.solid().bonds().places().size(); ++p) shares.push_back(bonds.solid().bonds().share(p));
    REQUIRE(*std::ranges::min_element(shares) < 1.0);
    // A cell of the left block that is bonded, whose places come first in each row of places.
    const auto& place = bonds.solid().bonds().places().front();
    const std::int32_t cell = solid::cell_of(bonds.mesh(), place.faces[0]);
    const auto is_of_cell = [&](const auto& of) { return solid::cell_of(bonds.mesh(), of.faces[0]) == cell; };
    std::vector<double> kept;
    for (std::size_t p = 0; p < shares.size(); ++p)
        if (!is_of_cell(bonds.solid().bonds().places()[p])) kept.push_back(shares[p]);
    REQUIRE(kept.size() < shares.size());
    bonds.change(mesh_without(bonds.mesh(), {cell}));
    REQUIRE(bonds.solid().bonds().places().size() == kept.size());
    for (std::size_t p = 0; p < kept.size(); ++p) CHECK(bonds.solid().bonds().share(p) == kept[p]);

    ChangingRun<2> loaded(stacked<2>(), pushed<2>({Kinematics::small, Kinematics::small}), thrown<2>());
    loaded.run(10);
    const std::vector<std::int32_t> faces = loaded.mesh().group(top<2>()).faces;
    std::vector<Vector<2>> tractions(loaded.solid().outside(top<2>()).traction().begin(),
                                     loaded.solid().outside(top<2>()).traction().end());
    REQUIRE(tractions[1] != tractions[2]);
    loaded.change(mesh_without(loaded.mesh(), {loaded.mesh().face_cells[faces[1]][0]}));
    tractions.erase(tractions.begin() + 1);
    CHECK(std::ranges::equal(loaded.solid().outside(top<2>()).traction(), tractions));
}

TEMPLATE_TEST_CASE_SIG("metal that flows keeps H~ + D as its cells leave one after the other", "[solid][change]",
                       ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    CAPTURE(static_cast<int>(kinematics));
    ChangingRun<Dim> run(stacked<Dim>(), of_metal<Dim>(kinematics), thrown<Dim>());
    const double energy = run.balance();
    double left = 0.0;
    for (int i = 0; i < 8; ++i) {
        run.run(run.memm().steps() + 12);
        CHECK(std::abs(run.balance() + left - energy) < 1e-15);
        left += run.change(mesh_without(run.mesh(), {(37 * i + 5) % run.mesh().n_cells()})).energy();
    }
    CHECK(run.solid().dissipated().in_cells > 0.1 * energy);
    if (kinematics != Kinematics::finite) CHECK(run.solid().dissipated().in_jumps > 0.0);
}

TEST_CASE("a change of the mesh that is not made is refused by name", "[solid][change][errors]") {
    const mesh::Mesh<2> mesh = stacked<2>();
    const auto refused = [&](NewMesh<2> next, const SolidOptions<2>& before, const SolidOptions<2>& after,
                             bool local_steps = false) {
        Solid<2> solid(mesh, before), other(next.mesh, after);
        if (local_steps) solid.set_levels(1, std::vector<std::int32_t>(solid.size(), 0));
        const dynamics::Memm memm(solid, std::vector<double>(solid.size(), 0.0), momentum_of(solid, thrown<2>()), 0.01);
        try {
            static_cast<void>(solid::change(solid, memm.state(), other, next.old_cells));
        } catch (const BadInput& error) {
            return std::string(error.what());
        }
        return std::string("not refused");
    };
    const auto with = [&](const SolidOptions<2>& options, NewMesh<2> next) {
        return refused(std::move(next), options, options);
    };
    const SolidOptions<2> small = falling<2>({Kinematics::small, Kinematics::small});
    NewMesh<2> next = same_mesh(mesh);
    CHECK(with(small, next) == "not refused");
    next.old_cells.front() = -1;
    CHECK_THAT(with(small, next), Catch::Contains("New cells are not made"));
    next.old_cells.front() = 1;
    CHECK_THAT(with(small, next), Catch::Contains("Give each number once"));
    next = same_mesh(mesh);
    std::swap(next.old_cells.front(), next.old_cells[1]);
    CHECK_THAT(with(small, next), Catch::Contains("corners are elsewhere"));
    next = same_mesh(mesh);
    std::swap(next.old_cells.front(), next.old_cells.back());
    CHECK_THAT(with(small, next), Catch::Contains("Cells stay in their bodies"));
    next = same_mesh(mesh);
    next.old_cells.pop_back();
    CHECK_THAT(with(small, next), Catch::Contains("Give one per cell"));
    next = same_mesh(mesh);
    next.mesh.body_names[1] = "other";
    CHECK_THAT(with(small, next), Catch::Contains("pieces of a body stay one body"));

    CHECK_THAT(with(falling<2>({Kinematics::rigid, Kinematics::small}), mesh_without(mesh, {0})),
               Catch::Contains("'lower' is rigid and has lost 1 cells"));
    CHECK_THAT(refused(same_mesh(mesh), small, falling<2>({Kinematics::small, Kinematics::floating})),
               Catch::Contains("'upper' is of other kinematics"));
    SolidOptions<2> by_nodes = small, metal = of_metal<2>(Kinematics::small), elastic = metal, without_wall = by_nodes;
    by_nodes.law = solid::ContactLaw::pair_potential;
    CHECK_THAT(refused(same_mesh(mesh), small, by_nodes), Catch::Contains("Keep the law of contact"));
    elastic.materials = small.materials;
    CHECK_THAT(refused(same_mesh(mesh), metal, elastic), Catch::Contains("remembers other things"));
    without_wall.obstacles.clear();
    CHECK_THAT(refused(same_mesh(mesh), small, without_wall), Catch::Contains("other obstacles"));
    CHECK_THAT(refused(same_mesh(mesh), small, tied<2>({Kinematics::small, Kinematics::small})), Catch::Contains("springs"));
    CHECK_THAT(refused(same_mesh(mesh), small, small, true), Catch::Contains("local steps (memm_async)"));
    SolidOptions<2> rough = small;
    rough.friction.coefficient = 0.3;
    CHECK_THAT(refused(same_mesh(mesh), small, rough), Catch::Contains("same laws of friction"));
}

}  // namespace abut::test
