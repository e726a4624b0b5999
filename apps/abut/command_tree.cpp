#include "apps/abut/command_tree.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

namespace abut::apps {
namespace {

/// "fast|balanced|exact" as words; nothing where it is something else.
std::vector<std::string> choices_of(const std::string& type) {
    if (type.find('|') == std::string::npos || type.find_first_of(" [],.:=") != std::string::npos) return {};
    return CLI::detail::split(type, '|');
}

CommandOption described(const CLI::Option& option) {
    const bool is_flag = option.get_type_size() == 0;
    CommandOption result{.name = option.get_positional() ? option.get_type_name() : "--" + option.get_lnames().front(),
                         .value = is_flag ? "" : option.get_type_name(),
                         .meaning = option.get_description(),
                         .group = option.get_group(),
                         .choices = {}};
    if (!option.get_default_str().empty()) result.meaning += fmt::format(" (default {})", option.get_default_str());
    if (!is_flag) result.choices = choices_of(option.get_type_name());
    return result;
}

Command described(const CLI::App& app) {
    Command command{.name = app.get_name(), .meaning = app.get_description(), .options = {}, .positionals = {}};
    for (const CLI::Option* option : app.get_options())
        if (option != app.get_help_ptr())
            (option->get_positional() ? command.positionals : command.options).push_back(described(*option));
    return command;
}

}  // namespace

std::vector<Command> commands_of(const CLI::App& app) {
    std::vector<Command> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        commands.push_back(described(*command));
    return commands;
}

}  // namespace abut::apps
