#pragma once
#include <string>
#include <vector>

#include "apps/support/cli.hpp"

namespace abut::apps {

/// An option or a positional argument, as help, manual page and completion show it.
struct CommandOption {
    std::string name;                  ///< "--cfl"; of a positional argument "FILE"
    std::string value;                 ///< what it takes, "X", "fast|balanced|exact", "DIR"; empty: it is a flag
    std::string meaning;               ///< with its default
    std::string group;                 ///< "Time"
    std::vector<std::string> choices;  ///< of words; empty: any
};

/// A command and what it takes beside --help.
struct Command {
    std::string name;
    std::string meaning;
    std::vector<CommandOption> options;
    std::vector<CommandOption> positionals;
};

/// The commands of a program, in their order.
[[nodiscard]] std::vector<Command> commands_of(const CLI::App& app);

}  // namespace abut::apps
