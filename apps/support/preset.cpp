#include "apps/support/preset.hpp"

#include <fmt/format.h>

#include "abut/base/error.hpp"

namespace abut::apps {

std::string words_of(Preset preset) {
    switch (preset) {
        case Preset::fast:
            return "--cfl 0.99 --events off";
        case Preset::balanced:
            return "";
        case Preset::exact:
            return "--cfl 0.3 --filter neutral";
    }
    throw BadInput("not a Preset");
}

void apply_words(const std::string& words, run::RunOptions& options) {
    CLI::App app;
    app.set_help_flag();
    add_preset_option(app, options);
    add_time_options(app, options, "");
    add_contact_options(app, options);
    try {
        app.parse(words, false);
    } catch (const CLI::ParseError& error) {
        throw BadInput(
            fmt::format("'{}': {} Take options of the groups Preset, Time and Contact of slipping_cylinders --help.", words,
                        error.what()));
    }
}

void add_preset_option(CLI::App& app, run::RunOptions& options) {
    std::vector<std::string> names;
    for (const auto& [name, preset] : presets) names.push_back(name);
    const auto choose = [&options](const std::string& text) {
        for (const auto& [name, preset] : presets)
            if (name == text) apply_words(words_of(preset), options);
    };
    app.add_option_function<std::string>("--preset", choose,
                                         "several choices at once, which other options overrule (docs/trade.md): fast is " +
                                             words_of(Preset::fast) + ", exact is " + words_of(Preset::exact))
        ->check(one_of(names))
        ->type_name(joined(names))
        ->default_str("balanced")
        ->group("Preset");
}

}  // namespace abut::apps
