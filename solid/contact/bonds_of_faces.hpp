#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::solid {

/// Bonds of faces, by the number of the face. The faces of bodies that deform come first in contact, in the order of the
/// whole mesh. `Bonds`: has places(), is_broken(place) and pressed_energy(place), as solid::Bonds.
template <class Bonds>
class BondsOfFaces {
public:
    /// `bonds` must outlive it.
    explicit BondsOfFaces(const Bonds& bonds) : bonds_(bonds) {
        for (std::size_t place = 0; place < bonds.places().size(); ++place)
            for (std::size_t side = 0; side < 2; ++side)
                entries_.push_back({bonds.places()[place].numbers[side], place, side});
        std::ranges::sort(entries_);
        for (const Entry& entry : entries_) {
            begin_.resize(entry.number + 2, entries_.size());
            begin_[entry.number] = std::min(begin_[entry.number], static_cast<std::size_t>(&entry - entries_.data()));
        }
        for (std::size_t face = begin_.size(); face-- > 1;) begin_[face - 1] = std::min(begin_[face - 1], begin_[face]);
    }

    /// Whether the whole face is bonded: then nothing can touch it.
    [[nodiscard]] bool covers(contact::Face face) const {
        constexpr double rounding = 1e-6;
        double left = 1.0;
        for (const auto& [number, place, side] : of(face)) {
            if (bonds_.is_broken(place)) return false;
            left -= bonds_.places()[place].area / bonds_.places()[place].measures[side];
        }
        return left < rounding;
    }
    /// Whether an unbroken bond holds the face to the body.
    [[nodiscard]] bool joins(contact::Face face, std::int32_t body) const {
        return std::ranges::any_of(of(face), [&](const Entry& entry) {
            return bonds_.places()[entry.place].bodies[1 - entry.side] == body && !bonds_.is_broken(entry.place);
        });
    }
    /// Energy by which both pressed on each other as the places between them broke [J/m^2]; 0 of others, and while one
    /// holds.
    [[nodiscard]] double pressed_energy(contact::Face face_1, contact::Face face_2) const {
        double energy = 0.0;
        for (const Entry& entry : of(face_1)) {
            if (bonds_.places()[entry.place].numbers[1 - entry.side] != static_cast<std::size_t>(face_2)) continue;
            if (!bonds_.is_broken(entry.place)) return 0.0;
            energy += bonds_.pressed_energy(entry.place);
        }
        return energy;
    }
    /// Mean over the broken places that held the face to the body, by area [J/m^2].
    [[nodiscard]] double pressed_energy(contact::Face face, std::int32_t body) const {
        double energy = 0.0, area = 0.0;
        for (const auto& [number, place, side] : of(face)) {
            const auto& at = bonds_.places()[place];
            if (at.bodies[1 - side] != body || !bonds_.is_broken(place)) continue;
            energy += at.area * bonds_.pressed_energy(place);
            area += at.area;
        }
        return area > 0.0 ? energy / area : 0.0;
    }
    /// Energy by which contact of two faces of these bodies begins [J/m^2]: that of a pair of sides, and of neighbours the
    /// lesser one of both faces.
    [[nodiscard]] double energy_at_first(std::array<contact::Face, 2> faces, std::array<std::int32_t, 2> bodies) const {
        if (const double of_mates = pressed_energy(faces[0], faces[1]); of_mates > 0.0) return of_mates;
        return std::min(pressed_energy(faces[0], bodies[1]), pressed_energy(faces[1], bodies[0]));
    }

private:
    struct Entry {
        std::size_t number, place, side;
        auto operator<=>(const Entry&) const = default;
    };
    [[nodiscard]] std::span<const Entry> of(contact::Face face) const {
        const auto i = static_cast<std::size_t>(face);
        if (i + 1 >= begin_.size()) return {};
        return {entries_.data() + begin_[i], begin_[i + 1] - begin_[i]};
    }

    const Bonds& bonds_;
    std::vector<Entry> entries_;      // face by face
    std::vector<std::size_t> begin_;  // of each face, one more at the end
};

}  // namespace abut::solid
