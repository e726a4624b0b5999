#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/solid/load/held_places.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

/// Points whose values every rank needs, and forces on which every rank knows: it brings the values together, and gives each
/// rank the forces on its own points. Constructor and `take` are calls of all ranks.
template <int Dim>
class HeldPoints {
public:
    HeldPoints() = default;
    /// By their numbers among all points, increasing. `part` must outlive it.
    HeldPoints(std::vector<std::int32_t> numbers, const RankPart<Dim>& part);

    [[nodiscard]] std::span<const std::int32_t> numbers() const { return numbers_; }
    /// Takes from some arrays by point here the values of these points, array after array (n each).
    [[nodiscard]] std::vector<std::vector<Vector<Dim>>> take(
        std::initializer_list<std::span<const Vector<Dim>>> arrays) const;
    /// Adds a force on a place, which is held by these points, to those here that are own ones.
    void push(const HeldPlace<Dim>& place, const Vector<Dim>& force, std::span<Vector<Dim>> of_points) const {
        for (std::size_t i = 0; i < place.points.size(); ++i)
            if (const std::int32_t position = position_[static_cast<std::size_t>(place.points[i])]; position >= 0)
                of_points[static_cast<std::size_t>(position)] += place.weights[i] * force;
    }

private:
    std::vector<std::int32_t> numbers_;
    std::vector<std::int32_t> position_;   // of each among the points here; -1: it is on another rank
    const RankPart<Dim>* part_ = nullptr;  // null: there are no such points
    std::vector<std::size_t> gathered_;    // as `gather` brings those of all ranks
};

}  // namespace abut::solid
