#include "studies/trade/ladder.hpp"

#include <algorithm>

#include "apps/support/contact_choices.hpp"
#include "apps/support/preset.hpp"

namespace abut::studies::trade {
namespace {

/// An option and its values except the default.
struct Axis {
    std::string option;
    std::vector<std::string> values;
    bool at_rest = false;  ///< bodies at rest depend on it, too
};

std::vector<std::string> other_broad_phases() {
    std::vector<std::string> names;
    for (const auto& [name, method] : apps::broad_phases)
        if (method != run::RunOptions{}.contact.search.broad_phase) names.push_back(name);
    return names;
}

const std::vector<Axis>& axes() {
    static const std::vector<Axis> all = {{"--broad-phase", other_broad_phases(), true},
                                          {"--overlap", {"frozen"}},
                                          {"--weights", {"half"}, true},
                                          {"--events", {"off"}},
                                          {"--quadrature", {"1", "2", "3"}},
                                          {"--area", {"exact"}, true},
                                          {"--neumann", {"extrapolate", "adjacent"}, true},
                                          {"--corners", {"fixed"}, true},
                                          {"--cfl", {"0.3", "0.6"}},
                                          {"--filter", {"neutral"}},
                                          {"--integrator", {"memm_async", "leapfrog", "bilbao"}}};
    return all;
}

using Factor = std::vector<std::string>;  // words of one option, "" for its default

/// All ways to take one of each factor.
std::vector<Setting> product(const std::vector<Factor>& factors) {
    std::vector<Setting> all = {""};
    for (const Factor& factor : factors) {
        std::vector<Setting> longer;
        for (const Setting& setting : all)
            for (const std::string& word : factor)
                longer.push_back(setting.empty() || word.empty() ? setting + word : setting + " " + word);
        all = std::move(longer);
    }
    return all;
}

void append_new(std::vector<Setting>& settings, const std::vector<Setting>& more) {
    for (const Setting& setting : more)
        if (std::ranges::find(settings, setting) == settings.end()) settings.push_back(setting);
}

}  // namespace

std::vector<Setting> ladder(Extent extent, bool at_rest) {
    std::vector<Setting> settings = {""};
    for (const Axis& axis : axes())
        for (const std::string& value : axis.values)
            if (axis.at_rest || !at_rest) settings.push_back(axis.option + " " + value);
    if (at_rest) return settings;
    for (const auto& [name, preset] : apps::presets) append_new(settings, {apps::words_of(preset)});
    if (extent == Extent::each) return settings;
    const Factor cfl = {"", "--cfl 0.3", "--cfl 0.6"};
    append_new(settings, product({{"", "--overlap frozen"}, {"", "--events off"}, {"", "--quadrature 1"}, cfl}));
    append_new(settings, product({cfl, {"", "--filter neutral"}}));
    return settings;
}

}  // namespace abut::studies::trade
