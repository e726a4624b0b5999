#pragma once
#include <string>

#include "apps/support/choices.hpp"
#include "apps/support/run_options.hpp"

namespace abut::apps {

/// Settings of all that trades speed for accuracy, under a name. What each costs and gives is in docs/trade.md. None says what
/// bodies are (`kinematics`) or what acts between them (`law`), and all go with any of these.
enum class Preset {
    fast,      ///< the longest stable step, nothing cut at events: pseudo-energy drifts a little
    balanced,  ///< pseudo-energy to round-off; the defaults
    exact,     ///< the smallest error of the motion on a given mesh
};

inline const Choices<Preset> presets = {{"fast", Preset::fast}, {"balanced", Preset::balanced}, {"exact", Preset::exact}};

/// What a user would type instead of --preset NAME, "" for the defaults.
[[nodiscard]] std::string words_of(Preset preset);

/// Takes options of time and contact as they would be typed, a preset among them; all else stays. Throws
/// BadInput naming the words that no program would take.
void apply_words(const std::string& words, run::RunOptions& options);

/// --preset. To be added before the options that a preset chooses: those on the command line then win, wherever they stand.
void add_preset_option(CLI::App& app, run::RunOptions& options);

}  // namespace abut::apps
