#pragma once
// Bodies that turn, and what their runs must keep.
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "abut/dynamics/point_system.hpp"
#include "abut/solid/contact_view.hpp"
#include "solid/scenes.hpp"

namespace abut::test {

/// How a body moves at the start.
template <int Dim>
struct Motion {
    Vector<Dim> velocity = Vector<Dim>::Zero();
    AxialVector<Dim> spin = AxialVector<Dim>::Zero();
};

template <int Dim>
Motion<Dim> moving(const Vector<Dim>& velocity, const AxialVector<Dim>& spin = AxialVector<Dim>::Zero()) {
    Motion<Dim> motion;
    motion.velocity = velocity;
    motion.spin = spin;
    return motion;
}

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
    double pseudo_energy = 0.0;  // less the work, over the largest energy
    double energy_excess = 0.0;  // H - H~, the same
    double momentum = 0.0;       // over sum |p|
    double pseudo_moment = 0.0;  // J~ over sum |x × p|
    double parasitic = 0.0;      // |e|/m
};

/// A run of bodies that turn, under MEMM. `cfl` < 0: less the time step.
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
                 std::vector<solid::Kinematics> kinematics, double noise = 0.0)
        : mesh(std::move(made)),
          solid(mesh, with(std::move(options), std::move(kinematics))),
          memm(solid, std::vector<double>(solid.size(), 0.0), noisy(momentum_of(solid, motion), noise),
               cfl > 0.0 ? cfl * dynamics::stable_step(solid).dt / solid.step_margin() : -cfl) {
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

    /// The same kinematics for all bodies.
    TurningScene(mesh::Mesh<Dim> made, const solid::SolidOptions<Dim>& options, const std::vector<Motion<Dim>>& motion,
                 double cfl, solid::Kinematics kinematics = solid::Kinematics::floating, double noise = 0.0)
        : TurningScene(std::move(made), options, motion, cfl,
                       std::vector<solid::Kinematics>(options.materials.size(), kinematics), noise) {}

    static solid::SolidOptions<Dim> with(solid::SolidOptions<Dim> options, std::vector<solid::Kinematics> kinematics) {
        options.kinematics = std::move(kinematics);
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
    /// Largest distance of two points over that at rest.
    [[nodiscard]] double stretch() const {
        double stretch = 0.0;
        const auto q = as_vectors<Dim>(memm.q());
        for (std::int32_t c = 1; c < mesh.n_cells(); ++c) {
            const Vector<Dim> rest = solid.rest_positions()[c] - solid.rest_positions()[0];
            raise(stretch, std::abs((rest + q[c] - q[0]).norm() / rest.norm() - 1.0));
        }
        return stretch;
    }
};

/// Bodies have touched, no contact was missed, and what nothing from outside changes is kept to round-off.
template <int Dim>
void check_collision(const TurningScene<Dim>& scene) {
    const Drifts drifts = scene.drifts();
    const auto report = scene.solid.contact().report();
    CHECK(report.active_pairs_max > 0);
    CHECK(report.missed_contacts == 0);
    CHECK(drifts.pseudo_energy <= 1e-12);
    CHECK(drifts.pseudo_moment <= 1e-13);
    CHECK(drifts.momentum <= 1e-13);
}

template <int Dim>
AxialVector<Dim> some_spin(double size) {
    if constexpr (Dim == 2)
        return AxialVector<2>(size);
    else
        return size * AxialVector<3>(0.3, -0.5, 0.8);
}

}  // namespace abut::test
