#pragma once
#include <string>
#include <vector>

#include "abut/base/option.hpp"
#include "abut/run/options.hpp"

namespace abut::apps {

class CommandParser;

/// --ranks, --rebalance, --rebalance-above.
void add_ranks_options(CommandParser& parser, run::RunOptions& options);

/// Groups of options, from run::run_options; their defaults are the present values of `options`. With
/// OptionDepth::expert those of the laboratory are left out, and --help-all alone shows more than the everyday ones.
/// `default_of_time` says in --help what the end of the run is by default.
void add_time_options(CommandParser& parser, run::RunOptions& options, const std::string& default_of_time,
                      OptionDepth deepest = OptionDepth::laboratory);
void add_contact_options(CommandParser& parser, run::RunOptions& options, OptionDepth deepest = OptionDepth::laboratory);
void add_model_options(CommandParser& parser, run::RunOptions& options);  ///< of these, what bodies at rest depend on, too
/// Takes keys of the laboratory, "overlap=frozen"; throws BadInput where a key or its value will not do.
void take_laboratory(const std::vector<std::string>& keys, run::RunOptions& options);
/// For a message about an option of this name, without "--": how its key of the laboratory is given; empty if it is none.
[[nodiscard]] std::string where_in_laboratory(const std::string& option);
void add_compression_limit(CommandParser& parser, run::RunOptions& options);
void add_output_options(CommandParser& parser, run::RunOptions& options, OptionDepth deepest = OptionDepth::laboratory);

}  // namespace abut::apps
