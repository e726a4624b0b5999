#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::dynamics {

/// The arrays of a state by point.
[[nodiscard]] inline auto arrays_of(IntegratorState& state) {
    return std::array<std::vector<double>*, 3>{&state.q, &state.p_before, &state.p_after};
}

/// A state with the points of all ranks in the order of their numbers, from those of each; the same on all of them, which
/// call it together. `Dim`: values per point.
template <int Dim>
[[nodiscard]] IntegratorState gathered(const Ranks& ranks, IntegratorState state) {
    if (ranks.is_one()) return state;
    const std::vector<double> numbers = ranks.gather(std::vector<double>(ranks.numbers().begin(), ranks.numbers().end()));
    for (auto* values : arrays_of(state)) {
        const std::vector<double> by_rank = ranks.gather(*values);
        values->resize(by_rank.size());
        for (std::size_t i = 0; i < by_rank.size(); ++i)
            (*values)[static_cast<std::size_t>(numbers[i / Dim]) * Dim + i % Dim] = by_rank[i];
    }
    return state;
}

/// A state with the points of all ranks on rank 0 alone; without points on the others. A call of all ranks.
template <int Dim>
[[nodiscard]] IntegratorState collected(const Ranks& ranks, IntegratorState state) {
    if (ranks.is_one()) return state;
    for (auto* values : arrays_of(state)) *values = ranks.collect(*values, Dim);
    return state;
}

/// The other way round: the points of this rank, of a state of all of them. One with another number of points stays as it
/// is: whoever restores it says so.
template <int Dim>
[[nodiscard]] IntegratorState own_of(const Ranks& ranks, IntegratorState state) {
    if (ranks.is_one()) return state;
    const auto n_points = static_cast<std::size_t>(ranks.n_points());
    for (auto* values : arrays_of(state)) {
        if (values->size() != n_points * Dim) return state;
        std::vector<double> own;
        for (const std::int32_t number : ranks.numbers())
            own.insert(own.end(), values->begin() + number * Dim, values->begin() + (number + 1) * Dim);
        *values = std::move(own);
    }
    return state;
}

}  // namespace abut::dynamics
