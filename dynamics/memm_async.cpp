#include "abut/dynamics/memm_async.hpp"

#include <string>

#include "abut/base/error.hpp"

namespace abut::dynamics::detail {

void check_local_steps(const LocalSteps& steps, std::size_t size) {
    const auto refuse = [](const std::string& what, const ErrorFacts& facts) {
        throw BadInput("local steps: " + what, facts);
    };
    if (steps.parts.empty() || steps.parts.front() != 1)
        refuse("level 0 must take 1 step in a step of the scheme.",
               {.value = steps.parts.empty() ? 0.0 : steps.parts.front(), .allowed = 1.0});
    for (std::size_t l = 1; l < steps.parts.size(); ++l)
        if (steps.parts[l] <= steps.parts[l - 1] || steps.parts[l] % steps.parts[l - 1] != 0)
            refuse("level " + std::to_string(l) + " takes " + std::to_string(steps.parts[l]) + " steps and level " +
                       std::to_string(l - 1) + " takes " + std::to_string(steps.parts[l - 1]) +
                       "; each must be a larger multiple of the one before, as 1, 2, 4.",
                   {.value = static_cast<double>(steps.parts[l])});
    if (steps.level.size() != size)
        refuse(std::to_string(steps.level.size()) + " levels are given for " + std::to_string(size) +
                   " degrees of freedom; give one each.",
               {.value = static_cast<double>(steps.level.size()), .allowed = static_cast<double>(size)});
    for (std::size_t i = 0; i < size; ++i)
        if (steps.level[i] < 0 || static_cast<std::size_t>(steps.level[i]) >= steps.parts.size())
            refuse("degree of freedom " + std::to_string(i) + " is on level " + std::to_string(steps.level[i]) + "; 0 to " +
                       std::to_string(steps.parts.size() - 1) + " is allowed.",
                   {.value = static_cast<double>(steps.level[i]), .allowed = static_cast<double>(steps.parts.size() - 1)});
}

}  // namespace abut::dynamics::detail
