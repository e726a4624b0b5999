#pragma once
// Private to the layer.
#include <string>
#include <vector>

#include "abut/run/options.hpp"

namespace abut::run {

/// "a lower --cfl, --filter neutral or --restart 50": choices that take the alternating mode out of a run, without
/// those that act in it already.
[[nodiscard]] inline std::string calming_choices(const RunOptions& options) {
    std::vector<std::string> choices{"a lower --cfl"};
    if (!options.filter) choices.emplace_back("--filter neutral");
    if (options.restart == 0) choices.emplace_back("--restart 50");
    std::string text = choices.front();
    for (std::size_t i = 1; i < choices.size(); ++i) text += (i + 1 == choices.size() ? " or " : ", ") + choices[i];
    return text;
}

}  // namespace abut::run
