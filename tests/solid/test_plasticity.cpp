// Bodies of Kinematics::finite whose material remembers: J2 plasticity, and laws as a user writes them.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numeric>

#include "abut/base/error.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/change.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

const Material metal{.young = 1.0,
                     .poisson = 0.3,
                     .density = 1.0,
                     .law = MaterialLaw::j2,
                     .flow = {.yield_stress = 4e-3, .hardening = 0.05, .saturation = 2e-3, .saturation_rate = 8.0}};

/// The same with kinematic hardening.
const Material kinematic = [] {
    Material material = metal;
    material.flow.kinematic_hardening = 0.04;
    return material;
}();

constexpr double any_dt = 1.0;  // of materials whose stress does not depend on rates

/// A law that counts the steps of a cell that have ended; elastic as St. Venant and Kirchhoff's material.
template <int Dim>
class Counting : public solid::InelasticLaw<Dim> {
public:
    explicit Counting(const Material& material) : material_(material) {}
    [[nodiscard]] std::vector<double> initial_memory() const override { return {0.0}; }
    [[nodiscard]] solid::Response<Dim> at(const Matrix<Dim>& g, std::span<const double> memory) const override {
        (void)memory;
        return linear_in_green_strain<Dim>(material_, g);
    }
    [[nodiscard]] solid::Advance<Dim> advance(const Matrix<Dim>& g, double dt, std::span<double> memory) const override {
        (void)dt;
        memory[0] += 1.0;
        return {at(g, memory), false};
    }
    [[nodiscard]] double plastic_strain(std::span<const double> memory) const override { return memory[0]; }

private:
    Material material_;
};

/// Kirchhoff's stress P F^T in space, with that out of the plane where its trace is that of an elastic volume.
template <int Dim>
double deviator_size(const Matrix<Dim>& stress, const Matrix<Dim>& g, const Material& material) {
    const Matrix<Dim> f = Matrix<Dim>::Identity() + g;
    Matrix<3> tau = in_3d<Dim>(stress * f.transpose());
    if (Dim == 2) {
        const double bulk = material.lambda() + 2.0 / 3.0 * material.mu();
        tau(2, 2) = 3.0 * bulk * std::log(f.determinant()) - tau(0, 0) - tau(1, 1);  // flow keeps the volume
    }
    return (tau - tau.trace() / 3.0 * Matrix<3>::Identity()).norm();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a step of any size ends on the yield surface, keeps the volume of what has flowed, and knows no turn",
    "[solid][material]", ((int Dim), Dim), 2, 3) {
    const auto law = solid::inelastic_law<Dim>(metal);
    for (const double size : {0.01, 0.1, 0.3})
        for (unsigned seed = 1; seed <= 40; ++seed) {
            std::vector<double> memory = law->initial_memory();
            const Matrix<Dim> first = some_gradient<Dim>(seed, size), last = first + some_gradient<Dim>(seed + 100, size);
            if ((Matrix<Dim>::Identity() + first).determinant() < 0.2 ||
                (Matrix<Dim>::Identity() + last).determinant() < 0.2)
                continue;
            (void)law->advance(first, any_dt, memory);
            const double before = law->plastic_strain(memory);
            auto turned_memory = memory;
            const auto step = law->advance(last, any_dt, memory);
            if (!step.dissipates) continue;
            CHECK(law->plastic_strain(memory) > before);
            const double yield = std::sqrt(2.0 / 3.0) * metal.flow.stress(law->plastic_strain(memory));
            CHECK(std::abs(deviator_size<Dim>(step.response.stress, last, metal) - yield) <= 1e-12);
            if constexpr (Dim == 3) {
                const Matrix<3> f = Matrix<3>::Identity() + last;
                const double pressure = (metal.lambda() + 2.0 / 3.0 * metal.mu()) * std::log(f.determinant());
                CHECK(std::abs((step.response.stress * f.transpose()).trace() / 3.0 - pressure) <= 1e-13);
            }
            // What is remembered gives the stress that the step ended with, and another look does not flow.
            CHECK((law->at(last, memory).stress - step.response.stress).norm() <= 1e-13);
            // The same in turned axes of space
            const Matrix<Dim> turn = turned_by<Dim>(0.8), unit = Matrix<Dim>::Identity();
            const auto turned = law->advance(turn * (unit + last) - unit, any_dt, turned_memory);
            CHECK((turned.response.stress - turn * step.response.stress).norm() <= 1e-13);
            for (std::size_t i = 0; i < memory.size(); ++i) CHECK(std::abs(turned_memory[i] - memory[i]) <= 1e-13);
        }
}

TEMPLATE_TEST_CASE_SIG("the stress at the end of a plastic step is the slope of what the step stores and dissipates",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    const auto law = solid::inelastic_law<Dim>(GENERATE(false, true) ? kinematic : metal);
    constexpr double h = 1e-6;
    for (const unsigned seed : {1u, 2u, 3u}) {
        std::vector<double> memory = law->initial_memory();
        (void)law->advance(some_gradient<Dim>(seed, 0.05), any_dt, memory);
        const Matrix<Dim> g = some_gradient<Dim>(seed + 10, 0.1), d = some_gradient<Dim>(seed + 20, 1.0);
        const auto energy = [&](const Matrix<Dim>& at) {
            auto changed = memory;
            return law->advance(at, any_dt, changed).response.energy;
        };
        auto changed = memory;
        const double slope = (energy(g + h * d) - energy(g - h * d)) / (2.0 * h);
        CHECK(std::abs(law->advance(g, any_dt, changed).response.stress.cwiseProduct(d).sum() - slope) <= 1e-8);
    }
}

TEMPLATE_TEST_CASE_SIG("changes of the stress of metal are its slopes, in a state and in a step that flows",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    const auto law = solid::inelastic_law<Dim>(GENERATE(false, true) ? kinematic : metal);
    constexpr double h = 1e-6;
    for (const unsigned seed : {1u, 2u, 3u})
        for (const double size : {1e-4, 0.1}) {  // before it yields, and beyond
            std::vector<double> memory = law->initial_memory();
            (void)law->advance(some_gradient<Dim>(seed, size), any_dt, memory);
            const Matrix<Dim> g = some_gradient<Dim>(seed + 10, size);
            const std::array changes{some_gradient<Dim>(seed + 20, 1.0), some_gradient<Dim>(seed + 30, 1.0)};
            std::array<Matrix<Dim>, 2> of_state, of_step;
            REQUIRE(law->stress_changes(g, memory, changes, of_state));
            REQUIRE(law->advanced_changes(g, any_dt, memory, changes, of_step));
            const auto advanced = [&](const Matrix<Dim>& at) {
                auto changed = memory;
                return law->advance(at, any_dt, changed).response.stress;
            };
            for (std::size_t i = 0; i < 2; ++i) {
                const Matrix<Dim> d = h * changes[i];
                const Matrix<Dim> frozen = (law->at(g + d, memory).stress - law->at(g - d, memory).stress) / (2.0 * h);
                CHECK((of_state[i] - frozen).norm() <= 1e-8);
                CHECK((of_step[i] - (advanced(g + d) - advanced(g - d)) / (2.0 * h)).norm() <= 1e-8);
            }
        }
}

TEST_CASE("pure shear in the plane hardens as the closed form says, for small and for large strains", "[solid][material]") {
    // Stretches l, 1/l: tau_1 = 2 mu (ln l - e_p), |dev| = sqrt(2) tau_1, alpha = 2 e_p/sqrt(3).
    Material linear = metal;
    linear.flow.saturation = linear.flow.saturation_rate = 0.0;
    const auto law = solid::inelastic_law<2>(linear);
    const double mu = linear.mu();
    for (const double log : {1e-3, 5e-3, 0.1, 0.8}) {
        std::vector<double> memory = law->initial_memory();
        Matrix<2> g = Matrix<2>::Zero();
        g(0, 0) = std::expm1(log);
        g(1, 1) = std::expm1(-log);
        const auto step = law->advance(g, any_dt, memory);
        const double root = std::sqrt(3.0);
        const double flowed = std::max(
            0.0, (2.0 * mu * log - linear.flow.yield_stress / root) / (2.0 * mu + 2.0 / 3.0 * linear.flow.hardening));
        CHECK(law->plastic_strain(memory) == Approx(2.0 * flowed / root).epsilon(1e-12).margin(1e-17));
        CHECK(step.response.stress(0, 0) == Approx(2.0 * mu * (log - flowed) / std::exp(log)).epsilon(1e-12));
    }
}

TEMPLATE_TEST_CASE_SIG(
    "metal with kinematic hardening ends steps of any size on its yield surface, keeps volume and knows no turn",
    "[solid][material]", ((int Dim), Dim), 2, 3) {
    const auto law = solid::inelastic_law<Dim>(kinematic);
    const Matrix<Dim> turn = turned_by<Dim>(0.8), unit = Matrix<Dim>::Identity();
    for (const double size : {0.01, 0.1, 0.3})
        for (unsigned seed = 1; seed <= 40; ++seed) {
            std::vector<double> memory = law->initial_memory();
            const Matrix<Dim> first = some_gradient<Dim>(seed, size), last = first + some_gradient<Dim>(seed + 100, size);
            if ((unit + first).determinant() < 0.2 || (unit + last).determinant() < 0.2) continue;
            (void)law->advance(first, any_dt, memory);
            auto turned_memory = memory;
            const double before = law->plastic_strain(memory);
            const auto step = law->advance(last, any_dt, memory);
            // Volume: the mean of Kirchhoff's stress is that of an elastic one.
            if constexpr (Dim == 3) {
                const double pressure =
                    (kinematic.lambda() + 2.0 / 3.0 * kinematic.mu()) * std::log((unit + last).determinant());
                CHECK(std::abs((step.response.stress * (unit + last).transpose()).trace() / 3.0 - pressure) <= 1e-13);
            }
            CHECK((law->at(last, memory).stress - step.response.stress).norm() <= 1e-15);
            const auto turned = law->advance(turn * (unit + last) - unit, any_dt, turned_memory);
            CHECK((turned.response.stress - turn * step.response.stress).norm() <= 1e-13);
            CHECK(std::abs(turned.response.energy - step.response.energy) <= 1e-13);
            for (std::size_t i = 0; i < memory.size(); ++i) CHECK(std::abs(turned_memory[i] - memory[i]) <= 1e-13);
            // On the surface: a step that stays there does not flow.
            CHECK(law->plastic_strain(memory) >= before);
            auto again = memory;
            (void)law->advance(last, any_dt, again);
            for (std::size_t i = 0; i < memory.size(); ++i) CHECK(std::abs(again[i] - memory[i]) <= 1e-15);
        }
}

TEST_CASE("a bar of metal with kinematic hardening follows the closed form of cyclic tension in logarithmic strains",
          "[solid][material]") {
    // ln F = diag(e, l, l) with l = -nu (e - p) - p/2, so that no stress is across; Kirchhoff's along is E (e - p). It flows where
    // |E (e - p) - H p| reaches sigma_y + H_i alpha: forth at sigma_y, back 2 (sigma_y + H_i alpha) below where it turned (Bauschinger).
    Material bar = kinematic;
    bar.flow.saturation = bar.flow.saturation_rate = 0.0;
    for (const double hardening : {0.0, 0.05}) {
        bar.flow.hardening = hardening;
        const auto law = solid::inelastic_law<3>(bar);
        const Matrix<3> axes = turned_by<3>(0.7);
        std::vector<double> memory = law->initial_memory();
        double plastic = 0.0, alpha = 0.0, largest = 0.0;
        for (int i = 1; i <= 400; ++i) {
            const Matrix<3> turn = turned_by<3>(0.01 * i);
            const double strain = 0.4 * std::sin(0.05 * i);
            const double beyond = bar.young * (strain - plastic) - bar.flow.kinematic_hardening * plastic;
            const double over = std::abs(beyond) - bar.flow.yield_stress - bar.flow.hardening * alpha;
            if (over > 0.0) {
                const double flowed = over / (bar.young + bar.flow.kinematic_hardening + bar.flow.hardening);
                plastic += std::copysign(flowed, beyond);
                alpha += flowed;
            }
            const double across = -bar.poisson * (strain - plastic) - 0.5 * plastic;
            const Matrix<3> stretch =
                axes * Vector<3>(std::exp(strain), std::exp(across), std::exp(across)).asDiagonal() * axes.transpose();
            const Matrix<3> f = turn * stretch;
            const auto step = law->advance(f - Matrix<3>::Identity(), any_dt, memory);
            const Matrix<3> expected =
                bar.young * (strain - plastic) * (turn * axes.col(0)) * (turn * axes.col(0)).transpose();
            raise(largest, (step.response.stress * f.transpose() - expected).norm());
            raise(largest, std::abs(law->plastic_strain(memory) - alpha));
        }
        CHECK(alpha > 1.0);
        CHECK(largest <= 1e-13);
    }
}

TEST_CASE("hardly any kinematic hardening is none where axes do not turn, and in shears up to a half", "[solid][material]") {
    // One rule adds logarithmic strains, the other multiplies stretches.
    Material none{.young = 1.0,
                  .poisson = 0.3,
                  .density = 1.0,
                  .law = MaterialLaw::j2,
                  .flow = {.yield_stress = 2e-3, .hardening = 0.02}};
    Material hardly = none;
    hardly.flow.kinematic_hardening = 1e-14;
    const auto sum = solid::inelastic_law<2>(hardly), product = solid::inelastic_law<2>(none);
    const auto shear_off = [&](double most, bool turns) {
        std::vector<double> of_sum = sum->initial_memory(), of_product = product->initial_memory();
        double off = 0.0;
        for (int i = 1; i <= 1000; ++i) {
            const double shear = most * i / 1000.0;
            Matrix<2> g = Matrix<2>::Zero();
            if (turns)
                g(0, 1) = shear;
            else
                g(0, 0) = std::expm1(shear), g(1, 1) = std::expm1(-0.7 * shear);
            const int column = turns ? 1 : 0;
            const double stress = sum->advance(g, any_dt, of_sum).response.stress(0, column);
            off = stress / product->advance(g, any_dt, of_product).response.stress(0, column) - 1.0;
        }
        return off;
    };
    CHECK(std::abs(shear_off(1.0, false)) <= 1e-11);
    CHECK(std::abs(shear_off(0.2, true)) <= 2e-4);
    CHECK(std::abs(shear_off(0.5, true)) <= 4e-3);
    CHECK(shear_off(1.0, true) == Approx(-0.03).epsilon(0.2));
    CHECK(shear_off(2.0, true) == Approx(-0.20).epsilon(0.1));
}

TEST_CASE("a bar that hits a wall has the two fronts and the plateau of the exact bilinear bar", "[solid][material][long]") {
    // Two bricks across each way, each with two free sides: a bar of E and E_t = E H/(E + H). An elastic front at c, then a plastic one at
    // sqrt(E_t/rho), behind which the stress is sigma_y + rho sqrt(E_t/rho) (v_0 - sigma_y/(rho c)).
    constexpr int n = 200;
    constexpr double yield = 1e-4, speed = 5.0 * yield, plastic_modulus = 0.1;
    const double plastic_speed = std::sqrt(plastic_modulus), time = 0.8;
    const double plateau = yield + plastic_speed * (speed - yield);
    Material bar{.young = 1.0, .poisson = 0.3, .density = 1.0, .law = MaterialLaw::j2, .flow = {.yield_stress = yield}};
    bar.flow.hardening = plastic_modulus / (1.0 - plastic_modulus);
    bar.flow.jump_cap =
        GENERATE(0.0, 0.1);  // all cells have free faces: jumps that yield still bear what contact pushes with
    const auto mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 2.0 / n, 2.0 / n}, {n, 2, 2}, CellShape::hexahedron);
    auto options = bodies<3>(1);
    options.materials = {bar};
    options.obstacles = {contact::plane_obstacle<3>(Vector<3>::Zero(), Vector<3>::Unit(0), 0.1)};
    TurningScene<3> scene(mesh, options, {moving<3>(-speed * Vector<3>::Unit(0))}, 0.5, Kinematics::finite);
    while (scene.memm.time() < time) scene.run(1, 100);
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
    CHECK(scene.drifts().parasitic <= 0.1 * speed);  // what the impact kicks

    (void)scene.solid.potential(scene.memm.q());
    const auto pressure = [&](std::int32_t c) { return -scene.solid.cells().stress(c)(0, 0); };
    const auto position = [&](std::int32_t c) { return mesh.cell_centroid[static_cast<std::size_t>(c)][0]; };
    const auto front = [&](double level) {  // the farthest cell that has more
        double at = 0.0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            if (pressure(c) > level) at = std::max(at, position(c));
        return at;
    };
    double sum = 0.0;
    int count = 0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (position(c) > 0.05 && position(c) < 0.2) sum += pressure(c), ++count;
    const double mean = sum / count;
    INFO("jump_cap " << bar.flow.jump_cap << " plateau " << mean / plateau << " plastic " << front(0.5 * (plateau + yield))
                     << " elastic " << front(0.5 * yield));
    // Fronts are two to three cells wide, and behind by half of that: 0.8, 4 and 5 %, of 100 cells 4, 8 and 8 %.
    CHECK(std::abs(mean / plateau - 1.0) <= 0.01);
    CHECK(std::abs(front(0.5 * (plateau + yield)) / (plastic_speed * scene.memm.time()) - 1.0) <= 0.05);
    CHECK(std::abs(front(0.5 * yield) / scene.memm.time() - 1.0) <= 0.05);
}

TEMPLATE_TEST_CASE_SIG("a metal block that spins and rings flows, keeps H~ + D and J~, and dissipates in each step",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    const Material& material = GENERATE(false, true) ? kinematic : metal;
    for (const auto& [name, mesh] : boxes<Dim>()) {
        CAPTURE(name, material.flow.kinematic_hardening);
        const Motion<Dim> spinning{Vector<Dim>::Zero(), some_spin<Dim>(0.02)};
        TurningScene<Dim> scene(mesh, alone<Dim>(material), {spinning}, 0.4, Kinematics::finite, 0.03);
        const double fall = fall_of_dissipation<Dim>(scene, Dim == 3 && material.flow.kinematic_hardening > 0.0 ? 150 : 400,
                                                     &dynamics::Losses::in_cells);
        const Drifts drifts = scene.drifts();
        CHECK(scene.solid.dissipated().in_cells > 0.1 * scene.ledger.largest_energy());
        CHECK(fall <= 0.0);
        CHECK(scene.ledger.entries().back().losses.total() == scene.solid.dissipated().total());
        CHECK(drifts.pseudo_energy <= 1e-13);
        CHECK(drifts.pseudo_moment <= 1e-13);
        CHECK(drifts.momentum <= 1e-13);
        CHECK(drifts.parasitic <= 1e-2);
    }
}

TEMPLATE_TEST_CASE_SIG("metal bodies that spin collide, flow where they touch, and keep H~ + D, momentum and J~",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    const auto scene = spinning_collision<Dim>(finite_of<Dim>(GENERATE(false, true) ? kinematic : metal, 2));
    scene->run(steps_of_collision<Dim>);
    check_collision<Dim>(*scene);
    CHECK(scene->solid.dissipated().in_cells > 0.01 * scene->ledger.largest_energy());
    CHECK(std::abs(scene->solid.dissipated().on_faces) <= 0.2 * scene->solid.dissipated().in_cells);
    CHECK(scene->drifts().energy_excess <= 1e-2);
}

TEMPLATE_TEST_CASE_SIG(
    "jumps of metal bodies that collide yield along faces, dissipate in each step, and keep H~ + D, momentum and J~",
    "[solid][material]", ((int Dim), Dim), 2, 3) {
    Material capped = metal;
    capped.flow.jump_cap = 0.1;
    const auto scene = spinning_collision<Dim>(finite_of<Dim>(capped, 2));
    const double fall = fall_of_dissipation<Dim>(*scene, steps_of_collision<Dim>, &dynamics::Losses::in_jumps);
    check_collision<Dim>(*scene);
    CHECK(fall <= 0.0);
    CHECK(scene->solid.dissipated().in_jumps > 0.001 * scene->ledger.largest_energy());
}

TEMPLATE_TEST_CASE_SIG("only a step that has ended is remembered: looks, forces and refused steps are not",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    auto options = finite_of<Dim>(metal, 2);
    const Material elastic{.young = 1.0, .poisson = 0.3, .density = 1.0};
    options.materials = {elastic, elastic};
    options.finite.inelastic = {std::make_shared<Counting<Dim>>(elastic), nullptr};
    const auto scene = spinning_collision<Dim>(options);
    auto& solid = scene->solid;
    std::vector<double> force(solid.size());
    const auto check_count = [&](double expected) {
        for (std::int32_t c = 0; c < scene->mesh.n_cells(); ++c)
            CHECK(solid.cells().plastic_strain(c) ==
                  (scene->mesh.cell_body[static_cast<std::size_t>(c)] == 0 ? expected : 0.0));
    };
    for (int step = 0; step < 40; ++step) {  // into contact
        scene->memm.step();
        std::vector<double> q(scene->memm.q().begin(), scene->memm.q().end());
        (void)solid.potential(q);
        solid.force(q, force);
        (void)solid.contact_at(q).field();
        for (double& of_point : q) of_point *= 1.01;
        (void)solid.potential(q);
        (void)dynamics::measure(scene->memm, solid);
    }
    check_count(40.0);
    const std::vector<double> q(scene->memm.q().begin(), scene->memm.q().end());
    std::vector<double> nowhere(q.size());
    for (std::size_t i = 0; i < q.size(); ++i)
        nowhere[i] = 10.0 * solid.rest_positions()[i / Dim][static_cast<int>(i % Dim)];
    CHECK_THROWS_AS(solid.mean_force(q, nowhere, scene->memm.time(), scene->memm.dt(), force), Error);
    scene->memm.step();
    check_count(41.0);
}

TEMPLATE_TEST_CASE_SIG("a run of metal bodies that goes on from its state has the same bits", "[solid][material]",
                       ((int Dim), Dim), 2, 3) {
    const Material& material = GENERATE(false, true) ? kinematic : metal;
    const auto whole = spinning_collision<Dim>(finite_of<Dim>(material, 2)),
               first = spinning_collision<Dim>(finite_of<Dim>(material, 2));
    const int half = Dim == 2 ? 200 : 80;
    whole->run(2 * half);
    first->run(half);
    CHECK(first->solid.dissipated().in_cells > 0.0);
    const auto second = spinning_collision<Dim>(finite_of<Dim>(material, 2));
    second->memm.restore(first->memm.state());
    second->solid.restore(first->solid.state(), second->memm.q());
    second->run(half);
    CHECK(std::ranges::equal(second->memm.q(), whole->memm.q()));
    CHECK(std::ranges::equal(second->memm.p_after(), whole->memm.p_after()));
    CHECK(second->solid.dissipated().total() == whole->solid.dissipated().total());
    for (std::int32_t c = 0; c < whole->mesh.n_cells(); ++c)
        CHECK(second->solid.cells().plastic_strain(c) == whole->solid.cells().plastic_strain(c));
}

TEMPLATE_TEST_CASE_SIG("what metal remembers is not taken for what metal with kinematic hardening does",
                       "[solid][material][change]", ((int Dim), Dim), 2, 3) {
    const auto before = spinning_collision<Dim>(finite_of<Dim>(metal, 2)),
               other = spinning_collision<Dim>(finite_of<Dim>(kinematic, 2));
    before->run(3);
    CHECK_THROWS_WITH(other->solid.restore(before->solid.state(), before->memm.q()),
                      Catch::Contains("remember other things"));
    std::vector<std::int32_t> same(static_cast<std::size_t>(before->mesh.n_cells()));
    std::iota(same.begin(), same.end(), 0);
    const auto next = spinning_collision<Dim>(finite_of<Dim>(kinematic, 2));
    CHECK_THROWS_WITH(solid::change(before->solid, before->memm.state(), next->solid, same),
                      Catch::Contains("remembers other things"));
}

TEST_CASE("a material that remembers is refused where nothing keeps what it remembers", "[solid][material]") {
    const auto mesh = boxes<2>()[0].mesh;
    solid::Solid<2> solid(mesh, alone<2>(metal));
    const std::vector<double> q(solid.size(), 0.0);
    std::vector<double> force(q.size());
    CHECK_THROWS_WITH(solid.end_force(q, q, 0.0, 1.0, force), Catch::Contains("remembers") && Catch::Contains("memm"));
    const std::vector<std::int32_t> level(q.size(), 0);
    CHECK_THROWS_WITH(solid.set_levels(1, level), Catch::Contains("local steps"));
    auto options = alone<2>({.young = 1.0, .poisson = 0.3, .density = 1.0});
    options.kinematics = {Kinematics::floating};
    options.finite.inelastic = {std::make_shared<Counting<2>>(metal)};
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options),
                      Catch::Contains("has a law of large strains") && Catch::Contains("Take Kinematics::finite"));
    options = alone<2>(metal);
    options.materials[0].flow.yield_stress = 0.0;
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains("yield_stress"));
    options = alone<2>(metal);
    options.materials[0].law = MaterialLaw::neo_hookean;
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains("its law is not j2"));
    options = alone<2>(metal);
    options.materials[0].flow.saturation_rate = 0.0;
    CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains("saturation_rate"));
}

TEST_CASE("a law whose step contradicts itself is refused: no energy of a run would show it", "[solid][material]") {
    class Forgetful final : public Counting<2> {  // it stiffens with each step, and says so one step late
    public:
        Forgetful() : Counting(metal) {}
        [[nodiscard]] solid::Response<2> at(const Matrix<2>& g, std::span<const double> memory) const override {
            solid::Response<2> response = Counting::at(g, memory);
            response.energy *= 1.0 + memory[0];
            response.stress *= 1.0 + memory[0];
            return response;
        }
        [[nodiscard]] solid::Advance<2> advance(const Matrix<2>& g, double dt, std::span<double> memory) const override {
            (void)dt;
            const solid::Response<2> before = at(g, memory);
            memory[0] += 1.0;
            return {before, false};
        }
    };
    class Unbalanced final : public Counting<2> {
    public:
        Unbalanced() : Counting(metal) {}
        [[nodiscard]] solid::Advance<2> advance(const Matrix<2>& g, double dt, std::span<double> memory) const override {
            solid::Advance<2> step = Counting::advance(g, dt, memory);
            step.response.energy *= 1.01;
            return step;
        }
    };
    const auto mesh = boxes<2>()[0].mesh;
    auto options = alone<2>({.young = metal.young, .poisson = metal.poisson, .density = 1.0});
    const auto refused = [&](std::shared_ptr<const solid::InelasticLaw<2>> law, const char* why) {
        options.finite.inelastic = {std::move(law)};
        CHECK_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains(why) && Catch::Contains("body '"));
    };
    refused(std::make_shared<Forgetful>(), "another stress after a step");
    refused(std::make_shared<Unbalanced>(), "not the slope of what the step stores and dissipates");
}
