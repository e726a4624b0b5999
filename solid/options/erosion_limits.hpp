#pragma once
#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace abut::solid {

/// Limits beyond which a cell of a body leaves the run; what is infinite counts not. All > 0.
struct ErosionLimits {
    static constexpr double none = std::numeric_limits<double>::infinity();
    double strain = none;          ///< largest principal strain, of finite bodies the largest stretch less 1 [-]
    double plastic_strain = none;  ///< equivalent one [-]
    double stress = none;          ///< largest principal stress, tension > 0 [Pa]

    [[nodiscard]] bool any() const { return strain < none || plastic_strain < none || stress < none; }
};

/// Whether any body has limits.
[[nodiscard]] bool any_erosion(std::span<const ErosionLimits> limits);
/// Throws BadInput with `mesh` in front for another number of them than bodies, of which it has the names, unless there
/// are none, and for a limit that is not > 0.
void check_erosion(const std::string& mesh, std::span<const ErosionLimits> limits, std::span<const std::string> bodies);

}  // namespace abut::solid
