// How metal hardens: closed forms, tables, and what the rate of flow does.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "abut/base/error.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

constexpr double yield = 1e-3;

Material metal() {
    return {.young = 1.0, .poisson = 0.3, .density = 1.0, .law = MaterialLaw::j2, .flow = {.yield_stress = yield}};
}

Material tabled(std::vector<solid::HardeningPoint> table) {
    Material material = metal();
    material.flow.yield_stress = table.front().stress;
    material.flow.table = std::move(table);
    return material;
}

/// A rise by half at 0.002, none to 0.004, then a steep one that ends at 0.006.
Material stepped() { return tabled({{0.0, yield}, {2e-3, 1.5 * yield}, {4e-3, 1.5 * yield}, {6e-3, 3.0 * yield}}); }

Material power_law() {
    Material material = metal();
    material.flow.power_hardening = 4e-3;
    material.flow.power_exponent = 0.3;
    return material;
}

Material cowper_symonds(Material material = metal()) {
    material.flow.cowper_symonds_rate = 0.01;
    material.flow.cowper_symonds_exponent = 5.0;
    return material;
}

Material johnson_cook(Material material = metal(), double rate = 1e-5) {
    material.flow.johnson_cook_rate = rate;
    material.flow.johnson_cook_factor = 0.05;
    return material;
}

/// How pure shear in the plane ends.
struct Shear {
    double von_mises, alpha;
};

/// A bar of bricks with free sides that is pulled slowly: sums over its volume.
struct Pulled {
    double stress, strain, balance;
};
Pulled pull(Material material, double strain, double duration) {
    material.damping.mass = 0.5;
    const auto mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {3.0, 1.0, 1.0}, {6, 2, 2}, CellShape::hexahedron);
    auto options = alone<3>(material);
    const std::array<bool, 3> along{true, false, false};
    const auto history = [=](double t, const Vector<3>&) -> Vector<3> { return {3.0 * strain * t / duration, 0.0, 0.0}; };
    options.boundary.dirichlet = {
        {.group = "xmin", .constraint = solid::Constraint::components, .components = along},
        {.group = "xmax", .constraint = solid::Constraint::components, .components = along, .history = history}};
    TurningScene<3> scene(mesh, options, {moving<3>(Vector<3>::Zero())}, 0.9, Kinematics::small);
    scene.run_until(duration);
    (void)scene.solid.potential(scene.memm.q());
    double stress = 0.0, plastic = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        stress += mesh.cell_measure[c] / 3.0 * scene.solid.cells().stress(c)(0, 0);
        plastic += mesh.cell_measure[c] / 3.0 * scene.solid.cells().plastic_strain(c);
    }
    return {stress, plastic, scene.drifts().pseudo_energy};
}

/// Shears a body that is strained alike everywhere at a constant rate of the largest strain, or a cell of a finite one.
template <class Step>
void shear_at(double rate, double most, int steps, const Step& step) {
    const double dt = most / rate / steps;
    for (int i = 1; i <= steps; ++i) step(i * rate * dt, dt);
}

/// A body that is sheared alike everywhere.
struct Sheared {
    mesh::Mesh<2> mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {2, 2}, CellShape::quadrangle);
    double strain = 0.0, time = 0.0;  // at the end of the last step
    std::function<double(double)> path = [](double) { return 0.0; };
    solid::Solid<2> solid;
    std::vector<double> q_0, q_1, force;

    explicit Sheared(const Material& material)
        : solid(mesh, options_of(material)), q_0(solid.size(), 0.0), q_1(q_0), force(q_0) {}
    Sheared(const Sheared&) = delete;

    void to(double reached, double dt) {
        const double before = strain;
        strain = reached;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) vectors<2>(q_1)[c] = gradient(strain) * mesh.cell_centroid[c];
        path = [=, start = time](double t) { return before + (reached - before) * (t - start) / dt; };
        solid.mean_force(q_0, q_1, time, dt, force);
        std::swap(q_0, q_1);
        time += dt;
    }
    [[nodiscard]] Shear now() {
        (void)solid.potential(q_0);
        const Matrix<2> stress = solid.cells().stress(0);
        return {std::sqrt(0.75) * (stress(0, 0) - stress(1, 1)), solid.cells().plastic_strain(0)};
    }

private:
    [[nodiscard]] static Matrix<2> gradient(double strain) { return Vector<2>(strain, -strain).asDiagonal(); }
    [[nodiscard]] solid::SolidOptions<2> options_of(const Material& material) const {
        auto options = alone<2>(material);
        options.kinematics = {Kinematics::small};
        for (const auto& group : mesh.groups)
            options.boundary.dirichlet.push_back(
                {.group = group.name,
                 .history = [this](double t, const Vector<2>& x) -> Vector<2> { return gradient(path(t)) * x; }});
        return options;
    }
};

Shear of_small(const Material& material, double rate, double most, int steps) {
    Sheared body(material);
    shear_at(rate, most, steps, [&](double strain, double dt) { body.to(strain, dt); });
    const Shear shear = body.now();
    CHECK(std::abs(body.solid.cells().out_of_plane_stress(0)) <= 1e-15);
    return shear;
}

Shear of_finite(const Material& material, double rate, double most, int steps) {
    const auto law = solid::inelastic_law<2>(material);
    std::vector<double> memory = law->initial_memory();
    Shear shear{};
    shear_at(rate, most, steps, [&](double strain, double dt) {
        Matrix<2> g = Matrix<2>::Zero();
        g(0, 0) = std::expm1(strain);
        g(1, 1) = std::expm1(-strain);
        const Matrix<2> stress = law->advance(g, dt, memory).response.stress;
        shear = {std::sqrt(0.75) * (stress(0, 0) * std::exp(strain) - stress(1, 1) * std::exp(-strain)),
                 law->plastic_strain(memory)};
    });
    return shear;
}

/// alpha after pure shear to this strain, by bisection.
double flowed_in_shear(const Material& material, double strain) {
    // von Mises: 2 sqrt(3) mu strain - 3 mu alpha = sigma(alpha)
    double low = 0.0, high = 2.0 * strain / std::sqrt(3.0);
    for (int i = 0; i < 200; ++i) {
        const double alpha = 0.5 * (low + high);
        const double trial = 2.0 * std::sqrt(3.0) * material.mu() * strain - 3.0 * material.mu() * alpha;
        (trial > material.flow.stress(alpha) ? low : high) = alpha;
    }
    return low;
}

}  // namespace

TEST_CASE("flow stress, its slope and its work are those of the closed forms", "[solid][material]") {
    Material voce = metal();
    voce.flow.hardening = 0.02;
    voce.flow.saturation = 5e-4;
    voce.flow.saturation_rate = 200.0;
    CHECK(power_law().flow.stress(2.5e-3) == Approx(yield + 4e-3 * std::pow(2.5e-3, 0.3)).epsilon(1e-14));
    CHECK(voce.flow.stress(2.5e-3) == Approx(yield + 5e-5 + 5e-4 * (1.0 - std::exp(-0.5))).epsilon(1e-14));
    const Material table = stepped();
    for (const auto& [alpha, stress] :
         {std::pair{0.0, 1.0}, {1e-3, 1.25}, {2e-3, 1.5}, {3e-3, 1.5}, {5e-3, 2.25}, {1.0, 3.0}})
        CHECK(table.flow.stress(alpha) == Approx(stress * yield).epsilon(1e-13));
    CHECK(table.flow.slope(1e-3) == Approx(0.25).epsilon(1e-13));
    CHECK(table.flow.slope(3e-3) == 0.0);
    CHECK(table.flow.slope(1.0) == 0.0);
    CHECK(table.flow.work(7e-3) == Approx(yield * (1.25 * 2e-3 + 1.5 * 2e-3 + 2.25 * 2e-3 + 3.0 * 1e-3)).epsilon(1e-13));
    for (const Material& material : {power_law(), voce, table}) {
        constexpr double h = 1e-7;
        for (const double alpha : {0.5e-3, 3e-3, 5.5e-3}) {
            CHECK((material.flow.stress(alpha + h) - material.flow.stress(alpha - h)) / (2.0 * h) ==
                  Approx(material.flow.slope(alpha)).epsilon(1e-5).margin(1e-12));
            CHECK((material.flow.work(alpha + h) - material.flow.work(alpha - h)) / (2.0 * h) ==
                  Approx(material.flow.stress(alpha)).epsilon(1e-6));
        }
    }
    // Mild steel after Cowper and Symonds 1957: twice as strong at 40.4/s; copper after Johnson and Cook 1983: a factor of 1.23 at 1e4/s.
    Material steel = metal();
    steel.flow.cowper_symonds_rate = 40.4;
    steel.flow.cowper_symonds_exponent = 5.0;
    CHECK(steel.flow.rate_factor(40.4) == Approx(2.0).epsilon(1e-14));
    Material copper = metal();
    copper.flow.johnson_cook_rate = 1.0;
    copper.flow.johnson_cook_factor = 0.025;
    CHECK(copper.flow.rate_factor(1e4) == Approx(1.0 + 0.1 * std::log(10.0)).epsilon(1e-14));
    CHECK(copper.flow.rate_factor(0.5) == 1.0);
}

TEMPLATE_TEST_CASE_SIG("metal with a table of one slope moves as with linear hardening, whatever its kinematics",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    constexpr double modulus = 0.05;
    Material linear = metal();
    linear.flow.hardening = modulus;
    const Material table = tabled({{0.0, yield}, {0.01, yield + 0.01 * modulus}, {2.0, yield + 2.0 * modulus}});
    for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite})
        for (const auto& [name, mesh] : boxes<Dim>()) {
            CAPTURE(name, static_cast<int>(kinematics));
            const auto run = [&, &on = mesh](const Material& material) {
                auto scene = std::make_unique<TurningScene<Dim>>(on, alone<Dim>(material), std::vector<Motion<Dim>>(1), 0.6,
                                                                 kinematics, 0.01);
                scene->run(100);
                return scene;
            };
            const auto a = run(linear), b = run(table);
            CHECK(a->solid.dissipated().in_cells > 0.1 * a->ledger.largest_energy());
            CHECK(b->solid.dissipated().in_cells == Approx(a->solid.dissipated().in_cells).epsilon(1e-11));
            double off = 0.0, size = 0.0;
            for (std::size_t i = 0; i < a->memm.q().size(); ++i) {
                raise(off, std::abs(a->memm.q()[i] - b->memm.q()[i]));
                raise(size, std::abs(a->memm.q()[i]));
            }
            CHECK(off <= 1e-10 * size);
        }
}

TEST_CASE("pure shear ends on the flow stress of a table and of a power law, in one step or in many", "[solid][material]") {
    for (const Material& material : {stepped(), power_law()})
        for (const double strain : {0.5e-3, 1e-3, 3e-3, 4.5e-3, 7e-3, 2e-2}) {
            CAPTURE(strain, material.flow.power_hardening);
            const double alpha = flowed_in_shear(material, strain);
            const double expected = 2.0 * std::sqrt(3.0) * material.mu() * strain - 3.0 * material.mu() * alpha;
            for (const int steps : {1, 40}) {
                const Shear small = of_small(material, 1.0, strain, steps), finite = of_finite(material, 1.0, strain, steps);
                CHECK(small.von_mises == Approx(expected).epsilon(1e-11));
                CHECK(small.alpha == Approx(alpha).epsilon(1e-10).margin(1e-13));
                CHECK(finite.von_mises == Approx(expected).epsilon(1e-10));
                CHECK(finite.alpha == Approx(alpha).epsilon(1e-9).margin(1e-13));
            }
        }
}

TEST_CASE("a bar that is pulled slowly has the stress of its table, part by part", "[solid][material]") {
    for (const double plastic : {1e-3, 3e-3, 5e-3, 8e-3}) {
        const double stress = stepped().flow.stress(plastic);
        const Pulled bar = pull(stepped(), stress + plastic, 500.0);  // E is 1
        CAPTURE(plastic);
        CHECK(bar.stress == Approx(stress).epsilon(0.02));
        CHECK(bar.strain == Approx(plastic).epsilon(0.03));
        CHECK(bar.balance <= 1e-12);
    }
}

TEST_CASE("at a constant rate the stress is raised by the factor of the law of rates", "[solid][material]") {
    // In shear alpha grows by 2/sqrt(3) of the strain.
    for (const Material& material : {cowper_symonds(), johnson_cook()})
        for (const double rate : {1e-6, 1e-4, 1e-2, 1.0}) {
            CAPTURE(rate, material.flow.cowper_symonds_rate);
            const double expected = yield * material.flow.rate_factor(2.0 / std::sqrt(3.0) * rate);
            CHECK(expected >= yield);
            const Shear small = of_small(material, rate, 0.02, 400), finite = of_finite(material, rate, 0.02, 400);
            CHECK(small.von_mises == Approx(expected).epsilon(1e-10));
            CHECK(finite.von_mises == Approx(expected).epsilon(1e-10));
        }
    // With hardening, which a step of a rate sees at its start: the difference falls with the step.
    for (const Material& material : {cowper_symonds(power_law()), johnson_cook(stepped())}) {
        const auto expected = [&](double alpha) {  // what hardens stays elastic: it slows the flow
            double factor = 1.0;
            for (int i = 0; i < 50; ++i)
                factor = material.flow.rate_factor(2.0 / std::sqrt(3.0) * 1e-2 /
                                                   (1.0 + factor * material.flow.slope(alpha) / (3.0 * material.mu())));
            return factor * material.flow.stress(alpha);
        };
        for (const int steps : {500, 2000}) {
            const Shear small = of_small(material, 1e-2, 0.02, steps), finite = of_finite(material, 1e-2, 0.02, steps);
            CHECK(small.von_mises == Approx(expected(small.alpha)).epsilon(0.5 / steps));
            CHECK(finite.von_mises == Approx(expected(finite.alpha)).epsilon(0.5 / steps));
        }
    }
}

TEST_CASE("a bar that is pulled at a constant rate flows at the stress of that rate", "[solid][material]") {
    for (const Material& material : {cowper_symonds(), johnson_cook(metal(), 1e-7)}) {
        constexpr double strain = 8e-3, duration = 400.0;
        const double expected = yield * material.flow.rate_factor(strain / duration);
        const Pulled bar = pull(material, strain, duration);
        CHECK(expected > 1.2 * yield);
        CHECK(bar.stress == Approx(expected).epsilon(0.02));
        CHECK(bar.balance <= 1e-12);
    }
}

TEMPLATE_TEST_CASE_SIG(
    "metal that knows rates rings, dissipates in each step, keeps H~ + D, momentum and J~, and feeds no mode",
    "[solid][material]", ((int Dim), Dim), 2, 3) {
    for (const Material& material : {stepped(), cowper_symonds(power_law()), johnson_cook(stepped())})
        for (const Kinematics kinematics : {Kinematics::small, Kinematics::floating, Kinematics::finite})
            for (const auto& [name, mesh] : boxes<Dim>()) {
                CAPTURE(name, static_cast<int>(kinematics), material.flow.cowper_symonds_rate,
                        material.flow.johnson_cook_rate);
                const bool is_finite = kinematics == Kinematics::finite;
                const Motion<Dim> spinning{Vector<Dim>::Constant(0.003),
                                           some_spin<Dim>(kinematics == Kinematics::small ? 0.0 : 0.01)};
                TurningScene<Dim> scene(mesh, alone<Dim>(material), {spinning}, is_finite ? 0.4 : 0.9, kinematics,
                                        is_finite ? 0.01 : 0.03);
                const double fall = fall_of_dissipation<Dim>(scene, Dim == 2 ? 200 : 80, &dynamics::Losses::in_cells);
                const Drifts drifts = scene.drifts();
                CHECK(scene.solid.dissipated().in_cells > 0.02 * scene.ledger.largest_energy());
                CHECK(fall <= 0.0);
                CHECK(drifts.pseudo_energy <= 1e-13);
                CHECK(drifts.momentum <= 1e-13);
                if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
                if (kinematics == Kinematics::small) CHECK(drifts.parasitic <= 1e-13);
            }
}

TEST_CASE(
    "finite metal that knows rates flows from its first step on beside what it may touch, and keeps H~ + D where steps "
    "change",
    "[solid][material][contact]") {
    // Contact asks where faces end before the step is made: of a step of this length, also of the first.
    const auto mesh = mesh::structured_box<3>({0.0, 0.0, 0.0}, {1.0, 0.8, 0.6}, {4, 3, 3}, CellShape::hexahedron);
    for (const Material& material : {cowper_symonds(), johnson_cook(power_law(), 1e-4)}) {
        CAPTURE(material.flow.johnson_cook_rate);
        auto options = bodies<3>(1);
        options.materials = {material};
        options.kinematics = {Kinematics::finite};
        options.boundary.dirichlet = {{.group = "xmin"}};
        options.obstacles = {contact::plane_obstacle<3>(Vector<3>(1.02, 0.0, 0.0), -Vector<3>::Unit(0), 0.1)};
        solid::Solid<3> solid(mesh, options);
        const double dt = 0.4 * dynamics::stable_step(solid).dt;
        const auto p = solid::uniform_momentum<3>(solid, std::vector<Vector<3>>{{0.03, 0.01, 0.005}});
        dynamics::Memm<solid::Solid<3>> memm(solid, std::vector<double>(solid.size(), 0.0), p, dt);
        const auto start = dynamics::measure(memm, solid);
        for (int i = 0; i < 80; ++i) {
            memm.set_step(dt * (1.0 + 0.2 * std::sin(i)), dynamics::StepChange::keep);
            memm.step();
            if (i == 0) CHECK(solid.dissipated().in_cells > 0.0);
        }
        const auto end = dynamics::measure(memm, solid);
        CHECK(solid.contact().report().active_pairs_max > 0);
        CHECK(std::abs(end.pseudo_energy + end.dissipated - start.pseudo_energy - end.work) <= 1e-13 * start.kinetic);
    }
}

TEST_CASE("a step that turns fast flow back takes no energy out of what was dissipated, however far it goes",
          "[solid][material]") {
    const Material material = cowper_symonds();
    const double unit = yield / (2.0 * std::sqrt(3.0) * material.mu());  // of strain: von Mises's stress grows by sigma_y
    int n_flow = 0, n_wait = 0;
    for (int i = 0; i <= 80; ++i) {
        Sheared body(material);
        body.to(100.0 * unit, 1.0);  // fast
        const double before = body.solid.dissipated().in_cells;
        const double at_start = body.now().von_mises, alpha = body.now().alpha;
        REQUIRE(at_start > 2.5 * yield);
        body.to((100.0 - 3.0 * i) * unit, 1.0);
        CHECK(body.solid.dissipated().in_cells >= before);
        const bool flows = body.now().alpha > alpha;
        CHECK((body.solid.dissipated().in_cells > before) == flows);
        const double trial = at_start - 3.0 * i * yield;
        (flows ? n_flow : n_wait) += trial < -yield ? 1 : 0;
        if (!flows) CHECK(body.now().von_mises == Approx(trial).epsilon(1e-10));
    }
    CHECK(n_flow > 0);  // on the other side
    CHECK(n_wait > 0);
}

TEMPLATE_TEST_CASE_SIG("the stress of a step at a rate is the slope of what the step stores and dissipates",
                       "[solid][material]", ((int Dim), Dim), 2, 3) {
    constexpr double h = 1e-6;
    for (const Material& material : {cowper_symonds(power_law()), johnson_cook(stepped()), johnson_cook(power_law())})
        for (const unsigned seed : {1u, 2u, 3u})
            for (const double dt : {1e-2, 10.0}) {
                const auto law = solid::inelastic_law<Dim>(material);
                std::vector<double> memory = law->initial_memory();
                (void)law->advance(some_gradient<Dim>(seed, 0.05), dt, memory);
                const Matrix<Dim> g = some_gradient<Dim>(seed + 10, 0.1), d = some_gradient<Dim>(seed + 20, 1.0);
                const auto step = [&](const Matrix<Dim>& at) {
                    auto changed = memory;
                    return law->advance(at, dt, changed).response;
                };
                const double slope = (step(g + h * d).energy - step(g - h * d).energy) / (2.0 * h);
                CHECK(std::abs(step(g).stress.cwiseProduct(d).sum() - slope) <= 1e-8);
                const std::array changes{d};
                std::array<Matrix<Dim>, 1> changed;
                REQUIRE(law->advanced_changes(g, dt, memory, changes, changed));
                CHECK((changed[0] - (step(g + h * d).stress - step(g - h * d).stress) / (2.0 * h)).norm() <= 1e-7);
            }
}

TEST_CASE("what is no way to harden is refused by name", "[solid][material]") {
    const auto refused = [](const Material& material, const char* name, const char* why) {
        CHECK_THROWS_WITH(solid::check(material, 0), Catch::Contains(name) && Catch::Contains(why));
    };
    CHECK_NOTHROW(solid::check(stepped(), 0));
    CHECK_NOTHROW(solid::check(cowper_symonds(power_law()), 0));
    refused(tabled({{1e-3, yield}}), "hardening_table", "begin at the plastic strain 0");
    refused(tabled({{0.0, yield}, {0.0, 2.0 * yield}}), "row 2", "grow");
    refused(tabled({{0.0, yield}, {1.0, 0.5 * yield}}), "row 2", "softens");
    Material material = stepped();
    material.flow.yield_stress = 2.0 * yield;
    refused(material, "row 1", "yield_stress");
    material = stepped();
    material.flow.hardening = 0.1;
    refused(material, "hardening", "beside hardening_table");
    material = stepped();
    material.law = MaterialLaw::st_venant_kirchhoff;
    material.flow.yield_stress = 0.0;
    refused(material, "hardening_table", "not j2");
    material = power_law();
    material.flow.power_exponent = 0.0;
    refused(material, "power_exponent", "above 0 where power_hardening is");
    material = cowper_symonds();
    material.flow.cowper_symonds_exponent = 0.0;
    refused(material, "cowper_symonds_exponent", "where cowper_symonds_rate is");
    material = johnson_cook(cowper_symonds());
    refused(material, "johnson_cook_rate", "one law of rates");
}
