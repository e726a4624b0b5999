#pragma once
#include <array>

#include "abut/base/option.hpp"
#include "abut/run/options.hpp"
#include "abut/run/values/value.hpp"

namespace abut::run {

inline constexpr std::array<Word<SolidIntegrator>, 4> integrator_words{{{"memm", SolidIntegrator::memm},
                                                                        {"memm_async", SolidIntegrator::memm_async},
                                                                        {"leapfrog", SolidIntegrator::leapfrog},
                                                                        {"bilbao", SolidIntegrator::bilbao}}};
inline constexpr std::array<Word<BodyKinematics>, 6> kinematics_words{{{"scene", BodyKinematics::scene},
                                                                       {"automatic", BodyKinematics::automatic},
                                                                       {"small", BodyKinematics::small},
                                                                       {"floating", BodyKinematics::floating},
                                                                       {"finite", BodyKinematics::finite},
                                                                       {"rigid", BodyKinematics::rigid}}};
inline constexpr std::array<Word<FrameFormat>, 2> format_words{{{"vtu", FrameFormat::vtu}, {"xdmf", FrameFormat::xdmf}}};
inline constexpr std::array<Word<bool>, 2> filter_words{{{"none", false}, {"neutral", true}}};

/// All options of a run, in the order of help texts, keys and summaries: command lines, the tables [run], [contact] and
/// [output] of scenes, abut.solid of Python, summaries, and the checks of single values are made from this list.
[[nodiscard]] const OptionList<RunOptions>& run_options();

/// Names and values for a summary, as OptionTraits::named says. `scheme`: that of the owner.
template <class Owner>
[[nodiscard]] NamedValues named_values(const OptionList<Owner>& options, const Owner& owner, const std::string& scheme);
/// Values of the options of a run; of `dt` and `cfl` the one that decided. The end of the run, the skin and the threads
/// are in RunResult.
[[nodiscard]] NamedValues named_values(const RunOptions& options);
/// The options on which bodies at rest depend as well: "weighting", "area", "free_faces", "corners".
[[nodiscard]] NamedValues model_values(const RunOptions& options);

/// As a summary shows it.
[[nodiscard]] Value value_of(const OptionFacts& option, const OptionValue& value);

// Implementation ------------------------------------------------------------------------------------------------------

/// Whether a summary names an option of this value.
[[nodiscard]] bool is_named(const OptionFacts& option, const OptionValue& value, const OptionValue& by_default,
                            const std::string& scheme);

template <class Owner>
NamedValues named_values(const OptionList<Owner>& options, const Owner& owner, const std::string& scheme) {
    const Owner plain{};
    NamedValues values;
    for (const Option<Owner>& option : options)
        if (const OptionValue value = option.get(owner); is_named(option, value, option.get(plain), scheme))
            values.push_back({option.name, value_of(option, value)});
    return values;
}

}  // namespace abut::run
