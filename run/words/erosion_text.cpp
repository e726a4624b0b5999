#include "abut/run/words/erosion_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/run/result.hpp"

namespace abut::run {
namespace {

struct ReasonWords {
    solid::LeavingReason reason;
    const char* word;    // as a key
    const char* clause;  // behind a number
};
constexpr std::array reasons{ReasonWords{solid::LeavingReason::strain, "strain", "by strain"},
                             ReasonWords{solid::LeavingReason::plastic_strain, "plastic_strain", "by plastic strain"},
                             ReasonWords{solid::LeavingReason::stress, "stress", "by stress"},
                             ReasonWords{solid::LeavingReason::function, "function", "by a function"},
                             ReasonWords{solid::LeavingReason::remnant, "remnant", "as remnants"}};

}  // namespace

template <int Dim>
ErodedShares eroded_shares(const RunResult<Dim>& result) {
    double mass = 0.0;
    for (const solid::BodyMotion<Dim>& body : result.bodies.start) mass += body.mass;
    const double energy = result.energy.accounts.energy_in_play;
    const dynamics::Left<Dim>& left = result.erosion.left;
    return {.mass = mass > 0.0 ? left.mass / mass : 0.0, .energy = energy > 0.0 ? std::abs(left.energy()) / energy : 0.0};
}

std::vector<ErodedCount> eroded_counts(std::span<const ErodedCell> cells) {
    std::vector<ErodedCount> counts;
    for (const ReasonWords& words : reasons)
        counts.push_back({words.word, std::ranges::count(cells, words.reason, &ErodedCell::reason)});
    return counts;
}

template <int Dim>
std::string erosion_text(const RunResult<Dim>& result) {
    const std::vector<ErodedCell>& cells = result.erosion.cells;
    if (cells.empty()) return "";
    std::vector<std::string> parts;
    for (const ReasonWords& words : reasons)
        if (const auto n = std::ranges::count(cells, words.reason, &ErodedCell::reason); n > 0)
            parts.push_back(fmt::format("{} {}", n, words.clause));
    const ErodedShares shares = eroded_shares(result);
    return fmt::format("{}, {:.3g} % of the mass, {:.3g} % of the energy in play: {}", counted(std::ssize(cells), "cell"),
                       100.0 * shares.mass, 100.0 * shares.energy, fmt::join(parts, ", "));
}

#define ABUT_INSTANTIATE(Dim)                                               \
    template ErodedShares eroded_shares<Dim>(const RunResult<Dim>& result); \
    template std::string erosion_text<Dim>(const RunResult<Dim>& result);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
