#pragma once
#include <string>

#include "support/choices.hpp"
#include "support/run_options.hpp"

namespace abut::examples {

/// Settings of all that trades speed for accuracy, under a name. What each costs and gives is in docs/trade.md.
enum class Preset {
    fast,      ///< energy drifts while bodies slip
    balanced,  ///< pseudo-energy to round-off; the defaults
    exact,     ///< the smallest error of the motion on a given mesh
};

inline const Choices<Preset> presets = {{"fast", Preset::fast}, {"balanced", Preset::balanced}, {"exact", Preset::exact}};

/// What a user would type instead of --preset NAME, "" for the defaults.
[[nodiscard]] std::string words_of(Preset preset);

/// Sets what the preset chooses; all else stays.
void apply(Preset preset, RunOptions& options);

/// --preset. To be added before the options that a preset chooses: those on the command line then win, wherever they stand.
void add_preset_option(CLI::App& app, RunOptions& options);

}  // namespace abut::examples
