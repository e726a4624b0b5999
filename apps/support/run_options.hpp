#pragma once
#include <nlohmann/json.hpp>

#include <string>

#include "abut/run/options.hpp"
#include "abut/run/value.hpp"
#include "apps/support/cli.hpp"

namespace abut::apps {

/// --ranks, --rebalance, --rebalance-above.
void add_ranks_options(CLI::App& app, run::RunOptions& options);

/// Groups of options, from run::run_options; their defaults are the present values of `options`. `default_of_time` says in --help what the end of
/// the run is by default.
void add_time_options(CLI::App& app, run::RunOptions& options, const std::string& default_of_time);
void add_contact_options(CLI::App& app, run::RunOptions& options);
void add_model_options(CLI::App& app, run::RunOptions& options);  ///< of these, what bodies at rest depend on, too
void add_compression_limit(CLI::App& app, run::RunOptions& options);
void add_output_options(CLI::App& app, run::RunOptions& options);

/// A value of a finding, as a summary shows it.
[[nodiscard]] nlohmann::ordered_json to_json(const run::Value& value);
/// run::named_values and run::model_values.
[[nodiscard]] nlohmann::ordered_json to_json(const run::RunOptions& options);
[[nodiscard]] nlohmann::ordered_json model_json(const run::RunOptions& options);

}  // namespace abut::apps
