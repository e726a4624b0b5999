#pragma once
// Private to the layer.
#include <cstdint>
#include <exception>
#include <vector>

#include "abut/dynamics/ranks.hpp"

/// What a run on several ranks brings together; on one rank all of it is here already.
namespace abut::run {

/// Calls body() on rank 0, and agrees with the others on how it ended.
template <class Body>
void on_first(const dynamics::Ranks& ranks, const Body& body) {
    dynamics::agreed(ranks, [&] {
        if (ranks.rank() == 0) body();
    });
}

/// Values that make() gives on rank 0, on all ranks; what it throws there is thrown on all.
template <class Make>
[[nodiscard]] std::vector<double> values_of_first(const dynamics::Ranks& ranks, const Make& make) {
    std::vector<double> values;
    on_first(ranks, [&] { values = make(); });
    return ranks.gather(values);
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

}  // namespace abut::run
