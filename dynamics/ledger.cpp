#include "abut/dynamics/ledger.hpp"

#include <array>
#include <cmath>
#include <type_traits>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/dynamics/sum_over.hpp"

namespace abut::dynamics {
namespace {

template <int Dim, class Entry>
void append_names(std::vector<std::string>& names, const std::string& name, Entry n) {
    static constexpr std::array<const char*, 3> axis{"_x", "_y", "_z"};
    if (n == 1)
        names.push_back(name);
    else
        for (int i = 0; i < n; ++i) names.push_back(name + axis[i]);
}

/// The numbers of an entry, in the order of `ledger_columns`.
template <int Dim, class Entry, class Visit>
void for_each_value(Entry& entry, const Visit& visit) {
    const auto visit_all = [&](auto&... values) { (visit(values), ...); };
    const auto visit_vector = [&](auto& vector) {
        for (auto& value : vector) visit(value);
    };
    visit_all(entry.step, entry.time, entry.pseudo_energy, entry.energy, entry.kinetic, entry.potential, entry.work);
    visit_vector(entry.linear_momentum);
    visit_vector(entry.angular_momentum);
    visit_all(entry.parasitic, entry.active_pairs, entry.events, entry.restart_jumps, entry.rotation);
    visit_vector(entry.rest_angular_momentum);
    visit_all(entry.restarts.restarts, entry.restarts.shortened, entry.restarts.skipped, entry.restarts.paid);
    visit_vector(entry.pseudo_angular_momentum);
    visit_all(entry.dissipated, entry.friction_energy, entry.sticking_faces, entry.sliding_faces);
    for (const Loss& loss : all_losses) visit(entry.losses.*loss.of);
    auto& eroded = entry.eroded;
    visit_all(eroded.cells, eroded.mass, eroded.kinetic, eroded.potential);
    visit_vector(eroded.momentum);
    visit_vector(eroded.rest_angular_momentum);
    visit_vector(eroded.pseudo_angular_momentum);
}

/// Sum of term(i) over all points of a run.
template <int Dim, class Value, class Term>
Value sum_of_points(const RunView<Dim>& run, const Value& zero, const Term& term) {
    const auto n = static_cast<std::ptrdiff_t>(run.q.size()) / Dim;
    return sum_over(run.ranks, {}, n, zero, term);
}

}  // namespace

template <int Dim>
std::vector<std::string> ledger_columns() {
    std::vector<std::string> names{"step", "time", "pseudo_energy", "energy", "kinetic", "potential", "work"};
    append_names<Dim>(names, "linear_momentum", Dim);
    append_names<Dim>(names, "angular_momentum", n_rotations<Dim>);
    names.insert(names.end(), {"parasitic", "active_pairs", "events", "restart_jumps", "rotation"});
    append_names<Dim>(names, "rest_angular_momentum", n_rotations<Dim>);
    names.insert(names.end(), {"restarts", "restarts_shortened", "restarts_skipped", "restart_paid"});
    append_names<Dim>(names, "pseudo_angular_momentum", n_rotations<Dim>);
    names.insert(names.end(), {"dissipated", "friction_energy", "sticking_faces", "sliding_faces"});
    for (const Loss& loss : all_losses) names.emplace_back(loss.name);
    names.insert(names.end(), {"eroded_cells", "eroded_mass", "eroded_kinetic", "eroded_potential"});
    append_names<Dim>(names, "eroded_momentum", Dim);
    append_names<Dim>(names, "eroded_rest_angular_momentum", n_rotations<Dim>);
    append_names<Dim>(names, "eroded_pseudo_angular_momentum", n_rotations<Dim>);
    return names;
}

template <int Dim>
std::vector<double> ledger_values(const LedgerEntry<Dim>& entry) {
    std::vector<double> values;
    for_each_value<Dim>(entry, [&](const auto& value) { values.push_back(static_cast<double>(value)); });
    return values;
}

template <int Dim>
LedgerEntry<Dim> ledger_entry(std::span<const double> values) {
    if (const std::size_t n = ledger_columns<Dim>().size(); values.size() != n)
        throw BadInput("ledger: an entry has " + std::to_string(n) + " values, not " + std::to_string(values.size()) + ".",
                       {.value = static_cast<double>(values.size()), .allowed = static_cast<double>(n)});
    LedgerEntry<Dim> entry{};
    std::size_t at = 0;
    for_each_value<Dim>(entry,
                        [&](auto& value) { value = static_cast<std::remove_cvref_t<decltype(value)>>(values[at++]); });
    return entry;
}

template <int Dim>
AngularMomentum<Dim> pseudo_angular_momentum(const RunView<Dim>& run, double dt, std::span<const Vector<Dim>> rest_position,
                                             std::span<const double> mass) {
    const auto u = as_vectors<Dim>(run.q), before = as_vectors<Dim>(run.p_before), after = as_vectors<Dim>(run.p_after);
    return sum_of_points(run, AngularMomentum<Dim>::Zero(), [&](std::ptrdiff_t i) -> AngularMomentum<Dim> {
        const Vector<Dim> arm = rest_position[i] + u[i];
        return moment<Dim>(arm, run.momentum(i)) - 0.25 * dt / mass[i] * moment<Dim>(before[i], after[i]);
    });
}

template <int Dim>
void detail::add_motion(LedgerEntry<Dim>& entry, const RunView<Dim>& run, std::span<const double> e,
                        std::span<const Vector<Dim>> rest_position, std::span<const double> mass) {
    entry.step = run.steps;
    entry.time = run.time;
    const auto u = as_vectors<Dim>(run.q);
    entry.linear_momentum = sum_of_points(run, Vector<Dim>::Zero(), [&](std::ptrdiff_t i) { return run.momentum(i); });
    const AngularMomentum<Dim> zero = AngularMomentum<Dim>::Zero();
    entry.angular_momentum =
        sum_of_points(run, zero, [&](std::ptrdiff_t i) { return moment<Dim>(rest_position[i] + u[i], run.momentum(i)); });
    entry.rest_angular_momentum =
        sum_of_points(run, zero, [&](std::ptrdiff_t i) { return moment<Dim>(rest_position[i], run.momentum(i)); });
    const auto e_i = as_vectors<Dim>(e);
    entry.parasitic = run.ranks.largest(largest(std::ssize(u), [&](std::ptrdiff_t i) { return e_i[i].norm() / mass[i]; }));
}

double detail::largest_angle(std::span<const double> angles) {
    double so_far = 0.0;
    for (const double angle : angles) so_far = larger(so_far, angle);
    return so_far;
}

template <int Dim>
void Ledger<Dim>::record(const LedgerEntry<Dim>& entry) {
    entries_.push_back(entry);
    const LedgerEntry<Dim>& first = entries_.front();
    const auto raise = [](double& so_far, double value) { so_far = larger(so_far, value); };
    const auto kept = [](const LedgerEntry<Dim>& e) { return e.pseudo_energy - e.received(); };
    const auto true_energy = [](const LedgerEntry<Dim>& e) { return e.energy - e.work + e.dissipated + e.eroded.energy(); };
    const Left<Dim>& eroded = entry.eroded;
    const AngularMomentum<Dim> pseudo = eroded.pseudo_angular_momentum;
    raise(pseudo_energy_drift_, std::abs(kept(entry) - kept(first)));
    raise(energy_drift_, std::abs(true_energy(entry) - true_energy(first)));
    raise(energy_excess_, entry.energy - entry.pseudo_energy);
    raise(parasitic_, entry.parasitic);
    raise(momentum_drift_, (entry.linear_momentum + eroded.momentum - first.linear_momentum).norm());
    raise(angular_momentum_drift_, (entry.angular_momentum + pseudo - first.angular_momentum).norm());
    raise(rest_angular_momentum_drift_,
          (entry.rest_angular_momentum + eroded.rest_angular_momentum - first.rest_angular_momentum).norm());
    raise(pseudo_angular_momentum_drift_, (entry.pseudo_angular_momentum + pseudo - first.pseudo_angular_momentum).norm());
    raise(rotation_, entry.rotation);
    for (const double energy : {entry.energy, entry.kinetic, entry.potential}) raise(largest_energy_, std::abs(energy));
}

#define ABUT_INSTANTIATE(Dim)                                                                                             \
    template std::vector<std::string> ledger_columns<Dim>();                                                              \
    template std::vector<double> ledger_values<Dim>(const LedgerEntry<Dim>&);                                             \
    template LedgerEntry<Dim> ledger_entry<Dim>(std::span<const double>);                                                 \
    template AngularMomentum<Dim> pseudo_angular_momentum<Dim>(const RunView<Dim>&, double, std::span<const Vector<Dim>>, \
                                                               std::span<const double>);                                  \
    template void detail::add_motion<Dim>(LedgerEntry<Dim>&, const RunView<Dim>&, std::span<const double>,                \
                                          std::span<const Vector<Dim>>, std::span<const double>);                         \
    template class Ledger<Dim>;
ABUT_INSTANTIATE(1)
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::dynamics
