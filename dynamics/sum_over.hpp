#pragma once
// Private to the sources of the layers.
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::dynamics {

/// Sum of term(i) over the values of a system, i being numbered on this rank (n of them, which `summands` choose):
/// `ordered_sum` over those of all ranks. `Value` is a double or a vector.
template <class Value, class Term>
[[nodiscard]] Value sum_over(const Ranks& ranks, Summands summands, std::ptrdiff_t n, const Value& zero, const Term& term) {
    if (ranks.is_one()) return ordered_sum(n, zero, term);
    const auto as_numbers = [](auto& value) {
        if constexpr (std::is_same_v<Value, double>)
            return std::span(&value, 1);
        else
            return std::span(value.data(), static_cast<std::size_t>(value.size()));
    };
    Value total = zero;
    summands.width = static_cast<std::int32_t>(as_numbers(total).size());
    std::vector<double> terms;
    terms.reserve(static_cast<std::size_t>(n * summands.width));
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const Value value = term(i);
        const auto numbers = as_numbers(value);
        terms.insert(terms.end(), numbers.begin(), numbers.end());
    }
    ranks.sum(summands, terms, as_numbers(total));
    return total;
}

}  // namespace abut::dynamics
