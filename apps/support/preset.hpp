#pragma once
#include <string>

#include "abut/run/steps/preset.hpp"
#include "apps/support/choices.hpp"
#include "apps/support/run_options.hpp"

namespace abut::apps {

using run::Preset;

inline const Choices<Preset> presets = choices_of(run::preset_words);

/// Options that a user would type instead of --preset NAME, "" for the defaults. Those that lie deeper are keys of --lab.
[[nodiscard]] std::string words_of(Preset preset, OptionDepth deepest = OptionDepth::laboratory);

/// Takes options of time and contact as they would be typed, a preset among them; all else stays. Throws
/// BadInput naming the words that no program would take.
void apply_words(const std::string& words, run::RunOptions& options);

/// --preset. To be added before the options that a preset chooses: those on the command line then win, wherever they stand.
void add_preset_option(CommandParser& parser, run::RunOptions& options, OptionDepth deepest = OptionDepth::laboratory);

}  // namespace abut::apps
