#include "apps/abut/asked.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <vector>

#include "apps/abut/build_info.hpp"
#include "apps/abut/command_tree.hpp"
#include "apps/abut/completion.hpp"
#include "apps/abut/info.hpp"
#include "apps/abut/man_page.hpp"
#include "apps/abut/topics.hpp"
#include "apps/support/command_line.hpp"
#include "apps/support/terminal.hpp"

namespace abut::apps {
namespace {

constexpr std::size_t width_of_no_terminal = 80;

/// A command as its own --help has it, or a topic.
std::string help_of(const Asked& asked) {
    if (asked.topic.empty())
        return "Topics, abut help TOPIC:\n" + topic_list() + "Of a command: abut help COMMAND, or abut COMMAND --help.\n";
    for (const CLI::App* command : asked.app->get_subcommands([](const CLI::App*) { return true; }))
        if (command->get_name() == asked.topic) return command->help(asked.app->get_name());
    return topic_text(asked.topic, terminal_width(STDOUT_FILENO).value_or(width_of_no_terminal));
}

std::string completion_of(const CLI::App& app, const std::string& shell) {
    const std::vector<Command> commands = commands_of(app);
    std::vector<std::string> words;
    for (const Topic& topic : topics()) words.push_back(topic.name);
    for (const Command& command : commands) words.push_back(command.name);
    return completion(shell, app.get_name(), commands, words);
}

std::string man_page_of(const CLI::App& app) {
    return man_page({app.get_name(), build_info().version, app.get_description()}, commands_of(app), topics());
}

}  // namespace

void add_asked(CLI::App& app, Asked& asked) {
    asked.app = &app;
    asked.info = app.add_subcommand("info", "says what is in a mesh, a surface, a scene or a folder of results");
    asked.info->add_option("file", asked.file, "the file or the folder")->required()->type_name("FILE");
    asked.help = app.add_subcommand("help", "explains a topic or a command; alone, lists the topics");
    asked.help->add_option("topic", asked.topic, "what to explain")->type_name("TOPIC");
    asked.completion = app.add_subcommand("completion", "prints the script that completes command lines in a shell");
    asked.completion->add_option("shell", asked.shell, "the shell")
        ->required()
        ->check(one_of(completing_shells()))
        ->type_name("SHELL");
    asked.man = app.add_subcommand("man", "prints the manual page: abut man > abut.1");
}

std::string answer(const Asked& asked) {
    if (asked.info->parsed()) return info(asked.file);
    if (asked.completion->parsed()) return completion_of(*asked.app, asked.shell);
    if (asked.man->parsed()) return man_page_of(*asked.app);
    return help_of(asked);
}

}  // namespace abut::apps
