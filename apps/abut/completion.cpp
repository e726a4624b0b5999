#include "apps/abut/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace abut::apps {
namespace {

/// Kind of text that may stand in place of a value.
enum class Kind { words, folders, files, unknown };

Kind kind_of(const CommandOption& option) {
    if (!option.choices.empty()) return Kind::words;
    if (option.value == "DIR") return Kind::folders;
    if (option.value.starts_with("FILE") || option.value == "PATH") return Kind::files;
    return Kind::unknown;
}

std::vector<std::string> names_of(const std::vector<Command>& commands) {
    std::vector<std::string> names;
    for (const Command& command : commands) names.push_back(command.name);
    return names;
}

/// The first clause of a meaning, in one line, without what these shells take for signs of their own.
std::string short_meaning(const std::string& meaning) {
    std::size_t end = meaning.size();
    for (const std::string_view mark : {". ", ": ", "; ", " ("}) end = std::min(end, meaning.find(mark));
    std::string text;
    for (const char c : meaning.substr(0, end)) {
        if (std::string_view("'[]:\\`$\"").find(c) == std::string_view::npos) text += c == '\n' ? ' ' : c;
    }
    return text;
}

// bash ---------------------------------------------------------------------------------------------------------------

std::string bash_values(const CommandOption& option) {
    switch (kind_of(option)) {
        case Kind::words:
            return fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$word\"))", fmt::join(option.choices, " "));
        case Kind::folders:
            return "COMPREPLY=($(compgen -d -- \"$word\"))";
        case Kind::files:
            return "COMPREPLY=($(compgen -f -- \"$word\"))";
        case Kind::unknown:
            break;
    }
    return "COMPREPLY=()";
}

std::string bash_case(const Command& command) {
    std::string values;
    std::vector<std::string> names = {"--help"};
    for (const CommandOption& option : command.options) {
        names.push_back(option.name);
        if (!option.value.empty())
            values += fmt::format("            {}) {}; return ;;\n", option.name, bash_values(option));
    }
    std::string text = fmt::format("        {})\n", command.name);
    if (!values.empty()) text += fmt::format("            case \"$before\" in\n{}            esac\n", values);
    text += fmt::format("            if [[ $word == -* ]]; then COMPREPLY=($(compgen -W \"{}\" -- \"$word\")); return; fi\n",
                        fmt::join(names, " "));
    text += fmt::format("            {} ;;\n",
                        command.positionals.empty() ? "COMPREPLY=()" : bash_values(command.positionals.front()));
    return text;
}

std::string bash_completion(const std::string& program, const std::vector<Command>& commands) {
    std::string cases;
    for (const Command& command : commands) cases += bash_case(command);
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
                       program, fmt::join(names_of(commands), " "), cases);
}

// zsh ----------------------------------------------------------------------------------------------------------------

std::string zsh_values(const CommandOption& option) {
    switch (kind_of(option)) {
        case Kind::words:
            return fmt::format(":({})", fmt::join(option.choices, " "));
        case Kind::folders:
            return ":_directories";
        case Kind::files:
            return ":_files";
        case Kind::unknown:
            break;
    }
    return ": ";
}

std::string zsh_case(const Command& command) {
    std::string text = fmt::format("        {})\n            _arguments '--help[lists options]'", command.name);
    for (const CommandOption& option : command.options) {
        text += fmt::format(" \\\n                '*{}[{}]", option.name, short_meaning(option.meaning));
        if (!option.value.empty()) text += ":value" + zsh_values(option);
        text += "'";
    }
    if (!command.positionals.empty())
        text += fmt::format(" \\\n                '*:what{}'", zsh_values(command.positionals.front()));
    return text + " ;;\n";
}

std::string zsh_completion(const std::string& program, const std::vector<Command>& commands) {
    std::string list, cases;
    for (const Command& command : commands) {
        list += fmt::format("        '{}:{}'\n", command.name, short_meaning(command.meaning));
        cases += zsh_case(command);
    }
    return fmt::format(R"(#compdef {0}
# Completion of {0} in zsh: keep this file as _{0} in a folder of $fpath.
_{0}() {{
    local -a commands=(
{1}    )
    if ((CURRENT == 2)); then
        _describe command commands
        _arguments '--help[lists commands]' '--version[says how it was built]'
        return
    fi
    local command=$words[2]
    words=("${{(@)words[2,-1]}}")
    ((CURRENT--))
    case $command in
{2}    esac
}}
_{0} "$@"
)",
                       program, list, cases);
}

// fish ---------------------------------------------------------------------------------------------------------------

std::string fish_values(const CommandOption& option) {
    switch (kind_of(option)) {
        case Kind::words:
            return fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
        case Kind::folders:
            return " -x -a '(__fish_complete_directories)'";
        case Kind::files:
            return " -r -F";
        case Kind::unknown:
            break;
    }
    return " -x";
}

std::string fish_lines(const std::string& program, const Command& command) {
    const std::string head = fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}'", program, command.name);
    std::string text = fmt::format("{} -l help -d 'lists options'\n", head);
    for (const CommandOption& option : command.options)
        text += fmt::format("{} -l {}{} -d '{}'\n", head, option.name.substr(2),
                            option.value.empty() ? "" : fish_values(option), short_meaning(option.meaning));
    if (!command.positionals.empty() && kind_of(command.positionals.front()) != Kind::unknown) {
        const CommandOption& what = command.positionals.front();
        text += head + (kind_of(what) == Kind::files ? " -F" : fish_values(what).replace(1, 2, "-f")) + "\n";
    }
    return text;
}

std::string fish_completion(const std::string& program, const std::vector<Command>& commands) {
    std::string text = fmt::format(R"(# Completion of {0} in fish: source this file, or keep it as
# ~/.config/fish/completions/{0}.fish
complete -c {0} -f
)",
                                   program);
    for (const Command& command : commands)
        text += fmt::format("complete -c {} -n __fish_use_subcommand -a {} -d '{}'\n", program, command.name,
                            short_meaning(command.meaning));
    text += fmt::format(
        "complete -c {0} -n __fish_use_subcommand -l help -d 'lists commands'\n"
        "complete -c {0} -n __fish_use_subcommand -l version -d 'says how it was built'\n",
        program);
    for (const Command& command : commands) text += fish_lines(program, command);
    return text;
}

}  // namespace

const std::vector<std::string>& completing_shells() {
    static const std::vector<std::string> shells = {"bash", "zsh", "fish"};
    return shells;
}

std::string completion(const std::string& shell, const std::string& program, std::vector<Command> commands,
                       const std::vector<std::string>& topics) {
    for (Command& command : commands)
        if (command.name == "help" && !command.positionals.empty()) command.positionals.front().choices = topics;
    if (shell == "zsh") return zsh_completion(program, commands);
    if (shell == "fish") return fish_completion(program, commands);
    return bash_completion(program, commands);
}

}  // namespace abut::apps
