// Bodies in floating frames: what turns keeps energy, momentum and angular momentum, and does not grow.
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/dynamics/point_system.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

using std::numbers::pi;

/// How a body moves at the start.
template <int Dim>
struct Motion {
    Vector<Dim> velocity = Vector<Dim>::Zero();
    AxialVector<Dim> spin = AxialVector<Dim>::Zero();
};

template <int Dim>
std::vector<double> momentum_of(const solid::Solid<Dim>& solid, const std::vector<Motion<Dim>>& motion) {
    std::vector<double> p(solid.size());
    const auto points = solid.rest_positions();
    std::vector<Vector<Dim>> centre(motion.size(), Vector<Dim>::Zero());
    std::vector<double> mass(motion.size(), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::int32_t body = solid.body_of_points()[i];
        centre[body] += solid.masses()[i] * points[i];
        mass[body] += solid.masses()[i];
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::int32_t body = solid.body_of_points()[i];
        const Vector<Dim> arm = points[i] - centre[body] / mass[body];
        vectors<Dim>(p)[i] =
            solid.masses()[i] * (motion[body].velocity + dynamics::turning_velocity<Dim>(motion[body].spin, arm));
    }
    return p;
}

/// What a run leaves of what it should keep.
struct Drifts {
    double pseudo_energy = 0.0;   // less the work, over the largest energy
    double energy_excess = 0.0;   // H - H~, the same
    double momentum = 0.0;        // over sum |p|
    double pseudo_moment = 0.0;   // J~ over sum |x × p|
    double parasitic = 0.0;       // |e|/m
};

/// A run of floating bodies under MEMM.
template <int Dim>
struct TurningScene {
    mesh::Mesh<Dim> mesh;
    solid::Solid<Dim> solid;
    dynamics::Memm<solid::Solid<Dim>> memm;
    dynamics::Ledger<Dim> ledger;
    AxialVector<Dim> moment_start;
    double sum_of_moments, sum_of_momenta;
    double moment_drift = 0.0;

    TurningScene(mesh::Mesh<Dim> made, solid::SolidOptions<Dim> options, const std::vector<Motion<Dim>>& motion, double cfl,
                 double noise = 0.0)
        : mesh(std::move(made)),
          solid(mesh, floating(std::move(options))),
          memm(solid, std::vector<double>(solid.size(), 0.0), noisy(momentum_of(solid, motion), noise),
               cfl * dynamics::stable_step(solid).dt / solid.step_margin()) {
        sum_of_moments = sum_of_momenta = 0.0;
        for (std::size_t i = 0; i < solid.masses().size(); ++i) {
            const Vector<Dim> p = view().momentum(static_cast<std::ptrdiff_t>(i));
            sum_of_momenta += p.norm();
            sum_of_moments += moment<Dim>(solid.rest_positions()[i], p).norm();
        }
        moment_start = pseudo_moment();
        ledger.record(dynamics::measure(memm, solid));
    }
    TurningScene(const TurningScene&) = delete;

    static solid::SolidOptions<Dim> floating(solid::SolidOptions<Dim> options) {
        options.kinematics.assign(options.materials.size(), Kinematics::floating);
        return options;
    }
    std::vector<double> noisy(std::vector<double> p, double noise) const {
        const std::vector<double> added = random_state(p.size(), 3, noise);
        for (std::size_t i = 0; i < p.size(); ++i) p[i] += added[i] / solid.inverse_mass()[i];
        return p;
    }
    [[nodiscard]] dynamics::RunView<Dim> view() const { return {memm}; }
    [[nodiscard]] AxialVector<Dim> pseudo_moment() const {
        return dynamics::pseudo_angular_momentum<Dim>(view(), memm.dt(), solid.rest_positions(), solid.masses());
    }
    void run(int steps, int every = 10) {
        for (int i = 1; i <= steps; ++i) {
            memm.step();
            raise(moment_drift, (pseudo_moment() - moment_start).norm());
            if (i % every == 0 || i == steps) ledger.record(dynamics::measure(memm, solid));
        }
    }
    void run_until(double time) { run(static_cast<int>(std::ceil((time - memm.time()) / memm.dt()))); }
    [[nodiscard]] Drifts drifts() const {
        const double energy = ledger.largest_energy();
        return {ledger.pseudo_energy_drift() / energy, ledger.energy_excess() / energy,
                ledger.momentum_drift() / sum_of_momenta, moment_drift / sum_of_moments, ledger.parasitic()};
    }
    /// Largest distance of two cells over that at rest.
    [[nodiscard]] double stretch() const {
        double stretch = 0.0;
        const auto q = as_vectors<Dim>(memm.q());
        for (std::int32_t c = 1; c < mesh.n_cells(); ++c) {
            const Vector<Dim> rest = mesh.cell_centroid[c] - mesh.cell_centroid[0];
            raise(stretch, std::abs((rest + q[c] - q[0]).norm() / rest.norm() - 1.0));
        }
        return stretch;
    }
};

template <int Dim>
mesh::Mesh<Dim> block(int cells = 4) {
    std::array<int, Dim> counts;
    counts.fill(cells);
    Vector<Dim> upper = Vector<Dim>::Constant(0.5);
    upper[0] = 0.7;
    return mesh::structured_box<Dim>(-upper, upper, counts, Dim == 2 ? CellShape::triangle : CellShape::tetrahedron);
}

template <int Dim>
AxialVector<Dim> some_spin(double size) {
    if constexpr (Dim == 2)
        return AxialVector<2>(size);
    else
        return size * AxialVector<3>(0.3, -0.5, 0.8);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a free block that spins for 20 turns keeps H~, momentum and J~, and its size", "[solid][turning]",
                       ((int Dim), Dim), 2, 3) {
    const double noise = GENERATE(0.0, 1e-3);
    auto options = bodies<Dim>(1);
    options.contact.reset();
    const double spin = 0.1;
    TurningScene<Dim> scene(block<Dim>(), options, {{.velocity = Vector<Dim>::Constant(0.02), .spin = some_spin<Dim>(spin)}},
                            0.8, noise);
    scene.run_until(20.0 * 2.0 * pi / spin);
    const Drifts drifts = scene.drifts();
    CAPTURE(noise, scene.memm.steps(), scene.stretch());
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(drifts.momentum <= 1e-13);
    CHECK(drifts.energy_excess <= 1.0);
    if (noise == 0.0) CHECK(scene.stretch() <= 2.0 * spin * spin);  // the centrifugal stretch of E = rho = 1
    std::printf("%dD spin: %.2e %.2e %.2e %.2e %.2e stretch %.2e steps %ld\n", Dim, drifts.pseudo_energy, drifts.energy_excess, drifts.momentum, drifts.pseudo_moment, drifts.parasitic, scene.stretch(), scene.memm.steps());
}

TEST_CASE("discs that spin and collide keep H~, momentum and J~", "[solid][turning]") {
    TurningScene<2> scene(two_discs(0.8), bodies<2>(2), {{{0.05, 0.0}, some_spin<2>(0.1)}, {{-0.05, 0.0}, some_spin<2>(0.05)}}, 0.6);
    scene.run_until(30.0);
    const Drifts drifts = scene.drifts();
    const auto report = scene.solid.contact_report();
    std::printf("discs: %.2e %.2e %.2e %.2e %.2e missed %ld comp %.2g corr %.2g events %ld steps %ld\n", drifts.pseudo_energy, drifts.energy_excess, drifts.momentum, drifts.pseudo_moment, drifts.parasitic, report.missed_contacts, report.compression_max, report.correction_max, report.events, scene.memm.steps());
    for (auto m : solid::body_motions<2>(scene.memm, scene.solid)) std::printf("  v %g %g rot %g\n", m.velocity[0], m.velocity[1], m.rotation);
    CHECK(report.active_pairs_max > 0);
    CHECK(report.missed_contacts == 0);
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(drifts.momentum <= 1e-13);
}

TEST_CASE("boxes of tetrahedra that collide keep H~, momentum and J~", "[solid][turning]") {
    TurningScene<3> scene(two_boxes(4), bodies<3>(2), {{{0.02, 0.01, 0.05}, {}}, {{-0.02, 0.0, -0.05}, some_spin<3>(0.1)}}, 0.6);
    scene.run_until(30.0);
    const Drifts drifts = scene.drifts();
    const auto report = scene.solid.contact_report();
    std::printf("boxes: %.2e %.2e %.2e %.2e %.2e missed %ld comp %.2g corr %.2g events %ld steps %ld\n", drifts.pseudo_energy, drifts.energy_excess, drifts.momentum, drifts.pseudo_moment, drifts.parasitic, report.missed_contacts, report.compression_max, report.correction_max, report.events, scene.memm.steps());
    CHECK(report.active_pairs_max > 0);
    CHECK(report.missed_contacts == 0);
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(drifts.momentum <= 1e-13);
}
