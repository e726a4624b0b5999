#pragma once
#include <string>

#include "abut/run/values/forward.hpp"
#include "abut/run/words/warnings.hpp"

namespace abut::run {

/// Verdict on a finished run, in a few sentences that are the same everywhere.
struct Verdict {
    bool
        good;  ///< it came to its end, H~ is kept to round-off, nothing warns, and where anything has moved some of the bodies that could
    ///< touch have
    std::string text;
};

template <int Dim>
[[nodiscard]] Verdict verdict(const Scene<Dim>& scene, const RunResult<Dim>& result);

/// Warnings of warnings_before and of warnings_after.
template <int Dim>
[[nodiscard]] std::vector<Warning> all_warnings(const Scene<Dim>& scene, const RunResult<Dim>& result);

/// Words behind the drift of momentum, or in place of it: ", less what gravity has given", "not conserved: supports".
template <int Dim>
[[nodiscard]] std::string momentum_note(const RunResult<Dim>& result);
/// Words behind the drift of angular momentum.
template <int Dim>
[[nodiscard]] std::string moment_note(const RunResult<Dim>& result);
/// The largest change of momentum that nothing from outside explains [kg m/s]; NaN where what acts is not accounted for.
template <int Dim>
[[nodiscard]] double momentum_drift(const RunResult<Dim>& result);

}  // namespace abut::run
