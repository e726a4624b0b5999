#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "abut/input/scene_file.hpp"
#include "apps/support/messages.hpp"

namespace abut::apps {

/// A key of a scene and the values that it takes in turn.
struct Sweep {
    std::string key;
    std::vector<std::string> values;
};

/// Reads "bodies.left.density=1,2,4"; commas within brackets and quotation marks part nothing. Throws BadInput for a text
/// without a key or a value, and for a key that comes twice.
[[nodiscard]] std::vector<Sweep> read_sweeps(const std::vector<std::string>& texts);

/// Runs a scene with each value, or with all combinations of several keys, the last one varying fastest. Each run has a
/// folder of its own in RunOptions::out, run_1 and so on, and a row in sweep.csv there, which is rewritten after each:
/// values, state, main figures, and the message of a run that did not end. States are held (it ended), stopped (by a signal,
/// which ends the sweep as well), refused (BadInput), diverged (Diverged, TooDeep) and failed (all else). `run_one` runs a
/// scene into its folder. A table is printed where messages are normal. Throws BadInput at the end if a run did not end
/// well.
void run_sweep(const std::filesystem::path& scene, const input::Overrides& overrides, const std::vector<Sweep>& sweeps,
               Messages messages, const std::function<void(const input::SceneFile&)>& run_one);

}  // namespace abut::apps
