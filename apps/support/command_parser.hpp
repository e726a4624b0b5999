#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Error;
class Option;
}  // namespace CLI

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

/// An option or a positional argument that a parser knows. A copy is another name of the same option.
class Flag {
public:
    explicit Flag(CLI::Option& option) : option_(&option) {}

    Flag& group(const std::string& heading);              ///< its heading in --help
    Flag& rarely_needed();                                ///< --help-all shows it, --help does not
    Flag& takes(const std::string& value);                ///< CommandOption::value
    Flag& by_default(const std::string& value);           ///< told by --help; empty: nothing is told
    Flag& required();                                     ///< it must be given
    Flag& one_of(const std::vector<std::string>& words);  ///< other texts are refused
    /// Texts for which `fault` returns a message are refused.
    Flag& refuse(const std::function<std::string(const std::string&)>& fault);
    Flag& several();        ///< of a list: it may be given several times, and other texts may follow the first
    Flag& one_at_a_time();  ///< of a list: it may be given several times, with one text each
    Flag& comma_separated();
    Flag& excludes(const Flag& other);  ///< one of the two at most may be given
    Flag& needs(const Flag& other);     ///< may be given only beside the other

    [[nodiscard]] bool is_given() const;  ///< once the command line is read
    [[nodiscard]] std::string name() const;

private:
    CLI::Option* option_;
};

/// Reads the command line of a program, or of one of its commands. It hides the library behind it, whose header takes
/// seconds to compile. Whatever an option sets must outlive the parser, and is set when the command line is read.
class CommandParser {
public:
    /// For words that no user of a terminal has typed just now.
    CommandParser();
    /// Parser of a program: --help and messages fit the terminal.
    CommandParser(const std::string& name, const std::string& purpose);
    ~CommandParser();

    /// Options, whose names begin with "--", and positional arguments, in the order of --help.
    /// `read` may throw BadInput, whose text is the message.
    Flag text(const std::string& name, const std::function<void(const std::string&)>& read, const std::string& help);
    Flag text(const std::string& name, std::string& value, const std::string& help);
    Flag path(const std::string& name, std::filesystem::path& value, const std::string& help);
    Flag texts(const std::string& name, std::vector<std::string>& values, const std::string& help);
    Flag flag(const std::string& name, bool& value, const std::string& help);  ///< true where it is given
    Flag flag(const std::string& name, const std::function<void()>& set, const std::string& help);

    /// One that was added; throws std::exception if none has this name.
    [[nodiscard]] Flag at(const std::string& name) const;
    [[nodiscard]] std::vector<Flag> of_group(const std::string& heading) const;

    void add_version(const std::string& text);  ///< --version
    void add_help_of_all();                     ///< --help-all, which shows what is rarely needed, too
    void end_help_with(const std::string& text);
    void take_no_help();  ///< there is no --help
    /// Options that are none, and where they went: text for a message about the option of this name, without "--"; empty:
    /// unknown.
    void explain_unknown(std::function<std::string(const std::string&)> explanation);

    /// A command of this program, one of which must be given. It lives as long as the program.
    CommandParser& add_command(const std::string& name, const std::string& purpose);
    [[nodiscard]] std::vector<Command> commands() const;
    /// The text of COMMAND --help; nothing if there is no such command.
    [[nodiscard]] std::optional<std::string> help_of(const std::string& command) const;
    [[nodiscard]] std::string name() const;
    [[nodiscard]] std::string purpose() const;

    /// Throws BadInput where a command line will not do.
    void parse(int argc, char** argv);
    void parse(const std::string& words);
    /// As a program does it: prints help, version or error where these are called for. Nothing: the program goes on. Else
    /// the program ends, with this error, or well if it is empty.
    [[nodiscard]] std::optional<std::string> parse_or_print(int argc, char** argv);
    [[nodiscard]] bool is_given() const;  ///< whether the command line has this command

private:
    explicit CommandParser(CLI::App& command);
    [[nodiscard]] std::string in_words(const CLI::App& app, const CLI::Error& error) const;

    std::unique_ptr<CLI::App> program_;  ///< null in a command
    CLI::App& app_;
    std::vector<std::unique_ptr<CommandParser>> commands_;
    std::function<std::string(const std::string&)> explanation_;
};

}  // namespace abut::apps
