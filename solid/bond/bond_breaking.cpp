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

/// `traction` of the place as if it were whole, `stiffness` of both half cells in its direction.
template <int Dim>
void Bonds<Dim>::append_change(std::size_t place, const Vector<Dim>& traction, double stiffness, const Vector<Dim>& normal,
                               std::vector<BondChange>& changes) const {
    if (share_[place] == 0.0 || traction.dot(normal) <= 0.0) return;
    const double energy = bodies_.options().bonds[places_[place].bond].fracture_energy;
    const double share = share_of_bond(places_[place].strength, energy, traction.norm(), stiffness);
    if (share < share_[place]) changes.push_back({place, share_[place], share});
}

template <int Dim>
std::vector<BondChange> Bonds<Dim>::changes() const {
    std::vector<BondChange> changes;
    if (!any_breaks()) return changes;
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Vector<Dim> traction = joints_[p].stiffness * jump_1_[p];
        const double energy = traction.dot(jump_1_[p]);
        if (energy > 0.0)
            append_change(joints_[p].place, traction, traction.squaredNorm() / energy, places_[joints_[p].place].normal,
                          changes);
    }
    springs_->for_each_traction(
        [&](std::size_t place, const Vector<Dim>& traction, double stiffness, const Vector<Dim>& normal) {
            append_change(place, traction, stiffness, normal, changes);
        });
    std::ranges::sort(changes, {}, &BondChange::place);
    return changes;
}

template <int Dim>
void Bonds<Dim>::set_shares(std::span<const BondChange> changes, When when) {
    for (const auto& [place, start, end] : changes)
        share_[place] = when == When::start ? start : when == When::end ? end : 0.5 * (start + end);
    in_middle_.clear();
    if (when == When::middle) in_middle_.assign(changes.begin(), changes.end());
}

template <int Dim>
void Bonds<Dim>::end_changes(std::span<const BondChange> changes) {
    any_broke_ = std::ranges::any_of(changes, [](const BondChange& change) { return change.end == 0.0; });
    if (changes.empty()) return;
    set_shares(changes, When::end);
    if (any_broke_) leave_out_broken();
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

/// A bond that opens must take more than half cells give back as it does, straight at least: at the rim of a bond they
/// may give way along the face without bearing anything.
template <int Dim>
void Bonds<Dim>::check_fracture_energy() const {
    const auto check = [&](std::size_t p, double stiffness) {
        const Bond& bond = bodies_.options().bonds[places_[p].bond];
        if (bond.fracture_energy == 0.0) return;
        const double held = energy_at_strength(places_[p].strength, stiffness);
        if (bond.fracture_energy > held) return;
        const auto body_at = [&](std::size_t side) {
            return "'" + bodies_.mesh().body_names[static_cast<std::size_t>(places_[p].bodies[side])] + "'";
        };
        throw BadInput(mesh_.name + ": the bond of " + body_at(0) + " and " + body_at(1) + " has a fracture energy of " +
                           number(bond.fracture_energy) + " J/m^2, but at its strength of " + number(places_[p].strength) +
                           " Pa the half cells beside it hold " + number(held) +
                           " J/m^2, and it would take these at once. Make cells there " +
                           number(std::ceil(10.0 * held / bond.fracture_energy) / 10.0 + 0.1) +
                           " times smaller or more, or leave fracture_energy out.",
                       {.value = bond.fracture_energy, .allowed = held});
    };
    for (const Joint& joint : joints_) {
        const Vector<Dim>& normal = places_[joint.place].normal;
        check(joint.place, (joint.stiffness * normal).squaredNorm() / normal.dot(joint.stiffness * normal));
    }
    springs_->for_each_stiffness(check);
}

template <int Dim>
void Bonds<Dim>::take_over(const Bonds& before, std::span<const std::int32_t> old_boundary) {
    for (std::size_t p = 0; p < places_.size(); ++p) {
        const BondPlace<Dim>& place = places_[p];
        const auto from = std::ranges::find_if(before.places_, [&](const BondPlace<Dim>& old) {
            const auto was = [&](std::size_t side) { return old_boundary[static_cast<std::size_t>(place.faces[side])]; };
            return old.bond == place.bond && static_cast<std::int32_t>(old.faces[0]) == was(0) &&
                   static_cast<std::int32_t>(old.faces[1]) == was(1);
        });
        if (from == before.places_.end())
            throw BadInput(bodies_.mesh().name + ": faces are bonded that were not. Keep bonds as they are.");
        const auto old = static_cast<std::size_t>(from - before.places_.begin());
        share_[p] = before.share_[old];
        loosened_[p] = before.loosened_[old];
        places_[p].strength = from->strength;  // drawn once, whatever numbers the faces have now
    }
    leave_out_broken();
    find_opening();
}

#define ABUT_INSTANTIATE(Dim)                                                                            \
    template bool Bonds<Dim>::any_breaks() const;                                                        \
    template void Bonds<Dim>::append_change(std::size_t, const Vector<Dim>&, double, const Vector<Dim>&, \
                                            std::vector<BondChange>&) const;                             \
    template std::vector<BondChange> Bonds<Dim>::changes() const;                                        \
    template void Bonds<Dim>::set_shares(std::span<const BondChange>, When);                             \
    template void Bonds<Dim>::end_changes(std::span<const BondChange>);                                  \
    template void Bonds<Dim>::see_end(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&);           \
    template double Bonds<Dim>::energy_at_end(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&);   \
    template void Bonds<Dim>::check_fracture_energy() const;                                             \
    template void Bonds<Dim>::take_over(const Bonds&, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
