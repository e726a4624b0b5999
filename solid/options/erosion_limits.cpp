#include "abut/solid/options/erosion_limits.hpp"

#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/solid/options/number_tables.hpp"

namespace abut::solid {

bool any_erosion(std::span<const ErosionLimits> limits) { return std::ranges::any_of(limits, &ErosionLimits::any); }

void check_erosion(const std::string& mesh, std::span<const ErosionLimits> limits, std::span<const std::string> bodies) {
    if (!limits.empty() && limits.size() != bodies.size())
        throw BadInput(mesh + ": limits of erosion are given for " + std::to_string(limits.size()) + " bodies of " +
                           std::to_string(bodies.size()) + ". Give one set per body, or none.",
                       {.value = static_cast<double>(limits.size()), .allowed = static_cast<double>(bodies.size())});
    for (std::size_t body = 0; body < limits.size(); ++body)
        require_allowed(mesh + ": erosion of body '" + bodies[body] + "': ", erosion_numbers, limits[body]);
}

}  // namespace abut::solid
