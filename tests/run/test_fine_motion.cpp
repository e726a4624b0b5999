// Motion from cell to cell, which neither H~ nor H - H~ sees.
#include "abut/run/fine_motion.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/warnings.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/stepped_run.hpp"

namespace {

using namespace abut;

constexpr double size = 0.1;

template <int Dim>
mesh::Mesh<Dim> box() {
    if constexpr (Dim == 2)
        return mesh::structured_box<2>({0.0, 0.0}, {7 * size, 5 * size}, {7, 5}, mesh::CellShape::quadrangle);
    else
        return mesh::structured_box<3>({0.0, 0.0, 0.0}, {7 * size, 5 * size, 4 * size}, {7, 5, 4},
                                       mesh::CellShape::hexahedron);
}

/// Fine and whole kinetic energy of a field of velocities.
template <int Dim, class Field>
std::pair<double, double> energies_of(const Field& field) {
    const mesh::Mesh<Dim> mesh = box<Dim>();
    solid::SolidOptions<Dim> options;
    options.materials = {{.young = 1.0, .poisson = 0.3, .density = 2.0}};
    const solid::Solid<Dim> solid(mesh, options);
    dynamics::IntegratorState state;
    state.q.assign(solid.size(), 0.0);
    double kinetic = 0.0;
    for (std::size_t c = 0; c < solid.size() / Dim; ++c) {
        const Vector<Dim> v = field(solid.rest_positions()[c]);
        kinetic += 0.5 * solid.masses()[c] * v.squaredNorm();
        for (int i = 0; i < Dim; ++i) state.p_after.push_back(solid.masses()[c] * v[i]);
    }
    state.p_before = state.p_after;
    return {run::fine_kinetic_energy<Dim>(dynamics::RunView<Dim>(state), solid), kinetic};
}

/// Motion of a free bar that began to swing in its first mode along its axis, until its share of fine motion is above what
/// is safe, or for 5,000 steps.
struct Swing {
    double share = 0.0;  // of the energy, the largest seen
    double drift = 0.0;  // of H~, over the energy, then
    std::int64_t steps = 0;
};

Swing swung(bool jumps) {
    const int n = 40;
    const mesh::Mesh<2> mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 2.0 / n}, {n, 2}, mesh::CellShape::quadrangle);
    solid::SolidOptions<2> options;
    options.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    auto solid = std::make_unique<solid::Solid<2>>(mesh, options);
    const double stable = dynamics::stable_step(*solid).dt;
    const std::vector<double> rest(solid->size(), 0.0);
    std::vector<double> p(rest.size(), 0.0);
    for (std::size_t c = 0; c < solid->masses().size(); ++c)
        p[2 * c] = solid->masses()[c] * std::cos(M_PI * solid->rest_positions()[c].x());
    solid::SteppedRun<2> run(std::move(solid), rest, p, 0.5 * stable, {.restart = 25});
    const double energy = run.memm().kinetic_energy(), start = run.memm().pseudo_energy();
    std::mt19937 random(1);
    Swing swing;
    while (swing.steps < 5000 && swing.share <= run::large_fine_share) {
        const double part = static_cast<double>(random()) / std::mt19937::max();
        if (jumps) static_cast<void>(run.set_step((0.3 + 0.4 * part) * stable, dynamics::StepChange::keep));
        run.step();
        if (++swing.steps % 5 != 0) continue;
        const double fine = run::fine_kinetic_energy<2>(dynamics::RunView<2>(run.memm()), run.solid());
        swing.share = std::max(swing.share, fine / energy);
        swing.drift = std::abs(run.memm().pseudo_energy() - start) / energy;
    }
    return swing;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a wave of kh has sin^4(kh/2) of its energy in fine motion", "[run][fine_motion]", ((int Dim), Dim),
                       2, 3) {
    const double kh = GENERATE(0.1, 1.0, 0.5 * M_PI, 3.0, M_PI);
    const auto wave = [&](const Vector<Dim>& x) {
        return Vector<Dim>(Vector<Dim>::Ones() * std::cos(kh * x.sum() / size + 0.3));
    };
    CAPTURE(kh);
    const auto [fine, kinetic] = energies_of<Dim>(wave);
    const double response = std::pow(std::sin(0.5 * kh), 4);
    CHECK(fine == Approx(response * kinetic).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("bodies that fly, turn and stretch evenly have no fine motion", "[run][fine_motion]",
                       ((int Dim), Dim), 2, 3) {
    const auto affine = [](const Vector<Dim>& x) {
        Vector<Dim> v = Vector<Dim>::Constant(3.0);
        for (int i = 0; i < Dim; ++i) v[i] += (0.5 + i) * x[(i + 1) % Dim] - 0.7 * x[i];
        return v;
    };
    const auto [fine, kinetic] = energies_of<Dim>(affine);
    CHECK(fine < 1e-28 * kinetic);
}

TEST_CASE("steps that jump pump the upper half of the modes, which H~ does not show, and a constant step does not",
          "[run][fine_motion]") {
    const Swing pumped = swung(true), smooth = swung(false);
    CAPTURE(pumped.steps, pumped.share, smooth.share);
    CHECK(pumped.share > run::large_fine_share);
    CHECK(pumped.drift < 1e-10);
    CHECK(smooth.steps == 5000);
    CHECK(smooth.share < 1e-2 * run::large_fine_share);
}

TEST_CASE("fine motion above its share of the energy in play is a warning with its remedy", "[run][warnings]") {
    run::RunResult<2> result;
    result.accounts.energy_in_play = 2.0;
    result.fine_energy_max = 2.0 * run::large_fine_share;
    CHECK(run::warnings_after(result).empty());
    result.fine_energy_max = 1.0;
    const auto warnings = run::warnings_after(result);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].kind == run::WarningKind::fine_motion);
    CHECK(warnings[0].value == 0.5);
    CHECK(warnings[0].threshold == run::large_fine_share);
    CHECK(warnings[0].text.find("stiffness_damping") != std::string::npos);
}
