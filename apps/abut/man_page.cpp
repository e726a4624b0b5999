#include "apps/abut/man_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace abut::apps {
namespace {

/// Text of troff: nothing in it means anything to it.
std::string plain(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
    }
    return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// "Runs scenes." as "runs scenes"
std::string as_phrase(std::string sentence) {
    sentence.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence.front())));
    sentence.pop_back();
    return sentence;
}

std::string option_entry(const CommandOption& option) {
    const std::string value =
        option.value.empty() || option.value == option.name ? "" : " \\fI" + plain(option.value) + "\\fR";
    return fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", plain(option.name), value, plain(option.meaning));
}

std::string synopsis(const Command& command) {
    std::string text;
    for (const CommandOption& argument : command.positionals) text += " \\fI" + plain(argument.name) + "\\fR";
    return text + (command.options.empty() ? "" : " [\\fIoptions\\fR]");
}

std::string command_part(const std::string& program, const Command& command) {
    std::string text =
        fmt::format(".SS \\fB{} {}\\fR{}\n{}.\n", program, plain(command.name), synopsis(command), plain(command.meaning));
    for (const CommandOption& argument : command.positionals) text += option_entry(argument);
    std::vector<std::string> groups;
    for (const CommandOption& option : command.options)
        if (std::ranges::find(groups, option.group) == groups.end()) groups.push_back(option.group);
    for (const std::string& group : groups) {
        if (group != "Options") text += fmt::format(".PP\n{}:\n", plain(group));
        for (const CommandOption& option : command.options)
            if (option.group == group) text += option_entry(option);
    }
    return text;
}

std::string topic_part(const Topic& topic) {
    std::string text = fmt::format(".SH {}\n", plain(upper(topic.title)));
    for (const TopicPart& part : parts_of(topic))
        text += part.entry ? fmt::format(".TP\n\\fB{}\\fR\n{}\n", plain(*part.entry), plain(part.text))
                           : fmt::format(".PP\n{}\n", plain(part.text));
    return text;
}

}  // namespace

std::string man_page(const ManPage& page, const std::vector<Command>& commands, std::span<const Topic> topics) {
    const std::string name = upper(page.program);
    std::string text = fmt::format(".TH {} 1 \"\" \"{} {}\" \"User Commands\"\n", name, page.program, plain(page.version));
    text += fmt::format(".SH NAME\n{} \\- {}\n", page.program, plain(as_phrase(page.purpose)));
    text += ".SH SYNOPSIS\n";
    for (const Command& command : commands)
        text += fmt::format("\\fB{} {}\\fR{}\n.br\n", page.program, plain(command.name), synopsis(command));
    text += ".SH COMMANDS\n";
    for (const Command& command : commands) text += command_part(page.program, command);
    for (const Topic& topic : topics) text += topic_part(topic);
    return text;
}

}  // namespace abut::apps
