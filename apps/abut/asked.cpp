#include "apps/abut/asked.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "apps/abut/build_info.hpp"
#include "apps/abut/completion.hpp"
#include "apps/abut/info.hpp"
#include "apps/abut/man_page.hpp"
#include "apps/abut/topics.hpp"
#include "apps/support/command_parser.hpp"
#include "apps/support/terminal.hpp"

namespace abut::apps {
namespace {

constexpr std::size_t width_of_no_terminal = 80;

bool is_topic(const std::string& word) { return std::ranges::find(topics(), word, &Topic::name) != topics().end(); }

/// A topic, or a command as its own --help has it.
std::string help_of(const Asked& asked) {
    if (asked.topic.empty())
        return "Topics, abut help TOPIC:\n" + topic_list() + "Of a command: abut help COMMAND, or abut COMMAND --help.\n";
    const auto help = asked.program->help_of(asked.topic);
    if (help && !is_topic(asked.topic)) return *help;
    return topic_text(asked.topic, terminal_width(STDOUT_FILENO).value_or(width_of_no_terminal));
}

std::string completion_of(const CommandParser& program, const std::string& shell) {
    const std::vector<Command> commands = program.commands();
    std::vector<std::string> words;
    for (const Topic& topic : topics()) words.push_back(topic.name);
    for (const Command& command : commands)
        if (!is_topic(command.name)) words.push_back(command.name);
    return completion(shell, program.name(), commands, words);
}

std::string man_page_of(const CommandParser& program) {
    return man_page({program.name(), build_info().version, program.purpose()}, program.commands(), topics());
}

}  // namespace

void add_asked(CommandParser& parser, Asked& asked) {
    asked.program = &parser;
    asked.info = &parser.add_command("info", "says what is in a mesh, a surface, a scene or a folder of results");
    asked.info->path("file", asked.file, "the file or the folder").required().takes("FILE");
    asked.help = &parser.add_command("help", "explains a topic or a command; alone, lists the topics");
    asked.help->text("topic", asked.topic, "what to explain").takes("TOPIC");
    asked.completion = &parser.add_command("completion", "prints the script that completes command lines in a shell");
    asked.completion->text("shell", asked.shell, "the shell").required().one_of(completing_shells()).takes("SHELL");
    asked.man = &parser.add_command("man", "prints the manual page: abut man > abut.1");
}

std::string answer(const Asked& asked) {
    if (asked.info->is_given()) return info(asked.file);
    if (asked.completion->is_given()) return completion_of(*asked.program, asked.shell);
    if (asked.man->is_given()) return man_page_of(*asked.program);
    return help_of(asked);
}

}  // namespace abut::apps
