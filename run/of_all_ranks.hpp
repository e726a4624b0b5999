#pragma once
// Private to the layer.
#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/ranks.hpp"

/// What a run on several ranks brings together, and shares out again; on one rank all of it is here already.
namespace abut::run {

/// Calls body() on rank 0, and agrees with the others on how it ended.
template <class Body>
void on_first(const dynamics::Ranks& ranks, const Body& body) {
    dynamics::agreed(ranks, [&] {
        if (ranks.rank() == 0) body();
    });
}

/// The number that question() gives on rank 0, on all of them: one message. It is >= 0, and exact in a double.
template <class Question>
[[nodiscard]] std::int64_t first_says(const dynamics::Ranks& ranks, const Question& question) {
    constexpr double failed = -1.0, silent = -2.0;
    double answer = silent;
    std::exception_ptr error;
    if (ranks.rank() == 0) {
        try {
            answer = static_cast<double>(question());
        } catch (...) {
            error = std::current_exception();
            answer = failed;
        }
    }
    answer = ranks.largest(answer);
    if (answer == failed) ranks.agree(error);
    return static_cast<std::int64_t>(answer);
}

/// The arrays of a state by point.
inline auto arrays_of(dynamics::IntegratorState& state) {
    return std::array<std::vector<double>*, 3>{&state.q, &state.p_before, &state.p_after};
}

/// A state with the points of all ranks, on rank 0; without points on the others.
template <int Dim>
[[nodiscard]] dynamics::IntegratorState collected(const dynamics::Ranks& ranks, dynamics::IntegratorState state) {
    if (ranks.is_one()) return state;
    for (auto* values : arrays_of(state)) *values = ranks.collect(*values, Dim);
    return state;
}

/// The same on all of them.
template <int Dim>
[[nodiscard]] dynamics::IntegratorState gathered(const dynamics::Ranks& ranks, dynamics::IntegratorState state) {
    const std::vector<double> numbers = ranks.gather(std::vector<double>(ranks.numbers().begin(), ranks.numbers().end()));
    for (auto* values : arrays_of(state)) {
        const std::vector<double> by_rank = ranks.gather(*values);
        values->resize(by_rank.size());
        for (std::size_t i = 0; i < by_rank.size(); ++i)
            (*values)[static_cast<std::size_t>(numbers[i / Dim]) * Dim + i % Dim] = by_rank[i];
    }
    return state;
}

/// The points of this rank, of a state of all of them.
template <int Dim>
[[nodiscard]] dynamics::IntegratorState own_of(const dynamics::Ranks& ranks, dynamics::IntegratorState state) {
    const auto n_points = static_cast<std::size_t>(ranks.n_points());
    for (auto* values : arrays_of(state)) {
        if (values->size() != n_points * Dim) return state;  // of another solid: whoever restores it says so
        std::vector<double> own;
        for (const std::int32_t number : ranks.numbers())
            own.insert(own.end(), values->begin() + number * Dim, values->begin() + (number + 1) * Dim);
        *values = std::move(own);
    }
    return state;
}

}  // namespace abut::run
