#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/solid/rank_part.hpp"

namespace abut::solid {

/// Some points of a system, all of which each rank looks at: the way between values of these and values by point. Constructor
/// and `take` are calls of all ranks.
template <int Dim>
class HeldPoints {
public:
    HeldPoints() = default;
    /// By their numbers among all points, increasing. `part`, which must outlive it, is null on one rank.
    HeldPoints(std::vector<std::int32_t> numbers, const RankPart<Dim>* part);

    [[nodiscard]] std::span<const std::int32_t> numbers() const { return numbers_; }
    /// Of values by point here (n_points or more), those of these points (n).
    void take(std::span<const Vector<Dim>> of_points, std::vector<Vector<Dim>>& of_held) const;
    /// Adds values of these points (n) to what belongs to points of this rank.
    void add(std::span<const Vector<Dim>> of_held, std::span<Vector<Dim>> of_points) const;

private:
    struct Own {
        std::size_t held;       // among these points
        std::int32_t position;  // among the points here
    };
    std::vector<std::int32_t> numbers_;
    const RankPart<Dim>* part_ = nullptr;
    std::vector<Own> own_;
    std::vector<std::size_t> gathered_;  // as `gather` brings those of all ranks
};

}  // namespace abut::solid
