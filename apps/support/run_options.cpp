#include "apps/support/run_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/run/option_table.hpp"
#include "apps/support/command_line.hpp"

namespace abut::apps {
namespace {

using run::RunOptions;

template <class Wanted>
void add_wanted(CommandParser& parser, RunOptions& options, OptionDepth deepest, const Wanted& wanted) {
    for (const Option<RunOptions>& option : run::run_options()) {
        if (!option.places.command_line || option.depth > deepest || !wanted(option)) continue;
        Flag added = add_option(parser, bound(option, options));
        if (deepest == OptionDepth::expert && option.depth == OptionDepth::expert) added.rarely_needed();
    }
}

void add_group(CommandParser& parser, RunOptions& options, OptionDepth deepest, const char* group) {
    add_wanted(parser, options, deepest, [&](const OptionFacts& option) { return option.group == group; });
}

Flag add_named(CommandParser& parser, RunOptions& options, const std::string& name) {
    return add_option(parser, bound(named(run::run_options(), name), options));
}

}  // namespace

void add_time_options(CommandParser& parser, RunOptions& options, const std::string& default_of_time, OptionDepth deepest) {
    BoundOption time = bound(named(run::run_options(), "time"), options);
    OptionFacts told = *time.facts;
    told.by_default = default_of_time;
    time.facts = &told;
    const Flag end = add_option(parser, time);
    add_wanted(parser, options, deepest,
               [](const OptionFacts& option) { return option.group == "Time" && option.name != "time"; });
    parser.at("--steps").excludes(end);
    parser.at("--dt").excludes(parser.at("--cfl"));
    parser.at("--allow-unstable").needs(parser.at("--dt"));
}

void add_contact_options(CommandParser& parser, RunOptions& options, OptionDepth deepest) {
    add_group(parser, options, deepest, "Contact");
}

void add_model_options(CommandParser& parser, RunOptions& options) {
    add_wanted(parser, options, OptionDepth::laboratory, [](const OptionFacts& option) { return option.shapes_rest; });
}

void take_laboratory(const std::vector<std::string>& keys, RunOptions& options) {
    CommandParser parser;
    std::vector<std::string> known;
    for (const Option<RunOptions>& option : run::run_options()) {
        if (option.depth != OptionDepth::laboratory) continue;
        add_option(parser, bound(option, options));
        known.push_back(option.scene_key());
    }
    for (const std::string& key : keys) {
        const std::string name = key.substr(0, key.find('='));
        if (name.size() == key.size() || key.find(' ') != std::string::npos || std::ranges::find(known, name) == known.end())
            throw BadInput(
                fmt::format("--lab: '{}' is no KEY=VALUE of [laboratory]. Its keys are {}.", key, fmt::join(known, ", ")));
        std::string flag = "--" + key;
        std::replace(flag.begin(), flag.begin() + static_cast<std::ptrdiff_t>(name.size()) + 2, '_', '-');
        try {
            parser.parse(flag);
        } catch (const BadInput& error) {
            const std::string option = flag.substr(0, name.size() + 2) + ": ";
            std::string what = error.what();
            if (what.starts_with(option)) what.erase(0, option.size());
            throw_again(error, fmt::format("--lab {}: {}", key, what));
        }
    }
}

std::string where_in_laboratory(const std::string& option) {
    std::string key = option;
    std::ranges::replace(key, '-', '_');
    for (const Option<RunOptions>& one : run::run_options())
        if (one.depth == OptionDepth::laboratory && one.scene_key() == key)
            return fmt::format(" It compares methods: --lab {}=VALUE.", key);
    return "";
}

void add_compression_limit(CommandParser& parser, RunOptions& options) { add_named(parser, options, "compression_limit"); }

void add_ranks_options(CommandParser& parser, RunOptions& options) {
    for (const char* name : {"ranks", "rebalance", "rebalance_above"}) add_named(parser, options, name);
}

void add_output_options(CommandParser& parser, RunOptions& options, OptionDepth deepest) {
    add_group(parser, options, deepest, "Output");
    parser.at("--times").excludes(parser.at("--frames"));
}

}  // namespace abut::apps
