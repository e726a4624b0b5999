#include "apps/abut/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace abut::apps {
namespace {

/// What stands in place of a value: words, folders, files, or nothing that can be known.
std::string words_for(const CommandOption& option) {
    if (!option.choices.empty())
        return fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$word\"))", fmt::join(option.choices, " "));
    if (option.value == "DIR") return "COMPREPLY=($(compgen -d -- \"$word\"))";
    if (option.value.starts_with("FILE") || option.value == "PATH") return "COMPREPLY=($(compgen -f -- \"$word\"))";
    return "COMPREPLY=()";
}

/// Cases of options that take a value.
std::string values_of(const Command& command) {
    std::string text;
    for (const CommandOption& option : command.options)
        if (!option.value.empty()) text += fmt::format("            {}) {}; return ;;\n", option.name, words_for(option));
    return text;
}

std::string names_of(const Command& command) {
    std::vector<std::string> names = {"--help"};
    for (const CommandOption& option : command.options) names.push_back(option.name);
    return fmt::format("{}", fmt::join(names, " "));
}

std::string case_of(const Command& command) {
    const std::string values = values_of(command);
    std::string text = fmt::format("        {})\n", command.name);
    if (!values.empty()) text += fmt::format("            case \"$before\" in\n{}            esac\n", values);
    text += fmt::format("            if [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return; fi\n",
                        names_of(command));
    text += fmt::format("            {} ;;\n",
                        command.positionals.empty() ? "COMPREPLY=()" : words_for(command.positionals.front()));
    return text;
}

}  // namespace

std::string bash_completion(const std::string& program, const std::vector<Command>& commands,
                            const std::vector<std::string>& topics) {
    std::string cases;
    std::vector<std::string> names;
    for (const Command& command : commands) {
        names.push_back(command.name);
        Command own = command;
        if (command.name == "help" && !own.positionals.empty()) own.positionals.front().choices = topics;
        cases += case_of(own);
    }
    return fmt::format(R"(# Completion of {0} in bash: source this file, or keep it as
# ~/.local/share/bash-completion/completions/{0}
_{0}() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}}
    if ((COMP_CWORD == 1)); then
        COMPREPLY=($(compgen -W "{1} --help --version" -- "$word"))
        return
    fi
    case "${{COMP_WORDS[1]}}" in
{2}    esac
}}
complete -o filenames -F _{0} {0}
)",
                       program, fmt::join(names, " "), cases);
}

}  // namespace abut::apps
