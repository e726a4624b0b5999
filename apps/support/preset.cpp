#include "apps/support/preset.hpp"
#include "apps/support/command_line.hpp"

#include <fmt/format.h>

#include <variant>

#include "abut/base/error.hpp"
#include "abut/run/option_table.hpp"

namespace abut::apps {
namespace {

std::string text_of(const run::Value& value) {
    if (const double* number = std::get_if<double>(&value)) return shown(*number);
    return std::get<std::string>(value);
}

}  // namespace

std::string words_of(Preset preset, OptionDepth deepest) {
    run::RunOptions options;
    const auto word = [&](const run::NamedValue& value) {
        const bool is_in_laboratory = named(run::run_options(), value.name).depth > deepest;
        return is_in_laboratory ? fmt::format("--lab {}={}", value.name, text_of(value.value))
                                : fmt::format("--{} {}", value.name, text_of(value.value));
    };
    const run::NamedValues before = run::named_values(options);
    run::apply(preset, options);
    const run::NamedValues after = run::named_values(options);
    std::string words;
    for (std::size_t i = 0; i < after.size(); ++i)
        if (after[i].value != before[i].value) words += (words.empty() ? "" : " ") + word(after[i]);
    return words;
}

void apply_words(const std::string& words, run::RunOptions& options) {
    CommandParser parser;
    parser.take_no_help();
    add_preset_option(parser, options);
    add_time_options(parser, options, "");
    add_contact_options(parser, options);
    try {
        parser.parse(words);
    } catch (const BadInput& error) {
        throw BadInput(fmt::format("'{}': {} Take options of the groups Preset, Time and Contact of abut run --help.", words,
                                   error.what()));
    }
}

void add_preset_option(CommandParser& parser, run::RunOptions& options, OptionDepth deepest) {
    std::vector<std::string> names;
    for (const auto& [name, preset] : presets) names.push_back(name);
    const auto choose = [&options](const std::string& text) {
        for (const auto& [name, preset] : presets)
            if (name == text) run::apply(preset, options);
    };
    add_word(parser, "--preset", choose,
             "several choices at once, which other options overrule (docs/trade.md): fast is " +
                 words_of(Preset::fast, deepest) + ", exact is " + words_of(Preset::exact, deepest),
             names, "balanced")
        .group("Preset");
}

}  // namespace abut::apps
