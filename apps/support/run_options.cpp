#include "apps/support/run_options.hpp"

#include "abut/run/option_table.hpp"
#include "apps/support/command_line.hpp"

namespace abut::apps {
namespace {

using run::RunOptions;

template <class Wanted>
void add_wanted(CommandParser& parser, RunOptions& options, const Wanted& wanted) {
    for (const Option<RunOptions>& option : run::run_options())
        if (option.places.command_line && wanted(option)) add_option(parser, bound(option, options));
}

Flag add_named(CommandParser& parser, RunOptions& options, const std::string& name) {
    return add_option(parser, bound(named(run::run_options(), name), options));
}

}  // namespace

void add_time_options(CommandParser& parser, RunOptions& options, const std::string& default_of_time) {
    BoundOption time = bound(named(run::run_options(), "time"), options);
    OptionFacts told = *time.facts;
    told.by_default = default_of_time;
    time.facts = &told;
    const Flag end = add_option(parser, time);
    add_wanted(parser, options, [](const OptionFacts& option) { return option.group == "Time" && option.name != "time"; });
    parser.at("--steps").excludes(end);
    parser.at("--dt").excludes(parser.at("--cfl"));
    parser.at("--allow-unstable").needs(parser.at("--dt"));
}

void add_contact_options(CommandParser& parser, RunOptions& options) {
    add_wanted(parser, options, [](const OptionFacts& option) { return option.group == "Contact"; });
}

void add_model_options(CommandParser& parser, RunOptions& options) {
    add_wanted(parser, options, [](const OptionFacts& option) { return option.shapes_rest; });
}

void add_compression_limit(CommandParser& parser, RunOptions& options) { add_named(parser, options, "compression_limit"); }

void add_ranks_options(CommandParser& parser, RunOptions& options) {
    for (const char* name : {"ranks", "rebalance", "rebalance_above"}) add_named(parser, options, name);
}

void add_output_options(CommandParser& parser, RunOptions& options) {
    add_wanted(parser, options, [](const OptionFacts& option) { return option.group == "Output"; });
}

}  // namespace abut::apps
