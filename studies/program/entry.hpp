#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/support/program.hpp"
#include "studies/program/flags.hpp"

namespace abut::studies {

/// A study in the list of the program: what `study NAME` runs.
struct Entry {
    std::string name;
    std::string purpose;                            ///< a sentence
    std::function<int(int argc, char** argv)> run;  ///< as a main function, argv[0] is the name
};

/// Puts a study on the list of the program. A new study is one more source, with a line at its end:
///     const bool is_listed = list(entry_of(program, Options{}, add_options, run));
bool list(Entry study);
/// All studies of the list, by name.
[[nodiscard]] std::vector<Entry> all_studies();

/// A study as messages name it, "study hertz".
[[nodiscard]] apps::Program as_typed(apps::Program study);

/// The body of `Entry::run`, as apps::run_program. `typed` is what `as_typed` returned, and outlives the call.
int run_command(const apps::Program& typed, int argc, char** argv, const std::function<void(Flags&)>& add_options,
                const std::function<void()>& body);

/// A study that is its options: `add_options(flags, options)` offers them, `run(options)` does the rest.
template <class Options, class AddOptions, class Run>
[[nodiscard]] Entry entry_of(const apps::Program& study, const Options& defaults, AddOptions add_options, Run run) {
    return {study.name, study.purpose, [=, typed = as_typed(study)](int argc, char** argv) {
                Options options = defaults;
                return run_command(
                    typed, argc, argv, [&](Flags& flags) { add_options(flags, options); }, [&] { run(options); });
            }};
}

}  // namespace abut::studies
