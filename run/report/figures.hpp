#pragma once
// Private to the sources of run.
#include <string>
#include <utility>
#include <vector>

#include "abut/run/drawing/markup.hpp"
#include "abut/run/files/json.hpp"
#include "abut/run/values/energy_scale.hpp"

namespace abut::run {

/// Figures of a summary as they stand in a report.
class Figures {
public:
    explicit Figures(Json summary) : summary_(std::move(summary)) {}

    [[nodiscard]] const Json& summary() const { return summary_; }

    /// Value of the summary at a path, bodies.0.mass: numbers with six digits, or two if `rough`; lists with commas; a dash
    /// for nothing. Throws Misuse if there is nothing at that path.
    [[nodiscard]] Markup at(const std::string& path, bool rough = false) const;
    /// The number at that path; NaN where it is not known.
    [[nodiscard]] double number(const std::string& path) const;
    /// "3.7e-15", an energy at a path over the scale.
    [[nodiscard]] Markup over(const std::string& path, const EnergyScale& scale) const;

private:
    [[nodiscard]] const Json& find(const std::string& path) const;

    Json summary_;
};

/// A value for people.
[[nodiscard]] std::string shown(const Json& value, bool rough = false);

}  // namespace abut::run
