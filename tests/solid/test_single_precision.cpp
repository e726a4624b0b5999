// Steps in single precision: what they may differ by from those in double, and what is not made for them.
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>

#include "abut/dynamics/leapfrog.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/magnitudes.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::BoundaryFace;
using solid::CellForm;
using solid::FreeFaceRule;
using solid::Precision;

namespace {

const solid::Material material{.young = 2.0, .poisson = 0.2, .density = 1.5};

/// Operators that step in single precision, and in what state.
template <int Dim>
struct Operators {
    const mesh::Mesh<Dim>& mesh;
    solid::Ccg<Dim> ccg;
    Magnitudes<Dim> magnitudes;

    Operators(const mesh::Mesh<Dim>& of, FreeFaceRule rule, CellForm form, solid::BoundaryConditions<Dim> conditions = {})
        : mesh(of),
          ccg(of, std::vector{material}, with(conditions, rule), {}, form, Precision::single_precision),
          magnitudes(of, material, ccg, rule, form) {}

    static solid::BoundaryConditions<Dim> with(solid::BoundaryConditions<Dim> conditions, FreeFaceRule rule) {
        conditions.free_face_rule = rule;
        return conditions;
    }

    /// Of the worst cell: how far the force is off, over the bound.
    double worst(const std::vector<double>& q, const solid::BoundaryLoad<Dim>& load,
                 const solid::FaceCorrections<Dim>& corrections) {
        const auto u = vectors<Dim>(q);
        std::vector<Vector<Dim>> expected(u.size()), single(u.size());
        ccg.gradient(u, load, corrections, expected);
        std::vector<Matrix<Dim>> stress;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) stress.push_back(ccg.stress(c));
        ccg.step_gradient(u, load, corrections, single);
        magnitudes.set(u, load, corrections);
        const std::vector<double> bounds = magnitudes.bounds();
        double ratio = 0.0;
        for (std::size_t c = 0; c < u.size(); ++c) {
            raise(ratio, (single[c] - expected[c]).norm() / bounds[c]);
            const auto cell = static_cast<std::int32_t>(c);
            raise(ratio, (ccg.stress(cell) - stress[c]).norm() / magnitudes.stress_bound(cell));
            raise(largest_force, expected[c].norm());
            raise(largest_bound, bounds[c]);
        }
        return ratio;
    }
    double largest_force = 0.0, largest_bound = 0.0;
};

/// The form that takes a body of these cells: of simplices, or of any cells.
template <int Dim>
CellForm form_of(const mesh::Mesh<Dim>& mesh) {
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (mesh.cell_faces[c].size() != Dim + 1) return CellForm::general;
    return CellForm::automatic;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("forces and stresses in single precision are those in double but for its roundings",
                       "[solid][single_precision]", ((int Dim), Dim), 2, 3) {
    const auto rule = GENERATE(FreeFaceRule::local_equilibrium, FreeFaceRule::extrapolate, FreeFaceRule::adjacent);
    for (const auto& [name, mesh] : boxes<Dim>(4)) {
        INFO(name);
        const auto n = static_cast<std::size_t>(mesh.n_cells());
        Operators<Dim> free(mesh, rule, form_of(mesh));
        CHECK(free.worst(random_state(n * Dim, 3), {}, {}) < 1.0);
        CHECK(free.largest_bound < 0.1 * free.largest_force);
        Operators<Dim> any_cells(mesh, rule, CellForm::general);
        CHECK(any_cells.worst(random_state(n * Dim, 4), {}, {}) < 1.0);

        Operators<Dim> held(mesh, rule, form_of(mesh), held_and_pulled<Dim>());
        std::vector<BoundaryFace> faces;
        for (std::int32_t b = 1; b < held.ccg.n_boundary(); b += 3)
            if (held.ccg.prescribed()[BoundaryFace{b}].isZero(0.0)) faces.push_back(BoundaryFace{b});
        const auto moved = random_vectors<Dim>(faces.size(), 5), pushed = random_vectors<Dim>(faces.size(), 6);
        const std::vector<Matrix<Dim>> moments(faces.size(), Matrix<Dim>(random_state(Dim * Dim, 7).data()));
        const auto load = held.ccg.load_at(0.0, 0.0);
        CHECK(held.worst(random_state(n * Dim, 5), load, {faces, moved, pushed}) < 1.0);
        CHECK(held.worst(random_state(n * Dim, 5), load, {faces, {}, pushed, moments}) < 1.0);
    }
}

TEMPLATE_TEST_CASE_SIG("in single precision, too, a body under the tractions of an affine field is in equilibrium in it",
                       "[solid][single_precision]", ((int Dim), Dim), 2, 3) {
    const auto values = random_state(Dim * Dim, 8, 0.1);
    const Matrix<Dim> a(values.data());
    const Matrix<Dim> strain = 0.5 * (a + a.transpose());
    const Matrix<Dim> stress = material.lambda() * strain.trace() * Matrix<Dim>::Identity() + 2.0 * material.mu() * strain;
    solid::BoundaryConditions<Dim> conditions;
    for (const std::string& side : box_sides(Dim))
        conditions.traction.push_back(
            {.group = side, .value = (side.ends_with("max") ? 1.0 : -1.0) * stress.col(side[0] - 'x')});
    for (const auto& [name, mesh] : boxes<Dim>()) {
        INFO(name);
        Operators<Dim> operators(mesh, FreeFaceRule::local_equilibrium, form_of(mesh), conditions);
        const auto q = sampled(mesh, [&](const Vector<Dim>& x) { return Vector<Dim>(a * x); });
        const auto load = operators.ccg.load_at(0.0, 0.0);
        std::vector<double> force(q.size());
        operators.ccg.step_gradient(vectors<Dim>(q), load, {}, vectors<Dim>(force));
        operators.magnitudes.set(vectors<Dim>(q), load, {});
        const auto bounds = operators.magnitudes.bounds();
        double worst = 0.0;
        for (std::size_t c = 0; c < bounds.size(); ++c) raise(worst, vectors<Dim>(force)[c].norm() / bounds[c]);
        CHECK(worst < 1.0);
    }
}

TEMPLATE_TEST_CASE_SIG("a body that is far away from its place at rest has the forces of its strain alone",
                       "[solid][single_precision]", ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        INFO(name);
        Operators<Dim> operators(mesh, FreeFaceRule::local_equilibrium, form_of(mesh));
        const Vector<Dim> far = Vector<Dim>::Constant(1e3);  // body sizes
        auto q = sampled(mesh, [&](const Vector<Dim>&) { return far; });
        std::vector<double> force(q.size());
        operators.ccg.step_gradient(vectors<Dim>(q), {}, {}, vectors<Dim>(force));
        CHECK(largest(force) == 0.0);
        const auto shape = random_state(q.size(), 9, 1e-3);
        for (std::size_t i = 0; i < q.size(); ++i) q[i] += shape[i];
        CHECK(operators.worst(q, {}, {}) < 1.0);  // the bound is that of differences, and so of the strain
    }
}

TEMPLATE_TEST_CASE_SIG("no unit is too large or too small for single precision", "[solid][single_precision]",
                       ((int Dim), Dim), 2, 3) {
    const double length = GENERATE(1e-25, 1e25), young = GENERATE(1e-30, 1e30), size = GENERATE(1e-12, 1.0);
    std::array<int, Dim> n;
    n.fill(3);
    const Vector<Dim> edge = Vector<Dim>::Constant(length), unit = Vector<Dim>::Ones();
    constexpr auto shape = Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
    const auto forces = [&](const Vector<Dim>& upper, double modulus, double of_state) {
        const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), upper, n, shape);
        solid::Ccg<Dim> ccg(mesh, std::vector{solid::Material{.young = modulus, .poisson = 0.3, .density = 1.0}}, {}, {},
                            CellForm::automatic, Precision::single_precision);
        const auto q = random_state(static_cast<std::size_t>(Dim * mesh.n_cells()), 3, of_state * upper[0]);
        std::vector<double> force(q.size());
        ccg.step_gradient(vectors<Dim>(q), {}, {}, vectors<Dim>(force));
        return force;
    };
    const auto expected = forces(unit, 1.0, 1.0), scaled = forces(edge, young, size);
    const double newtons = young * size * std::pow(length, Dim - 1);
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i) raise(worst, std::abs(scaled[i] / newtons - expected[i]));
    CHECK(worst < 1e-3 * largest(expected));  // a number that leaves the range of float is 0 or infinite
}

TEMPLATE_TEST_CASE_SIG("the operator in single precision is symmetric but for its roundings", "[solid][single_precision]",
                       ((int Dim), Dim), 2, 3) {
    for (const auto& [name, mesh] : boxes<Dim>()) {
        INFO(name);
        Operators<Dim> operators(mesh, FreeFaceRule::local_equilibrium, form_of(mesh));
        const auto n = static_cast<std::size_t>(mesh.n_cells()) * Dim;
        const auto times = [&](const std::vector<double>& a,
                               const std::vector<double>& b) {  // a.K b, and by how much it is off
            std::vector<double> force(n);
            operators.ccg.step_gradient(vectors<Dim>(b), {}, {}, vectors<Dim>(force));
            operators.magnitudes.set(vectors<Dim>(b), {}, {});
            const auto bounds = operators.magnitudes.bounds();
            double product = 0.0, off = 0.0;
            for (std::size_t c = 0; c < bounds.size(); ++c) {
                product += vectors<Dim>(a)[c].dot(vectors<Dim>(force)[c]);
                off += vectors<Dim>(a)[c].norm() * bounds[c];
            }
            return std::pair(product, off);
        };
        const auto a = random_state(n, 20), b = random_state(n, 30);
        const auto [a_k_b, off_b] = times(a, b);
        const auto [b_k_a, off_a] = times(b, a);
        CHECK(std::abs(a_k_b - b_k_a) < off_a + off_b);
    }
}

TEST_CASE("steps are in double where nothing is said, with the bits of a gradient", "[solid][single_precision]") {
    CHECK(solid::SolidOptions<2>{}.precision == Precision::double_precision);
    const auto mesh = unit_cylinder(0.3);
    solid::Ccg<3> ccg(mesh, std::vector{material}, {});
    const auto u = random_vectors<3>(static_cast<std::size_t>(mesh.n_cells()), 3);
    std::vector<Vector<3>> gradient(u.size()), of_step(u.size());
    ccg.gradient(u, {}, {}, gradient);
    ccg.step_gradient(u, {}, {}, of_step);
    CHECK(std::memcmp(gradient.data(), of_step.data(), u.size() * sizeof u[0]) == 0);
}

TEMPLATE_TEST_CASE_SIG("forces in single precision have the same bits on one thread, two and four",
                       "[solid][single_precision]", ((int Dim), Dim), 2, 3) {
    const auto mesh = round_body<Dim>(Dim == 2 ? 0.018 : 0.1);  // more chunks than the threads take one by one
    solid::Ccg<Dim> ccg(mesh, std::vector{material}, {}, {}, CellForm::automatic, Precision::single_precision);
    const auto u = random_vectors<Dim>(static_cast<std::size_t>(mesh.n_cells()), 3);
    const auto on_threads = [&](int threads) {
        const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(threads));
        oneapi::tbb::task_arena arena(threads);
        std::vector<Vector<Dim>> force(u.size(), Vector<Dim>::Zero());
        arena.execute([&] { ccg.step_gradient(u, {}, {}, force); });
        return force;
    };
    const auto one = on_threads(1);
    for (const int threads : {2, 4}) {
        const auto several = on_threads(threads);
        CHECK(std::memcmp(several.data(), one.data(), one.size() * sizeof one[0]) == 0);
    }
}

namespace {

template <int Dim>
solid::SolidOptions<Dim> in_single_precision(int n_bodies) {
    solid::SolidOptions<Dim> options = bodies<Dim>(n_bodies);
    options.precision = Precision::single_precision;
    return options;
}

}  // namespace

TEST_CASE("bodies that step in single precision meet and part as in double, and no contact is missed",
          "[solid][single_precision]") {
    const auto law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    const auto run = [&](Precision precision) {
        auto options = bodies<2>(2);
        options.precision = precision;
        options.law = law;
        auto scene = std::make_unique<Scene<2>>(two_discs(0.8), options, disc_velocities);
        scene->run_until(12.0);
        return scene;
    };
    const auto single = run(Precision::single_precision), expected = run(Precision::double_precision);
    const auto report = single->solid.contact().report();
    CHECK(report.missed_contacts == 0);
    CHECK(report.active_pairs_max > 0);
    // docs/trade.md promises H~ to 1e-5 of K0 where it says what single precision costs, and one is not double by mistake
    const double drift = single->ledger.pseudo_energy_drift() / single->kinetic_start();
    CHECK(drift < 1e-5);
    CHECK(drift > 1e-12);
    for (int body = 0; body < 2; ++body) {
        const auto velocity = [&](Scene<2>& scene) {
            return solid::body_motions<2>(scene.memm, scene.solid)[static_cast<std::size_t>(body)].velocity;
        };
        CHECK((velocity(*single) - velocity(*expected)).norm() < 1e-4 * 0.05);
    }
}

TEST_CASE("bodies that float step in single precision, far from home and turned", "[solid][single_precision]") {
    auto options = in_single_precision<2>(1);
    options.contact.reset();
    options.kinematics = {solid::Kinematics::floating};
    const auto mesh = unit_disc(0.25);
    const Matrix<2> turn = turned_by<2>(1.0);
    const auto rigid = sampled(mesh, [&](const Vector<2>& x) { return Vector<2>(turn * x - x + Vector<2>(1e3, 0.0)); });
    auto deformed = rigid;
    const auto noise = random_state(rigid.size(), 3, 1e-3);
    for (std::size_t i = 0; i < rigid.size(); ++i) deformed[i] += noise[i];
    const auto mean_force = [&](Precision precision, const std::vector<double>& q) {
        options.precision = precision;
        solid::Solid<2> solid(mesh, options);  // one each: a step begins in the frame that the last one ended in
        std::vector<double> force(q.size());
        solid.mean_force(q, q, 0.0, 1e-3, force);
        return force;
    };
    for (const auto& q : {deformed, rigid}) {  // of a rigid motion rounding of displacements leaves strains of 1e-13
        const auto of_single = mean_force(Precision::single_precision, q),
                   of_double = mean_force(Precision::double_precision, q);
        double worst = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) raise(worst, std::abs(of_single[i] - of_double[i]));
        CHECK(worst / largest(of_double) < 1e-4);
        CHECK(worst / largest(of_double) > 0.0);
    }
}

TEST_CASE("leapfrog steps in single precision, too", "[solid][single_precision]") {
    const auto run = [](Precision precision) {
        auto options = bodies<2>(1);
        options.contact.reset();
        options.precision = precision;
        const auto mesh = unit_disc(0.25);
        solid::Solid<2> solid(mesh, options);
        dynamics::Leapfrog<solid::Solid<2>> leapfrog(solid, random_state(solid.size(), 3, 1e-3),
                                                     std::vector<double>(solid.size(), 0.0),
                                                     0.5 * dynamics::stable_step(solid).dt);
        for (int i = 0; i < 100; ++i) leapfrog.step();
        return std::vector<double>(leapfrog.q().begin(), leapfrog.q().end());
    };
    const auto single = run(Precision::single_precision), expected = run(Precision::double_precision);
    double worst = 0.0;
    for (std::size_t i = 0; i < single.size(); ++i) raise(worst, std::abs(single[i] - expected[i]));
    CHECK(worst < 1e-3 * largest(expected));
    CHECK(worst > 0.0);
}

TEST_CASE("a run in single precision that is restored has the bits of one that goes on", "[solid][single_precision]") {
    const auto start = [] { return std::make_unique<Scene<2>>(two_discs(0.8), in_single_precision<2>(2), disc_velocities); };
    const auto whole = start();
    whole->run(100);
    const auto motion = whole->memm.state();
    const auto of_solid = whole->solid.state();
    const auto resumed = start();
    resumed->memm.restore(motion);
    resumed->solid.restore(of_solid, resumed->memm.q());
    for (int i = 0; i < 100; ++i) {
        whole->memm.step();
        resumed->memm.step();
    }
    CHECK(whole->solid.contact().report().active_pairs_max > 0);
    CHECK(std::ranges::equal(whole->memm.q(), resumed->memm.q()));
    CHECK(std::ranges::equal(whole->memm.p_after(), resumed->memm.p_after()));
}

TEST_CASE("finite bodies and local steps are refused in single precision, by name", "[solid][single_precision]") {
    const auto mesh = two_discs(0.0);
    auto options = in_single_precision<2>(2);
    options.kinematics = {solid::Kinematics::small, solid::Kinematics::finite};
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains(mesh.body_names[1]) &&
                                                          Catch::Contains("Kinematics::finite") &&
                                                          Catch::Contains("single precision"));
    options.kinematics.clear();
    options.law = solid::ContactLaw::reconstruction;
    solid::Solid<2> solid(mesh, options);
    const std::vector<std::int32_t> level(solid.size(), 0);
    CHECK_THROWS_WITH(solid.set_levels(1, level), Catch::Contains("local steps") && Catch::Contains("double precision"));
}
