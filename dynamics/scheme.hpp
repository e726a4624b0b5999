#pragma once
#include <array>
#include <string>

namespace abut::dynamics {

/// The schemes in time. docs/integrators.md says which to choose.
enum class Scheme { memm, memm_async, leapfrog, bilbao, energy_momentum };

/// Their names on command lines, in scenes and in results.
struct SchemeName {
    const char* name;
    Scheme scheme;
};
inline constexpr std::array<SchemeName, 5> scheme_names{{{"memm", Scheme::memm},
                                                         {"memm_async", Scheme::memm_async},
                                                         {"leapfrog", Scheme::leapfrog},
                                                         {"bilbao", Scheme::bilbao},
                                                         {"energy_momentum", Scheme::energy_momentum}}};

/// "memm"
[[nodiscard]] inline std::string name_of(Scheme scheme) {
    for (const auto& [name, named] : scheme_names)
        if (named == scheme) return name;
    return "";
}

}  // namespace abut::dynamics
