#include <catch2/catch.hpp>

#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Constraint;
using solid::FreeFaceRule;

namespace {

const solid::Material material{.young = 2.0, .poisson = 0.3, .density = 1.5};

template <int Dim>
solid::DirichletCondition<Dim> roller(const std::string& group, bool by_components) {
    solid::DirichletCondition<Dim> condition;
    condition.group = group;
    condition.constraint = by_components ? Constraint::components : Constraint::normal;
    if (by_components) condition.components[static_cast<std::size_t>(group[0] - 'x')] = true;
    return condition;
}

template <int Dim>
solid::SolidOptions<Dim> one_body() {
    solid::SolidOptions<Dim> options;
    options.materials = {material};
    return options;
}

/// Runs and returns the largest |H~ - H~0 - work| over the largest energy of the run.
template <int Dim>
double relative_drift(Scene<Dim>& scene, int steps) {
    scene.run(steps);
    return scene.ledger.pseudo_energy_drift() / scene.ledger.largest_energy();
}

/// A block that is pushed and dragged over another one, with a load on its side that changes from step to step.
template <int Dim>
struct DrivenBlocks {
    mesh::Mesh<Dim> mesh;
    solid::SolidOptions<Dim> options = reconstructed_bodies<Dim>(2);

    DrivenBlocks() : mesh(blocks()) {
        solid::DirichletCondition<Dim> fixed, driven;
        const std::string axis = Dim == 2 ? "y" : "z";
        fixed.group = "lower." + axis + "min";
        driven.group = "upper." + axis + "max";
        driven.history = [](double t, const Vector<Dim>&) {
            Vector<Dim> u = Vector<Dim>::Zero();
            u[0] = 0.05 * std::sin(2.0 * t);
            u[Dim - 1] = -0.02 * (1.0 - std::cos(3.0 * t));
            return u;
        };
        options.boundary.dirichlet = {fixed, driven};
        solid::TractionCondition<Dim> side;
        side.group = "upper.xmax";
        side.history = [](double t, const Vector<Dim>&) {
            return Vector<Dim>(0.002 * std::cos(7.0 * t) * Vector<Dim>::Unit(0));
        };
        options.boundary.traction = {side};
    }

private:
    static mesh::Mesh<Dim> blocks() {
        Vector<Dim> upper = Vector<Dim>::Ones();
        upper[Dim - 1] = 0.5;
        Vector<Dim> other_lower = Vector<Dim>::Constant(0.1), other_upper = Vector<Dim>::Constant(0.83);
        other_lower[Dim - 1] = 0.505;
        other_upper[Dim - 1] = 1.0;
        return together(
            mesh::box<Dim>({.lower = Vector<Dim>::Zero(), .upper = upper, .size = Dim == 2 ? 0.2 : 0.35, .name = "lower"}),
            mesh::box<Dim>({.lower = other_lower, .upper = other_upper, .size = Dim == 2 ? 0.15 : 0.3, .name = "upper"}));
    }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("a block on rollers under a uniform traction is in equilibrium in the exact affine field",
                       "[solid][boundary]", ((int Dim), Dim), 2, 3) {
    const bool by_components = GENERATE(false, true);
    const FreeFaceRule neumann = GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate);
    const double traction = 0.01;
    const double young = material.young, nu = material.poisson;
    // Plane strain in 2D.
    const double along = Dim == 2 ? (1.0 - nu * nu) * traction / young : traction / young;
    const double across = Dim == 2 ? -nu * (1.0 + nu) * traction / young : -nu * traction / young;
    for (const auto& [name, mesh] : boxes<Dim>()) {
        INFO(name);
        auto options = one_body<Dim>();
        options.boundary.free_face_rule = neumann;
        for (const char* side : {"xmin", "ymin", "zmin"})
            if (Dim == 3 || side[0] != 'z') options.boundary.dirichlet.push_back(roller<Dim>(side, by_components));
        options.boundary.traction.push_back({.group = "xmax", .value = traction * Vector<Dim>::Unit(0), .history = {}});
        solid::Solid<Dim> solid(mesh, options);
        const auto exact = sampled(mesh, [&](const Vector<Dim>& x) {
            Vector<Dim> u = across * (x + Vector<Dim>::Constant(0.3));  // the lower corner of the boxes is at -0.3
            u[0] = along * (x[0] + 0.3);
            return u;
        });
        std::vector<double> force(solid.size());
        solid.force(exact, force);
        CHECK(largest(force) < 1e-12 * traction);

        // The exact energy: 1/2 sigma eps |c| less the work of the traction, twice that.
        double volume = 0.0;
        for (const double measure : mesh.cell_measure) volume += measure;
        CHECK(solid.potential(exact) == Approx(-0.5 * traction * along * volume).epsilon(1e-12));
    }
}

TEMPLATE_TEST_CASE_SIG("a prescribed displacement, whole or by component, is what the face gets", "[solid][boundary]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = mesh::box<Dim>({.size = 0.4});
    auto options = one_body<Dim>();
    const Vector<Dim> value = 0.1 * Vector<Dim>::Ones();
    options.boundary.dirichlet.push_back(
        {.group = "xmin", .constraint = Constraint::full, .components = {}, .value = value, .history = {}});
    auto slide = roller<Dim>("ymax", GENERATE(false, true));
    slide.value = value;
    options.boundary.dirichlet.push_back(slide);
    solid::Solid<Dim> solid(mesh, options);
    auto& ccg = solid.ccg();
    const auto q = random_state(solid.size(), 4);
    std::vector<Vector<Dim>> displacement(mesh.boundary_faces.size());
    ccg.boundary_displacement(vectors<Dim>(q), ccg.load_at(0.0, 0.0), displacement);
    for (std::size_t b = 0; b < displacement.size(); ++b) {
        const Vector<Dim>& normal = mesh.face_normal[mesh.boundary_faces[b]];
        if (normal[0] < -0.99) CHECK((displacement[b] - value).norm() < 1e-14);
        if (normal[1] > 0.99) CHECK(std::abs(displacement[b][1] - 0.1) < 1e-13);
    }
}

TEMPLATE_TEST_CASE_SIG("a body force is the mass times the acceleration, or the volume times the load at the centroid",
                       "[solid][boundary]", ((int Dim), Dim), 2, 3) {
    const auto mesh = mesh::box<Dim>({.size = 0.4});
    auto options = one_body<Dim>();
    solid::Solid<Dim> bare(mesh, options);
    const auto load = [](const Vector<Dim>& x) { return x.cwiseProduct(x); };
    const Vector<Dim> acceleration = -9.81 * Vector<Dim>::Unit(Dim - 1);
    options.acceleration = {acceleration};
    options.body_load = load;
    solid::Solid<Dim> solid(mesh, options);
    const auto q = random_state(solid.size(), 5);
    std::vector<double> force(q.size()), bare_force(q.size());
    solid.force(q, force);
    bare.force(q, bare_force);
    double worst = 0.0, work = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const Vector<Dim> expected =
            material.density * mesh.cell_measure[c] * acceleration + mesh.cell_measure[c] * load(mesh.cell_centroid[c]);
        raise(worst, (vectors<Dim>(force)[c] - vectors<Dim>(bare_force)[c] - expected).norm());
        work += expected.dot(vectors<Dim>(q)[c]);
    }
    CHECK(worst < 1e-14 * largest(force));
    CHECK(solid.potential(q) == Approx(bare.potential(q) - work).epsilon(1e-13));
}

TEMPLATE_TEST_CASE_SIG("a body in free fall moves as one with the acceleration, without stress", "[solid][boundary]",
                       ((int Dim), Dim), 2, 3) {
    auto options = one_body<Dim>();
    options.acceleration = {-2.0 * Vector<Dim>::Unit(Dim - 1)};
    const double dt = 0.01;
    Scene<Dim> scene(mesh::box<Dim>({.size = 0.4}), options, {Vector<Dim>::Zero()}, dt);
    scene.run(50);
    double worst = 0.0;
    for (const Vector<Dim>& u : as_vectors<Dim>(scene.memm.q())) raise(worst, std::abs(u[Dim - 1] + 0.5 * 2.0 * 0.25));
    CHECK(worst < 1e-13);  // parabolas are exact
    CHECK(scene.ledger.pseudo_energy_drift() < 1e-13);
}

TEMPLATE_TEST_CASE_SIG("H~ gains the work of a driven boundary exactly", "[solid][boundary]", ((int Dim), Dim), 2, 3) {
    auto options = one_body<Dim>();
    options.boundary.free_face_rule =
        GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate, FreeFaceRule::adjacent);
    solid::DirichletCondition<Dim> driven;
    driven.group = "xmin";
    SECTION("all components") {}
    SECTION("the normal alone") { driven.constraint = Constraint::normal; }
    SECTION("one tangential component") {
        driven.constraint = Constraint::components;
        driven.components[1] = true;
    }
    driven.history = [](double t, const Vector<Dim>& x) {
        return Vector<Dim>(0.02 * std::sin(4.0 * t + x[1]) * Vector<Dim>::Ones());
    };
    options.boundary.dirichlet = {driven, roller<Dim>("ymin", false)};
    if (driven.constraint == Constraint::components) options.boundary.dirichlet.pop_back();
    options.boundary.traction.push_back({.group = "xmax", .value = 0.003 * Vector<Dim>::Ones(), .history = {}});
    Scene<Dim> scene(mesh::box<Dim>({.size = Dim == 2 ? 0.2 : 0.4}), options, {Vector<Dim>::Zero()});
    CHECK(relative_drift(scene, 400) < 1e-12);
    CHECK(std::abs(scene.solid.work()) > 1e-2 * scene.ledger.largest_energy());
}

TEMPLATE_TEST_CASE_SIG("H~ gains the work of a traction that changes from step to step exactly", "[solid][boundary]",
                       ((int Dim), Dim), 2, 3) {
    auto options = one_body<Dim>();
    options.boundary.free_face_rule =
        GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate, FreeFaceRule::adjacent);
    solid::TractionCondition<Dim> pulse;
    pulse.group = "xmax";
    pulse.history = [](double t, const Vector<Dim>& x) {
        return Vector<Dim>(0.01 * std::sin(5.0 * t) * (1.0 + x[1]) * Vector<Dim>::Ones());
    };
    options.boundary.traction = {pulse};
    options.boundary.dirichlet.push_back(roller<Dim>("xmin", false));
    Scene<Dim> scene(mesh::box<Dim>({.size = Dim == 2 ? 0.2 : 0.4}), options, {Vector<Dim>::Zero()});
    CHECK(relative_drift(scene, 400) < 1e-12);
    CHECK(std::abs(scene.solid.work()) > 1e-2 * scene.ledger.largest_energy());
}

TEMPLATE_TEST_CASE_SIG("H~ gains the work of driven boundaries and tractions exactly while bodies are in contact",
                       "[solid][boundary]", ((int Dim), Dim), 2, 3) {
    DrivenBlocks<Dim> blocks;
    blocks.options.boundary.free_face_rule =
        GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate, FreeFaceRule::adjacent);
    Scene<Dim> scene(blocks.mesh, blocks.options, std::vector<Vector<Dim>>(2, Vector<Dim>::Zero()));
    CHECK(relative_drift(scene, 300) < 1e-12);
    CHECK(scene.solid.contact().report().active_pairs_max > 3);
    CHECK(scene.solid.contact().report().events > 10);
}

TEMPLATE_TEST_CASE_SIG(
    "tractions that jump by more than the candidate list allows are searched for, and their work is exact",
    "[solid][boundary]", ((int Dim), Dim), 2, 3) {
    DrivenBlocks<Dim> blocks;
    blocks.options.contact->search.skin = 0.01;
    blocks.options.boundary.traction[0].history = [](double t, const Vector<Dim>&) {
        return Vector<Dim>((std::sin(5.0 * t) > 0.0 ? 0.05 : -0.05) * Vector<Dim>::Unit(0));
    };
    Scene<Dim> scene(blocks.mesh, blocks.options, std::vector<Vector<Dim>>(2, Vector<Dim>::Zero()));
    CHECK(relative_drift(scene, 200) < 1e-12);
    CHECK(scene.solid.contact().report().active_pairs_max > 3);
    CHECK(scene.solid.contact().report().missed_contacts == 0);
}
