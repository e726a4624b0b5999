// What bonds remember: saved, restored, and taken over by those of another mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/solid/bond/bonds.hpp"

namespace abut::solid {

template <int Dim>
void Bonds<Dim>::save(StateWriter& state) const {
    state.put_all(std::span<const double>(share_));
    std::vector<double> strengths;
    for (const BondPlace<Dim>& place : places_) strengths.push_back(place.strength);
    state.put_all(std::span<const double>(strengths));
    state.put_all(std::span<const double>(loosened_));
    state.put_all(std::span<const double>(taken_));
    state.put_all(std::span<const double>(opened_));
    state.put_all(std::span<const double>(pressed_energy_));
    state.put_all(std::span<const double>(normal_stiffness_));
}

template <int Dim>
void Bonds<Dim>::restore(StateReader& state) {
    const std::vector<double> share = state.get_all<double>();
    if (share.size() != share_.size())
        throw BadInput(mesh_.name + ": the saved state has " + std::to_string(share.size()) +
                           " places that are bonded, and here are " + std::to_string(share_.size()) +
                           ". Restore it where bonds are the same.",
                       {.value = static_cast<double>(share.size()), .allowed = static_cast<double>(share_.size())});
    std::array<std::vector<double>, 6> others;
    for (std::vector<double>& of_places : others) {
        of_places = state.get_all<double>();
        if (of_places.size() != share.size())
            throw BadInput(mesh_.name + ": the saved state of its bonds is damaged. Take another checkpoint.");
    }
    auto& [strengths, loosened, taken, opened, pressed_energy, normal_stiffness] = others;
    share_ = share;
    loosened_ = loosened;
    taken_ = taken;
    opened_ = opened;
    pressed_energy_ = pressed_energy;
    leave_out_broken();
    normal_stiffness_ = normal_stiffness;
    make_springs();
    find_opening();
    for (std::size_t p = 0; p < places_.size(); ++p) places_[p].strength = strengths[p];  // drawn once
}

template <int Dim>
void Bonds<Dim>::break_all() {
    for (std::size_t p = 0; p < places_.size(); ++p)
        if (std::isfinite(places_[p].strength)) share_[p] = 0.0;
    leave_out_broken();
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
        taken_[p] = before.taken_[old];
        opened_[p] = before.opened_[old];
        loosened_[p] = before.loosened_[old];
        pressed_energy_[p] = before.pressed_energy_[old];
        if (!is_joint(p)) normal_stiffness_[p] = before.normal_stiffness_[old];
        places_[p].strength = from->strength;  // drawn once, whatever numbers the faces have now
    }
    leave_out_broken();
    find_opening();
}

#define ABUT_INSTANTIATE(Dim)                           \
    template void Bonds<Dim>::save(StateWriter&) const; \
    template void Bonds<Dim>::restore(StateReader&);    \
    template void Bonds<Dim>::break_all();              \
    template void Bonds<Dim>::take_over(const Bonds&, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
