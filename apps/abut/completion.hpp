#pragma once
#include <string>
#include <vector>

#include "apps/support/command_parser.hpp"

namespace abut::apps {

/// The shells that `completion` knows.
[[nodiscard]] const std::vector<std::string>& completing_shells();

/// The script that completes a program's commands, options, words and files in one of these shells. `topics` are what its
/// command help takes.
[[nodiscard]] std::string completion(const std::string& shell, const std::string& program, std::vector<Command> commands,
                                     const std::vector<std::string>& topics);

}  // namespace abut::apps
