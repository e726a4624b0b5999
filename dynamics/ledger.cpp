#include "abut/dynamics/ledger.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "abut/geometry/parallel.hpp"

namespace abut::dynamics {
namespace {

template <int Dim>
using Rotation = Eigen::Matrix<double, n_rotations<Dim>, 1, Eigen::DontAlign>;

template <int Dim>
Rotation<Dim> moment(const Vector<Dim>& arm, const Vector<Dim>& momentum) {
    if constexpr (Dim == 2)
        return Rotation<2>(arm[0] * momentum[1] - arm[1] * momentum[0]);
    else
        return arm.cross(momentum);
}

template <int Dim, class Entry>
void append_names(std::vector<std::string>& names, const std::string& name, Entry n) {
    static constexpr std::array<const char*, 3> axis{"_x", "_y", "_z"};
    if (n == 1)
        names.push_back(name);
    else
        for (int i = 0; i < n; ++i) names.push_back(name + axis[i]);
}

}  // namespace

template <int Dim>
std::vector<std::string> ledger_columns() {
    std::vector<std::string> names{"step", "time", "pseudo_energy", "energy", "kinetic", "potential", "work"};
    append_names<Dim>(names, "linear_momentum", Dim);
    append_names<Dim>(names, "angular_momentum", n_rotations<Dim>);
    names.insert(names.end(), {"parasitic", "active_pairs", "events", "restart_jumps"});
    return names;
}

template <int Dim>
std::vector<double> ledger_values(const LedgerEntry<Dim>& entry) {
    std::vector<double> values{static_cast<double>(entry.step),
                               entry.time,
                               entry.pseudo_energy,
                               entry.energy,
                               entry.kinetic,
                               entry.potential,
                               entry.work};
    values.insert(values.end(), entry.linear_momentum.begin(), entry.linear_momentum.end());
    values.insert(values.end(), entry.angular_momentum.begin(), entry.angular_momentum.end());
    values.insert(values.end(), {entry.parasitic, static_cast<double>(entry.active_pairs), static_cast<double>(entry.events),
                                 entry.restart_jumps});
    return values;
}

template <int Dim>
void detail::complete(LedgerEntry<Dim>& entry, const RunView<Dim>& run, std::span<const double> e, const Solid<Dim>& solid) {
    const contact::ContactReport report = solid.contact_report();
    entry.step = run.steps;
    entry.time = run.time;
    entry.work = solid.work();
    entry.active_pairs = report.active_pairs;
    entry.events = report.events;
    const auto u = as_vectors<Dim>(run.q);
    const auto n = static_cast<std::ptrdiff_t>(u.size());
    entry.linear_momentum =
        ordered_sum(n, Vector<Dim>(Vector<Dim>::Zero()), [&](std::ptrdiff_t c) { return run.momentum(c); });
    entry.angular_momentum = ordered_sum(n, Rotation<Dim>(Rotation<Dim>::Zero()), [&](std::ptrdiff_t c) {
        return moment<Dim>(solid.mesh().cell_centroid[c] + u[c], run.momentum(c));
    });
    const auto e_c = as_vectors<Dim>(e);
    entry.parasitic = largest(n, [&](std::ptrdiff_t c) { return e_c[c].norm() / solid.cell_mass()[c]; });
}

template <int Dim>
void Ledger<Dim>::record(const LedgerEntry<Dim>& entry) {
    entries_.push_back(entry);
    const LedgerEntry<Dim>& first = entries_.front();
    const auto raise = [](double& so_far, double value) { so_far = larger(so_far, value); };
    const auto kept = [](const LedgerEntry<Dim>& e) { return e.pseudo_energy - e.work - e.restart_jumps; };
    raise(pseudo_energy_drift_, std::abs(kept(entry) - kept(first)));
    raise(energy_drift_, std::abs((entry.energy - entry.work) - (first.energy - first.work)));
    raise(energy_excess_, entry.energy - entry.pseudo_energy);
    raise(parasitic_, entry.parasitic);
    raise(momentum_drift_, (entry.linear_momentum - first.linear_momentum).norm());
    raise(angular_momentum_drift_, (entry.angular_momentum - first.angular_momentum).norm());
    for (const double energy : {entry.energy, entry.kinetic, entry.potential}) raise(largest_energy_, std::abs(energy));
}

template <int Dim>
std::vector<BodyMotion<Dim>> body_motions(const RunView<Dim>& run, const Solid<Dim>& solid) {
    std::vector<BodyMotion<Dim>> motions(static_cast<std::size_t>(solid.mesh().n_bodies()), {0.0, Vector<Dim>::Zero()});
    for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
        BodyMotion<Dim>& body = motions[solid.mesh().cell_body[c]];
        body.mass += solid.cell_mass()[c];
        body.velocity += run.momentum(c);
    }
    for (BodyMotion<Dim>& body : motions) body.velocity /= body.mass;
    return motions;
}

template <int Dim>
std::vector<double> uniform_momentum(const Solid<Dim>& solid, std::span<const Vector<Dim>> body_velocity) {
    const auto n_bodies = static_cast<std::size_t>(solid.mesh().n_bodies());
    if (body_velocity.size() != n_bodies)
        throw std::invalid_argument(std::to_string(body_velocity.size()) + " velocities are given for " +
                                    std::to_string(n_bodies) + " bodies. Give one a body.");
    std::vector<double> momentum(solid.size());
    const auto p = as_vectors<Dim>(std::span<double>(momentum));
    for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c)
        p[c] = solid.cell_mass()[c] * body_velocity[solid.mesh().cell_body[c]];
    return momentum;
}

#define ABUT_INSTANTIATE(Dim)                                                                            \
    template std::vector<std::string> ledger_columns<Dim>();                                             \
    template std::vector<double> ledger_values<Dim>(const LedgerEntry<Dim>&);                            \
    template void detail::complete<Dim>(LedgerEntry<Dim>&, const RunView<Dim>&, std::span<const double>, \
                                        const Solid<Dim>&);                                              \
    template class Ledger<Dim>;                                                                          \
    template std::vector<BodyMotion<Dim>> body_motions<Dim>(const RunView<Dim>&, const Solid<Dim>&);     \
    template std::vector<double> uniform_momentum<Dim>(const Solid<Dim>&, std::span<const Vector<Dim>>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::dynamics
