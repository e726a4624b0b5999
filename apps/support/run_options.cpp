#include "apps/support/run_options.hpp"

#include <type_traits>
#include <variant>

#include "abut/run/option_table.hpp"
#include "apps/support/command_line.hpp"

namespace abut::apps {
namespace {

using run::RunOptions;

template <class Wanted>
void add_wanted(CLI::App& app, RunOptions& options, const Wanted& wanted) {
    for (const Option<RunOptions>& option : run::run_options())
        if (option.places.command_line && wanted(option)) add_option(app, bound(option, options));
}

CLI::Option* add_named(CLI::App& app, RunOptions& options, const std::string& name) {
    return add_option(app, bound(named(run::run_options(), name), options));
}

nlohmann::ordered_json to_json(const run::NamedValues& values) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const run::NamedValue& value : values) json[value.name] = apps::to_json(value.value);
    return json;
}

}  // namespace

void add_time_options(CLI::App& app, RunOptions& options, const std::string& default_of_time) {
    BoundOption time = bound(named(run::run_options(), "time"), options);
    OptionFacts told = *time.facts;
    told.by_default = default_of_time;
    time.facts = &told;
    CLI::Option* end = add_option(app, time);
    add_wanted(app, options, [](const OptionFacts& option) { return option.group == "Time" && option.name != "time"; });
    app.get_option("--steps")->excludes(end);
    app.get_option("--dt")->excludes(app.get_option("--cfl"));
    app.get_option("--allow-unstable")->needs(app.get_option("--dt"));
}

void add_contact_options(CLI::App& app, RunOptions& options) {
    add_wanted(app, options, [](const OptionFacts& option) { return option.group == "Contact"; });
}

void add_model_options(CLI::App& app, RunOptions& options) {
    add_wanted(app, options, [](const OptionFacts& option) { return option.shapes_rest; });
}

void add_compression_limit(CLI::App& app, RunOptions& options) { add_named(app, options, "compression_limit"); }

void add_ranks_options(CLI::App& app, RunOptions& options) {
    for (const char* name : {"ranks", "rebalance", "rebalance_above"}) add_named(app, options, name);
}

void add_output_options(CLI::App& app, RunOptions& options) {
    add_wanted(app, options, [](const OptionFacts& option) { return option.group == "Output"; });
}

nlohmann::ordered_json to_json(const run::Value& value) {
    return std::visit(
        [](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
                return nlohmann::ordered_json();
            else
                return nlohmann::ordered_json(held);
        },
        value);
}

nlohmann::ordered_json to_json(const run::RunOptions& options) { return to_json(run::named_values(options)); }
nlohmann::ordered_json model_json(const run::RunOptions& options) { return to_json(run::model_values(options)); }

}  // namespace abut::apps
