// Rayleigh's damping and the viscosity of shocks, of bodies of all kinematics.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/finite_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;
using solid::Material;
using solid::MaterialLaw;

namespace {

template <int Dim>
double by_rates(const solid::Solid<Dim>& solid) {
    return solid.dissipated().by_damping + solid.dissipated().by_viscosity;
}

constexpr std::array kinematics_that_deform{Kinematics::small, Kinematics::floating, Kinematics::finite};

/// Of cells of size 1 and speed of waves 1, each kind at a time.
std::vector<Material> damped_materials() {
    const Material elastic{.young = 1.0, .poisson = 0.3, .density = 1.0};
    std::vector<Material> all(3, elastic);
    all[0].damping.stiffness = 0.02;
    all[1].damping.linear_viscosity = 0.06;
    all[1].damping.quadratic_viscosity = 1.2;
    all[2].damping.stiffness = 0.01;
    all[2].damping.linear_viscosity = 0.2;
    return all;
}

/// A bar along x without contraction across, on which waves run as on a line.
mesh::Mesh<2> bar(int cells, int rows = 2) {
    return mesh::structured_box<2>({0.0, 0.0}, {1.0, static_cast<double>(rows) / cells}, {cells, rows},
                                   mesh::CellShape::quadrangle, "bar");
}

constexpr double pi = std::numbers::pi;

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "noise in damped bodies of all kinematics dies, and keeps H~ + D, momentum and J~, D growing in each step",
    "[solid][damping]", ((int Dim), Dim), 2, 3) {
    for (const Material& material : damped_materials())
        for (const Kinematics kinematics : kinematics_that_deform)
            for (const auto& [name, mesh] : boxes<Dim>()) {
                CAPTURE(name, static_cast<int>(kinematics), material.damping.stiffness);
                const double spin = kinematics == Kinematics::small ? 0.0 : 0.02;
                const Motion<Dim> spinning{Vector<Dim>::Constant(0.01), some_spin<Dim>(spin)};
                TurningScene<Dim> scene(mesh, alone<Dim>(material), {spinning}, 0.6, kinematics, 0.01);
                const double fall =
                    fall_of_dissipation<Dim>(scene, 200, &dynamics::Losses::by_damping, &dynamics::Losses::by_viscosity);
                const Drifts drifts = scene.drifts();
                CHECK(by_rates(scene.solid) > 1e-3 * scene.ledger.largest_energy());
                CHECK(fall <= 0.0);
                CHECK(scene.ledger.entries().back().losses.total() == scene.solid.dissipated().total());
                CHECK(drifts.pseudo_energy <= 1e-13);
                CHECK(drifts.momentum <= 1e-13);
                if (kinematics != Kinematics::small) CHECK(drifts.pseudo_moment <= 1e-13);
            }
}

TEST_CASE("damping and viscosity are booked apart, in columns of the ledger by name whose sum is what was dissipated",
          "[solid][damping][ledger]") {
    const auto mesh = boxes<2>()[0].mesh;
    for (const bool damped : {false, true})
        for (const bool viscous : {false, true}) {
            Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
            material.damping.stiffness = damped ? 0.02 : 0.0;
            material.damping.linear_viscosity = viscous ? 0.2 : 0.0;
            TurningScene<2> scene(mesh, alone<2>(material), {moving<2>(Vector<2>::Zero())}, 0.6, Kinematics::small, 0.01);
            scene.run(50);
            const auto& entry = scene.ledger.entries().back();
            CHECK((entry.losses.by_damping > 0.0) == damped);
            CHECK((entry.losses.by_viscosity > 0.0) == viscous);
            const auto names = dynamics::ledger_columns<2>();
            const auto values = dynamics::ledger_values<2>(entry);
            const auto of = [&](const char* name) {
                const auto found = std::ranges::find(names, name);
                REQUIRE(found != names.end());
                return values[static_cast<std::size_t>(found - names.begin())];
            };
            CHECK(of("dissipated_by_damping") == scene.solid.dissipated().by_damping);
            CHECK(of("dissipated_by_viscosity") == scene.solid.dissipated().by_viscosity);
            double sum = 0.0;
            for (const dynamics::Loss& loss : dynamics::all_losses) sum += of(loss.name);
            CHECK(of("dissipated") == sum);
            CHECK(scene.ledger.pseudo_energy_drift() <= 1e-13 * scene.ledger.largest_energy());
        }
}

TEMPLATE_TEST_CASE_SIG("damped bodies collide and keep H~ + D and momentum, under both laws of contact", "[solid][damping]",
                       ((int Dim), Dim), 2, 3) {
    for (const Material& material : damped_materials()) {
        const auto scene = spinning_collision<Dim>(finite_of<Dim>(material, 2));
        scene->run(steps_of_collision<Dim>);
        check_collision<Dim>(*scene);
        CHECK(by_rates(scene->solid) > 1e-4 * scene->ledger.largest_energy());
        for (const solid::ContactLaw law : {solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential}) {
            auto options = bodies<Dim>(2);
            options.materials.assign(2, material);
            options.law = law;
            std::vector<Motion<Dim>> motion(2);
            for (int body = 0; body < 2; ++body) {
                if constexpr (Dim == 2)
                    motion[body].velocity = disc_velocities[body];
                else
                    motion[body].velocity = box_velocities[body];
            }
            mesh::Mesh<Dim> mesh;
            if constexpr (Dim == 2)
                mesh = two_discs(0.5);
            else
                mesh = two_boxes(3);
            TurningScene<Dim> small(mesh, options, motion, 0.6, Kinematics::small);
            small.run(steps_of_collision<Dim>);
            CHECK(small.solid.contact().report().active_pairs_max > 0);
            CHECK(small.solid.contact().report().missed_contacts == 0);
            CHECK(by_rates(small.solid) > 1e-4 * small.ledger.largest_energy());
            CHECK(small.drifts().pseudo_energy <= 1e-12);
            CHECK(small.drifts().momentum <= 1e-13);
        }
    }
}

TEST_CASE("a drag of the mass slows a body that flies by exp(-alpha t), whatever the step and the kinematics",
          "[solid][damping]") {
    for (const auto& [alpha, dt] : {std::array{0.3, 0.02}, std::array{2.0, 0.1}, std::array{40.0, 0.1}})
        for (const Kinematics kinematics : kinematics_that_deform) {
            CAPTURE(alpha, dt, static_cast<int>(kinematics));
            Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
            material.damping.mass = alpha;
            TurningScene<2> scene(bar(4, 4), alone<2>(material), {moving<2>({0.1, 0.05})}, -dt, kinematics);
            const double first = scene.view().momentum(0).norm();
            scene.run(5);
            CHECK(scene.view().momentum(0).norm() / first ==
                  Approx(std::exp(-5.0 * alpha * dt)).epsilon(1e-9).margin(1e-13));
            const double energy = scene.ledger.largest_energy();
            scene.run(100);
            CHECK(scene.drifts().pseudo_energy <= 1e-13);
            CHECK(by_rates(scene.solid) > 0.5 * energy);
        }
}

TEST_CASE("the first mode of a free bar dies at (alpha + beta omega^2)/2, as Rayleigh says", "[solid][damping]") {
    constexpr int cells = 40;
    for (const auto& [alpha, beta] : {std::array{0.2, 0.0}, std::array{0.0, 0.02}, std::array{0.1, 0.01}})
        for (const Kinematics kinematics : kinematics_that_deform) {
            Material material{.young = 1.0, .poisson = 0.0, .density = 1.0};
            material.damping.mass = alpha;
            material.damping.stiffness = beta;
            const auto mesh = bar(cells);
            auto options = alone<2>(material);
            options.kinematics = {kinematics};
            solid::Solid<2> solid(mesh, options);
            std::vector<double> q(solid.size()), p(solid.size(), 0.0);
            for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
                q[2 * static_cast<std::size_t>(c)] = 1e-4 * std::cos(pi * mesh.cell_centroid[c][0]);
            const double dt = 0.5 * dynamics::stable_step(solid).dt;
            dynamics::Memm memm(solid, q, p, dt);
            const double rate = 0.5 * (alpha + beta * pi * pi), omega = std::sqrt(pi * pi - rate * rate);
            const int steps = static_cast<int>(std::lround(3.0 * 2.0 * pi / omega / dt));  // three times there and back
            for (int i = 0; i < steps; ++i) memm.step();
            const double time = steps * dt;
            const double expected =
                std::exp(-rate * time) * (std::cos(omega * time) + rate / omega * std::sin(omega * time));
            CAPTURE(alpha, beta, static_cast<int>(kinematics));
            CHECK(memm.q()[0] / q[0] == Approx(expected).epsilon(0.01));
        }
}

TEST_CASE("work that supports do on a damped body is what it stores and dissipates", "[solid][damping]") {
    Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    material.damping.stiffness = 0.05;
    material.damping.linear_viscosity = 0.1;
    auto options = alone<2>(material);
    options.kinematics = {Kinematics::small};
    const auto moved = [](double t, const Vector<2>&) -> Vector<2> {
        return {0.01 * std::sin(3.0 * t), 0.005 * std::sin(2.0 * t)};
    };
    options.boundary.dirichlet = {{.group = "xmin", .history = moved}};
    options.boundary.traction = {{.group = "xmax", .history = [](double t, const Vector<2>&) -> Vector<2> {
                                      return {0.002 * std::sin(t), 0.0};
                                  }}};
    TurningScene<2> scene(bar(8, 4), options, {moving<2>(Vector<2>::Zero())}, 0.8, Kinematics::small);
    scene.run(2000);
    CHECK(by_rates(scene.solid) > scene.ledger.largest_energy());
    CHECK(scene.drifts().pseudo_energy <= 1e-12);
}

TEST_CASE("what is not made for damped bodies is refused by name", "[solid][damping]") {
    Material material{.young = 1.0, .poisson = 0.3, .density = 1.0};
    material.damping.stiffness = 0.01;
    const auto mesh = bar(4);
    const auto refuses = [&](const solid::SolidOptions<2>& options, const std::string& words) {
        REQUIRE_THROWS_WITH(solid::Solid<2>(mesh, options), Catch::Contains(words));
    };
    auto options = alone<2>(material);
    options.finite.mean_force = solid::MeanForce::discrete_gradient;
    refuses(options, "discrete_gradient");
    options = alone<2>(material);
    options.kinematics = {Kinematics::small};
    options.precision = solid::Precision::single_precision;
    refuses(options, "double precision");
    options = alone<2>(material);
    options.kinematics = {Kinematics::rigid};
    refuses(options, "rigid");
    options = alone<2>(material);
    options.materials[0].damping.stiffness = -1.0;
    refuses(options, "stiffness_damping");
    solid::Solid<2> solid(mesh, alone<2>(material));
    std::vector<double> q(solid.size(), 0.0), force(solid.size());
    REQUIRE_THROWS_WITH(solid.end_force(q, q, 0.0, 0.1, force), Catch::Contains("memm"));
}

/// A material without contraction across whose principal stresses are P = (1 - stretch^-3)/3, c = 1: it stiffens as a gas does.
class Stiffening final : public solid::StoredEnergy<2> {
public:
    static double energy_of(double stretch) { return stretch / 3.0 + 1.0 / (6.0 * stretch * stretch) - 0.5; }
    static double stress_of(double stretch) { return (1.0 - std::pow(stretch, -3.0)) / 3.0; }
    [[nodiscard]] solid::Response<2> at(const Matrix<2>& g) const override {
        const Matrix<2> f = Matrix<2>::Identity() + g;
        const SymmetricEigen<2> axes = symmetric_eigen(f.transpose() * f);
        solid::Response<2> response{.energy = 0.0, .stress = Matrix<2>::Zero()};
        for (int i = 0; i < 2; ++i) {
            const double stretch = std::sqrt(axes.values[i]);
            response.energy += energy_of(stretch);
            response.stress += stress_of(stretch) / stretch * f * axes.vectors.col(i) * axes.vectors.col(i).transpose();
        }
        return response;
    }
};

// Halves of a bar of it meet at +-v: Rankine and Hugoniot have v^2/(1 - F) = -P(F) for what is squeezed, and fronts that leave at v/(1 - F)
// as seen on the material.
TEST_CASE("viscosity makes a shock of halves that meet: stress, place and energy are those of Rankine and Hugoniot",
          "[solid][damping]") {
    constexpr double v_0 = 0.2;
    double f = 1.0;  // by bisection
    for (double low = 0.3, high = 0.99; high - low > 1e-14;) {
        f = 0.5 * (low + high);
        (v_0 * v_0 / (1.0 - f) + Stiffening::stress_of(f) > 0.0 ? high : low) = f;
    }
    CHECK(f == Approx(0.83409).margin(1e-5));  // of a table
    const double speed = v_0 / (1.0 - f);
    const double lost_rate =
        2.0 * speed * (0.5 * v_0 * v_0 - Stiffening::energy_of(f));  // of both fronts, over a unit of area
    struct Shock {
        double overshoot, front, lost, balance;
    };
    const auto run = [&](int cells, double linear, double quadratic) {
        Material material{.young = 1.0, .poisson = 0.0, .density = 1.0};
        material.damping.linear_viscosity = linear;
        material.damping.quadratic_viscosity = quadratic;
        const auto mesh = bar(cells);
        auto options = alone<2>(material);
        options.finite.stored_energy = {std::make_shared<Stiffening>()};
        solid::Solid<2> solid(mesh, options);
        std::vector<double> q(solid.size(), 0.0), p(solid.size());
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
            p[2 * static_cast<std::size_t>(c)] = mesh.cell_measure[c] * (mesh.cell_centroid[c][0] < 0.5 ? v_0 : -v_0);
        dynamics::Memm memm(solid, q, p, 0.5 / cells);
        dynamics::Ledger<2> ledger;
        ledger.record(dynamics::measure(memm, solid));
        while (memm.time() < 0.2) memm.step();
        ledger.record(dynamics::measure(memm, solid));
        (void)solid.potential(memm.q());
        const double time = memm.time();
        double peak = 0.0, front = 1.0;
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            const double stretch = 1.0 + solid.cells().displacement_gradient(c, memm.q())(0, 0),
                         x = mesh.cell_centroid[c][0];
            if (std::abs(x - 0.5) > 0.05) raise(peak, Stiffening::stress_of(stretch) / Stiffening::stress_of(f) - 1.0);
            if (1.0 - stretch > 0.5 * (1.0 - f)) front = std::min(front, x - 0.5 / cells);
        }
        const double area = 2.0 / cells;
        return Shock{peak, (0.5 - front) / (speed * time), solid.dissipated().total() / (lost_rate * time * area),
                     ledger.pseudo_energy_drift() / ledger.largest_energy()};
    };
    const Shock without = run(400, 0.0, 0.0), coarse = run(200, 0.25, 2.0), fine = run(400, 0.25, 2.0);
    CAPTURE(coarse.overshoot, coarse.front, coarse.lost, fine.overshoot, fine.front, fine.lost, without.overshoot);
    CHECK(without.overshoot > 0.5);
    for (const Shock& shock : {coarse, fine}) {
        CHECK(shock.overshoot < 0.04);
        CHECK(shock.front == Approx(1.0).margin(0.01));
        CHECK(shock.balance <= 1e-13);
    }
    // The start, in which all is jump, dissipates more: order 1.
    CHECK(fine.lost > 1.0);
    CHECK(fine.lost < 1.2);
    CHECK(fine.lost - 1.0 < 0.55 * (coarse.lost - 1.0));
}

TEST_CASE("a damped body that is brought to rest goes on as one that begins there, whatever it did before",
          "[solid][damping]") {
    for (const Material& material : damped_materials())
        for (const Kinematics kinematics : kinematics_that_deform) {
            CAPTURE(static_cast<int>(kinematics), material.damping.stiffness);
            const auto mesh = boxes<2>()[0].mesh;
            TurningScene<2> rests(mesh, alone<2>(material), {moving<2>({0.01, 0.0})}, 0.6, kinematics, 0.01);
            rests.run(20);
            rests.memm.bring_to_rest();
            solid::Solid<2> begins(mesh, TurningScene<2>::with(alone<2>(material), {kinematics}));
            const std::vector<double> at(rests.memm.q().begin(), rests.memm.q().end());
            dynamics::Memm<solid::Solid<2>> memm(begins, at, std::vector<double>(at.size(), 0.0), rests.memm.dt());
            for (int i = 0; i < 5; ++i) {
                rests.memm.step();
                memm.step();
            }
            double largest = 0.0, apart = 0.0;
            for (std::size_t i = 0; i < at.size(); ++i) {
                raise(largest, std::abs(memm.q()[i] - at[i]));
                raise(apart, std::abs(memm.q()[i] - rests.memm.q()[i]));
            }
            CHECK(largest > 0.0);
            CHECK(apart <= 1e-12 * largest);
        }
}
