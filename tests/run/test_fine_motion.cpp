// Motion from cell to cell, which neither H~ nor H - H~ sees.
#include "abut/run/watch/fine_motion.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/result.hpp"
#include "abut/run/words/warnings.hpp"
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

/// Fine and whole kinetic energy [J].
struct Energies {
    double fine = 0.0, kinetic = 0.0;
    [[nodiscard]] double share() const { return fine / kinetic; }
};

/// Of a field of velocities.
template <int Dim, class Field>
Energies energies_of(const mesh::Mesh<Dim>& mesh, const Field& field) {
    solid::SolidOptions<Dim> options;
    options.materials = {{.young = 1.0, .poisson = 0.3, .density = 2.0}};
    const solid::Solid<Dim> solid(mesh, options);
    std::vector<Vector<Dim>> velocity;
    double kinetic = 0.0;
    for (std::size_t c = 0; c < solid.size() / Dim; ++c) {
        velocity.push_back(field(solid.rest_positions()[c]));
        kinetic += 0.5 * solid.masses()[c] * velocity.back().squaredNorm();
    }
    return {run::FineMotion<Dim>(mesh).energy(mesh, options.materials, velocity), kinetic};
}

/// Bricks of these lengths in a row, and a second row on top: those at the ends have no neighbours on both sides.
mesh::Mesh<2> rows(const std::vector<double>& lengths) {
    mesh::CellSoup<2> soup;
    soup.name = "rows";
    soup.body_names = {"rows"};
    double x = 0.0;
    for (std::size_t i = 0; i <= lengths.size(); ++i) {
        for (const double y : {0.0, size, 2.0 * size}) soup.vertices.emplace_back(x, y);
        if (i == lengths.size()) break;
        for (const auto below : {static_cast<std::int32_t>(3 * i), static_cast<std::int32_t>(3 * i + 1)}) {
            soup.cell_vertices.append(std::array{below, below + 3, below + 4, below + 1});
            soup.cell_shape.push_back(mesh::CellShape::quadrangle);
            soup.cell_body.push_back(0);
        }
        x += lengths[i];
    }
    return mesh::build_mesh<2>(std::move(soup));
}

std::vector<double> equal_lengths(int n) { return std::vector<double>(static_cast<std::size_t>(n), size); }

/// Bending of a free bar of length 1 in its first mode.
double bent(double x) {
    constexpr double k = 4.730040745, ratio = 0.982502215;
    return std::cosh(k * x) + std::cos(k * x) - ratio * (std::sinh(k * x) + std::sin(k * x));
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
    const run::FineMotion<2> motion(mesh);
    Swing swing;
    while (swing.steps < 5000 && swing.share <= run::large_fine_share) {
        const double part = static_cast<double>(random()) / std::mt19937::max();
        if (jumps) static_cast<void>(run.set_step((0.3 + 0.4 * part) * stable, dynamics::StepChange::keep));
        run.step();
        if (++swing.steps % 5 != 0) continue;
        const double fine = motion.energy(mesh, options.materials, run.solid().cells().velocity(run.memm().p_after()));
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
    const auto [fine, kinetic] = energies_of<Dim>(box<Dim>(), wave);
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
    const auto [fine, kinetic] = energies_of<Dim>(box<Dim>(), affine);
    CHECK(fine < 1e-28 * kinetic);
}

TEST_CASE(
    "where cells grow along a row a linear field has a part of the change of their size in fine motion, below the limit",
    "[run][fine_motion]") {
    const double growth = GENERATE(1.1, 1.3);
    std::vector<double> lengths;
    for (int i = 0; i < 12; ++i) lengths.push_back(size * std::pow(growth, i));
    const mesh::Mesh<2> mesh = rows(lengths);
    double fine = 0.0, seen = 0.0, kinetic = 0.0;
    for (std::size_t i = 0; i < lengths.size(); ++i) {
        double x = 0.5 * lengths[i];
        for (std::size_t j = 0; j < i; ++j) x += lengths[j];
        const double half_mass = 2.0 * lengths[i] * size;  // of both cells, of a density of 2
        kinetic += half_mass * x * x;
        if (i == 0 || i + 1 == lengths.size()) continue;
        const double off = (lengths[i + 1] - lengths[i - 1]) / 4.0;  // of the mean place of both neighbours from the cell
        seen += half_mass * x * x;
        fine += half_mass * (0.5 * off) * (0.5 * off);
    }
    const Energies found = energies_of<2>(mesh, [](const Vector<2>& x) { return Vector<2>(x.x(), 0.0); });
    CHECK(found.kinetic == Approx(kinetic));
    CHECK(found.fine == Approx(fine * kinetic / seen));
    CHECK(found.share() < 0.01 * run::large_fine_share);
}

TEMPLATE_TEST_CASE_SIG("bodies of simplices that fly, turn and stretch evenly stay far below the limit",
                       "[run][fine_motion]", ((int Dim), Dim), 2, 3) {
    mesh::BoxOptions<Dim> options;
    options.upper = Vector<Dim>::Ones();
    options.size = Dim == 2 ? 0.1 : 0.15;
    const mesh::Mesh<Dim> mesh = mesh::box<Dim>(options);
    const double speed = GENERATE(0.0, 3.0);
    const auto motion = [&](const Vector<Dim>& x) {
        Vector<Dim> v = Vector<Dim>::Constant(speed);
        for (int i = 0; i < Dim; ++i) v[i] += (0.5 + i) * (x[(i + 1) % Dim] - 0.5) - 0.7 * (x[i] - 0.5);
        return v;
    };
    const Energies found = energies_of<Dim>(mesh, motion);
    CAPTURE(found.share());
    CHECK(found.fine > 0.0);
    CHECK(found.share() < 0.1 * run::large_fine_share);
    const auto zigzag = [&](const Vector<Dim>& x) {
        return Vector<Dim>(Vector<Dim>::Ones() * std::cos(3.0 / options.size * x.sum()));
    };
    CHECK(energies_of<Dim>(mesh, zigzag).share() > run::large_fine_share);
}

TEST_CASE("fine motion is at most the kinetic energy of a body, and none in bodies of fewer than six cells across",
          "[run][fine_motion]") {
    const auto in_turn = [](const Vector<2>& x) {  // fast, slow, fast: cells with two neighbours hardly move
        return Vector<2>(static_cast<int>(x.x() / size) % 2 == 0 ? 1.0 : -0.01, 0.0);
    };
    CHECK(energies_of<2>(rows(equal_lengths(3)), in_turn).fine == 0.0);
    const Energies nine = energies_of<2>(rows(equal_lengths(9)), in_turn);
    CHECK(nine.fine > run::large_fine_share * nine.kinetic);
    CHECK(nine.fine <= nine.kinetic);
    const auto ends = [](const Vector<2>& x) { return Vector<2>(x.x() < size || x.x() > 5 * size ? 1.0 : -0.01, 0.0); };
    const Energies slow_inside = energies_of<2>(rows(equal_lengths(6)), ends);
    CHECK(slow_inside.fine <= slow_inside.kinetic);
}

TEST_CASE("the first modes of the shortest bars that are looked at stay below the limit", "[run][fine_motion]") {
    const int n = GENERATE(3, 4, 5, 6, 7, 10);
    const auto along = [&](const Vector<2>& x) { return Vector<2>(std::cos(M_PI * x.x() / (n * size)), 0.0); };
    const auto across = [&](const Vector<2>& x) { return Vector<2>(0.0, bent(x.x() / (n * size))); };
    CAPTURE(n);
    const Energies stretching = energies_of<2>(rows(equal_lengths(n)), along);
    const Energies bending = energies_of<2>(rows(equal_lengths(n)), across);
    if (n < 6) {
        CHECK(stretching.fine + bending.fine == 0.0);
        return;
    }
    CHECK(stretching.share() == Approx(std::pow(std::sin(0.5 * M_PI / n), 4)));
    CHECK(stretching.share() < 0.1 * run::large_fine_share);
    CHECK(bending.share() > 0.0);
    CHECK(bending.share() < 0.6 * run::large_fine_share);
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
    result.energy.accounts.energy_in_play = 2.0;
    result.energy.fine_max = 2.0 * run::large_fine_share;
    CHECK(run::warnings_after(result).empty());
    result.energy.fine_max = 1.0;
    const auto warnings = run::warnings_after(result);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].kind == run::WarningKind::fine_motion);
    CHECK(warnings[0].value == 0.5);
    CHECK(warnings[0].threshold == run::large_fine_share);
    CHECK(warnings[0].text.find("stiffness_damping") != std::string::npos);
}
