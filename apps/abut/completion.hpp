#pragma once
#include <string>
#include <vector>

#include "apps/abut/command_tree.hpp"

namespace abut::apps {

/// The script that completes a program's commands, options, words and files in bash. `topics` are what its command help
/// takes.
[[nodiscard]] std::string bash_completion(const std::string& program, const std::vector<Command>& commands,
                                          const std::vector<std::string>& topics);

}  // namespace abut::apps
