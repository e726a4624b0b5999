// Bonds that open, and break.
#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/bond/bonds.hpp"

namespace abut::solid {

template <int Dim>
bool Bonds<Dim>::any_breaks() const {
    return std::ranges::any_of(bodies_.options().bonds, [](const Bond& bond) { return std::isfinite(bond.strength); });
}

/// Without a fracture energy a place breaks where it is pulled apart.
template <int Dim>
void Bonds<Dim>::append_change(std::size_t place, const BondPull& pull, std::vector<BondChange>& changes) const {
    const double energy = fracture_energy(place), strength = places_[place].strength, stiffness = pull.stiffness;
    if (is_broken(place) || (energy == 0.0 && !pull.pulls_apart)) return;
    const double start = share_[place], end = share_of_bond(strength, energy, pull.traction, stiffness);
    if (end >= start) return;
    const double held_0 = pull.held_0, held_1 = 0.5 * pull.traction * pull.traction / stiffness;
    const double opening = energy > 0.0 ? opening_of_bond(strength, energy, end, stiffness) : 1.0;
    const double taken =
        energy > 0.0 ? std::max(energy * opening - taken_[place], 0.0) : 0.5 * (start - end) * (held_0 + held_1);
    changes.push_back({.place = place,
                       .start = start,
                       .end = end,
                       .middle = energy > 0.0 ? middle_share(start, end, held_0, held_1, taken) : 0.5 * (start + end),
                       .opening = opening,
                       .taken = taken,
                       .stiffness = stiffness,
                       .rise = held_1 - held_0,
                       .pressed = energy > 0.0 ? pull.pressed : 0.0});
}

template <int Dim>
double Bonds<Dim>::fracture_energy(std::size_t place) const {
    return bodies_.options().bonds[places_[place].bond].fracture_energy;
}

template <int Dim>
BondChange Bonds<Dim>::opened(const BondChange& change, const BondOpening& opening) const {
    BondChange opened = change;
    const double energy = fracture_energy(change.place), strength = places_[change.place].strength;
    if (energy > 0.0 && opening.extent != 1.0) {
        opened.opening = std::min(std::lerp(opened_[change.place], change.opening, opening.extent), 1.0);
        opened.taken = std::max(energy * opened.opening - taken_[change.place], 0.0);
        opened.end = std::min(change.start, share_of_opening(strength, energy, opened.opening, change.stiffness));
    }
    // The share of the start loses most where the place comes to hold more in the step.
    const bool to_start = (opening.middle > 0.0) == (change.rise > 0.0);
    opened.middle = std::lerp(change.middle, to_start ? opened.start : opened.end, std::abs(opening.middle));
    return opened;
}

template <int Dim>
bool Bonds<Dim>::have_law(std::span<const BondChange> changes) const {
    return std::ranges::any_of(changes, [&](const BondChange& change) { return fracture_energy(change.place) > 0.0; });
}

template <int Dim>
double Bonds<Dim>::energy_by_law(std::span<const BondChange> changes) const {
    double energy = 0.0;
    for (const BondChange& change : changes) energy += places_[change.place].area * change.taken;
    return energy;
}

template <int Dim>
std::array<double, 2> Bonds<Dim>::rise_of_loss(std::span<const BondChange> changes) const {
    std::array<double, 2> rise{};
    for (const BondChange& change : changes) {
        const double to_start = places_[change.place].area * change.rise * (change.start - change.middle);
        const double to_end = places_[change.place].area * change.rise * (change.end - change.middle);
        rise[0] += std::max(to_start, to_end);
        rise[1] -= std::min(to_start, to_end);
    }
    return rise;
}

template <int Dim>
void Bonds<Dim>::share_loss(double lost, std::span<BondChange> changes) const {
    const double by_law = energy_by_law(changes);
    double area = 0.0;
    for (const BondChange& change : changes) area += places_[change.place].area;
    for (BondChange& change : changes) change.taken = by_law > 0.0 ? lost / by_law * change.taken : lost / area;
}

template <int Dim>
double Bonds<Dim>::beyond_law() const {
    double energy = 0.0;
    for (std::size_t p = 0; p < places_.size(); ++p)
        energy += places_[p].area * (taken_[p] - fracture_energy(p) * opened_[p]);
    return energy;
}

template <int Dim>
std::vector<BondChange> Bonds<Dim>::changes() const {
    std::vector<BondChange> changes;
    if (!any_breaks()) return changes;
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const auto of_law = [&](const Vector<Dim>& jump) {
            return fracture_energy(joint.place) > 0.0 ? beside_pressure(joint, jump) : jump;
        };
        const Vector<Dim> jump = of_law(jump_1_[p]), before = of_law(jump_0_[p]), traction = joint.stiffness * jump;
        const double energy = traction.dot(jump);
        if (energy > 0.0)
            append_change(joint.place,
                          {.traction = traction.norm(),
                           .stiffness = traction.squaredNorm() / energy,
                           .held_0 = 0.5 * before.dot(joint.stiffness * before),
                           .pulls_apart = traction.dot(joint.normal) > 0.0,
                           .pressed = pressed_energy(joint, jump_1_[p])},
                          changes);
    }
    springs_->for_each_pull([&](std::size_t place) { return fracture_energy(place) > 0.0; },
                            [&](std::size_t place, const BondPull& pull) { append_change(place, pull, changes); });
    std::ranges::sort(changes, {}, &BondChange::place);
    return changes;
}

template <int Dim>
void Bonds<Dim>::set_shares(std::span<const BondChange> changes, When when) {
    for (const BondChange& change : changes)
        share_[change.place] = when == When::start ? change.start : when == When::end ? change.end : change.middle;
    in_middle_.clear();
    if (when == When::middle) in_middle_.assign(changes.begin(), changes.end());
}

template <int Dim>
void Bonds<Dim>::end_changes(std::span<const BondChange> changes) {
    any_broke_ = false;
    broke_pressed_.clear();
    if (changes.empty()) return;
    set_shares(changes, When::end);
    for (const BondChange& change : changes) {
        if (change.end == 0.0) {
            any_broke_ = true;
            if (change.pressed > 0.0) broke_pressed_.push_back(change);
        }
        if (fracture_energy(change.place) == 0.0) continue;
        taken_[change.place] += change.taken;
        opened_[change.place] = change.opening;
    }
    find_opening();
}

template <int Dim>
void Bonds<Dim>::see_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1) {
    springs_->see_end(q_1, load_1, StepState::end);
}

template <int Dim>
double Bonds<Dim>::energy_at_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1) {
    if (!any()) return 0.0;
    see_end(q_1, load_1);
    const std::vector<BondChange> changes = in_middle_;
    set_shares(changes, When::end);
    const double energy_then = energy();
    set_shares(changes, When::middle);
    return energy_then;
}

/// A bond that opens must take more than half cells give back as it does, straight at least. Along the face they hold up to
/// (lambda + 2 mu)/mu times as much, or give way without bearing anything at the rim of a bond: one that opens straight is
/// right even so, and what shear takes beyond is told (beyond_law).
template <int Dim>
void Bonds<Dim>::check_fracture_energy() const {
    const auto check = [&](std::size_t p, double stiffness) {
        const double energy = fracture_energy(p);
        if (energy == 0.0) return;
        const double held = energy_at_strength(places_[p].strength, stiffness);
        if (energy > held) return;
        const auto body_at = [&](std::size_t side) {
            return "'" + bodies_.mesh().body_names[static_cast<std::size_t>(places_[p].bodies[side])] + "'";
        };
        throw BadInput(mesh_.name + ": the bond of " + body_at(0) + " and " + body_at(1) + " has a fracture energy of " +
                           number(energy) + " J/m^2, but at its strength of " + number(places_[p].strength) +
                           " Pa the half cells beside it hold " + number(held) +
                           " J/m^2, and it would take these at once. Make cells there " +
                           number(std::ceil(10.0 * held / energy) / 10.0 + 0.1) +
                           " times smaller or more, or leave fracture_energy out.",
                       {.value = energy, .allowed = held});
    };
    for (const Joint& joint : joints_) {
        const Vector<Dim>& normal = places_[joint.place].normal;
        check(joint.place, (joint.stiffness * normal).squaredNorm() / normal.dot(joint.stiffness * normal));
    }
    springs_->for_each_stiffness(check);
}

#define ABUT_INSTANTIATE(Dim)                                                                              \
    template bool Bonds<Dim>::any_breaks() const;                                                          \
    template void Bonds<Dim>::append_change(std::size_t, const BondPull&, std::vector<BondChange>&) const; \
    template double Bonds<Dim>::fracture_energy(std::size_t) const;                                        \
    template BondChange Bonds<Dim>::opened(const BondChange&, const BondOpening&) const;                   \
    template bool Bonds<Dim>::have_law(std::span<const BondChange>) const;                                 \
    template double Bonds<Dim>::energy_by_law(std::span<const BondChange>) const;                          \
    template std::array<double, 2> Bonds<Dim>::rise_of_loss(std::span<const BondChange>) const;            \
    template void Bonds<Dim>::share_loss(double, std::span<BondChange>) const;                             \
    template double Bonds<Dim>::beyond_law() const;                                                        \
    template std::vector<BondChange> Bonds<Dim>::changes() const;                                          \
    template void Bonds<Dim>::set_shares(std::span<const BondChange>, When);                               \
    template void Bonds<Dim>::end_changes(std::span<const BondChange>);                                    \
    template void Bonds<Dim>::see_end(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&);             \
    template double Bonds<Dim>::energy_at_end(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&);     \
    template void Bonds<Dim>::check_fracture_energy() const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
