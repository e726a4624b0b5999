#pragma once
#include <array>

#include "abut/base/option.hpp"
#include "abut/run/options.hpp"

namespace abut::run {

/// Settings of all that trades speed for accuracy, under a name. What each costs and gives is in docs/trade.md. None says
/// what bodies are (`kinematics`) or what acts between them (`law`), and all go with any of these.
enum class Preset {
    fast,      ///< the longest stable step, nothing cut at events: pseudo-energy drifts a little
    balanced,  ///< pseudo-energy to round-off; the defaults
    exact,     ///< the smallest error of the motion on a given mesh
};

inline constexpr std::array<Word<Preset>, 3> preset_words{
    {{"fast", Preset::fast}, {"balanced", Preset::balanced}, {"exact", Preset::exact}}};

/// Sets what the preset is about; all else stays.
void apply(Preset preset, RunOptions& options);

}  // namespace abut::run
