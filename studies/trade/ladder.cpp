#include "studies/trade/ladder.hpp"

#include <algorithm>

#include "apps/support/contact_choices.hpp"
#include "apps/support/preset.hpp"

namespace abut::studies::trade {
namespace {

/// Scope of an option: what it is a choice of.
enum class Of {
    reconstruction,  ///< the modified reconstruction in motion
    model,           ///< the same, at rest, too
    bulk,            ///< all bodies, at rest, too
    run,             ///< all runs in time
};

/// An option and its values except the default.
struct Axis {
    std::string option;
    std::vector<std::string> values;
    Of of;
};

std::vector<std::string> other_broad_phases() {
    std::vector<std::string> names;
    for (const auto& [name, method] : apps::broad_phases)
        if (method != run::RunOptions{}.contact.search.broad_phase) names.push_back(name);
    return names;
}

const std::vector<Axis>& axes() {
    static const std::vector<Axis> all = {{"--broad-phase", other_broad_phases(), Of::bulk},
                                          {"--overlap", {"frozen"}, Of::reconstruction},
                                          {"--weighting", {"half"}, Of::model},
                                          {"--events", {"off"}, Of::run},
                                          {"--quadrature", {"1", "2", "3"}, Of::reconstruction},
                                          {"--area", {"exact"}, Of::model},
                                          {"--free-faces", {"extrapolate", "adjacent"}, Of::bulk},
                                          {"--corners", {"fixed"}, Of::bulk},
                                          {"--cfl", {"0.3", "0.6"}, Of::run},
                                          {"--filter", {"neutral"}, Of::run},
                                          {"--precision", {"single"}, Of::run},
                                          {"--integrator", {"memm_async", "leapfrog", "bilbao"}, Of::run}};
    return all;
}

bool matters(Of of, Motion motion) {
    switch (motion) {
        case Motion::at_rest:
            return of == Of::model || of == Of::bulk;
        case Motion::translating:
            return true;
        case Motion::turning:
            return of == Of::bulk || of == Of::run;
    }
    return false;
}

/// Kinematics and laws except those of the defaults.
std::vector<Setting> kinematics(Motion motion) {
    if (motion == Motion::translating) return {"--law pair_potential", "--kinematics floating", "--kinematics rigid"};
    return {"--kinematics small", "--kinematics small --law pair_potential", "--kinematics rigid"};
}

/// Presets by themselves, and beside bodies that float.
std::vector<Setting> of_presets(Motion motion) {
    std::vector<Setting> settings;
    for (const auto& [name, preset] : apps::presets) settings.push_back(apps::words_of(preset));
    if (motion == Motion::translating)
        for (const apps::Preset preset : {apps::Preset::fast, apps::Preset::exact})
            settings.push_back(apps::words_of(preset) + " --kinematics floating");
    return settings;
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

std::vector<Setting> ladder(Extent extent, Motion motion) {
    std::vector<Setting> settings = {""};
    if (extent != Extent::kinematics)
        for (const Axis& axis : axes())
            for (const std::string& value : axis.values)
                if (matters(axis.of, motion)) settings.push_back(axis.option + " " + value);
    if (motion == Motion::at_rest) return settings;
    append_new(settings, kinematics(motion));
    append_new(settings, of_presets(motion));
    if (extent != Extent::products) return settings;
    const Factor cfl = {"", "--cfl 0.3", "--cfl 0.6"};
    if (motion == Motion::translating)
        append_new(settings, product({{"", "--overlap frozen"}, {"", "--events off"}, {"", "--quadrature 1"}, cfl}));
    append_new(settings, product({cfl, {"", "--filter neutral"}}));
    return settings;
}

}  // namespace abut::studies::trade
