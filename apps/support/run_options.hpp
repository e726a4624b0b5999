#pragma once
#include <string>

#include "abut/run/options.hpp"

namespace abut::apps {

class CommandParser;

/// --ranks, --rebalance, --rebalance-above.
void add_ranks_options(CommandParser& parser, run::RunOptions& options);

/// Groups of options, from run::run_options; their defaults are the present values of `options`. `default_of_time` says in --help what the end of
/// the run is by default.
void add_time_options(CommandParser& parser, run::RunOptions& options, const std::string& default_of_time);
void add_contact_options(CommandParser& parser, run::RunOptions& options);
void add_model_options(CommandParser& parser, run::RunOptions& options);  ///< of these, what bodies at rest depend on, too
void add_compression_limit(CommandParser& parser, run::RunOptions& options);
void add_output_options(CommandParser& parser, run::RunOptions& options);

}  // namespace abut::apps
