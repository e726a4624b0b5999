// The only source of the programs that includes CLI11.
#include "apps/support/command_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/base/nearest_word.hpp"
#include "abut/base/text.hpp"
#include "apps/support/terminal.hpp"

namespace abut::apps {
namespace {

constexpr const char* empty_lines = "\n\n\n";
const std::string rarely_needed = ", rarely needed";  // ends the heading of options that --help-all alone shows

/// How --help shows an option: "--gap X    distance of the two surfaces at the start [m] (default 0.02)".
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter() { column_width(30); }

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
        shows_all_ = mode == CLI::AppFormatMode::All;
        std::string text = Formatter::make_help(app, std::move(name), CLI::AppFormatMode::Normal);
        for (std::size_t at = text.find(empty_lines); at != std::string::npos; at = text.find(empty_lines, at))
            text.erase(at, 1);  // of groups that are not shown
        return text;
    }
    std::string make_group(std::string group, bool is_positional, std::vector<const CLI::Option*> options) const override {
        if (!shows_all_ && group.ends_with(rarely_needed)) return "";
        return Formatter::make_group(std::move(group), is_positional, std::move(options));
    }

    std::string make_option_opts(const CLI::Option* option) const override {
        return option->get_type_size() == 0 ? "" : " " + option->get_type_name();
    }

    std::string make_option_desc(const CLI::Option* option) const override {
        const std::string& by_default = option->get_default_str();
        const std::string text = by_default.empty() ? option->get_description()
                                                    : fmt::format("{} (default {})", option->get_description(), by_default);
        const auto width = terminal_width(STDOUT_FILENO);
        return width && *width > 2 * get_column_width() ? wrapped(text, *width - get_column_width()) : text;
    }

private:
    mutable bool shows_all_ = false;  // while a help is made
};

/// The command that the line gives, or the program.
const CLI::App& given_command(const CLI::App& app) {
    const auto given = app.get_subcommands();
    return given.empty() ? app : *given.front();
}

std::string full_name(const CLI::App& command) {
    return command.get_parent() ? command.get_parent()->get_name() + " " + command.get_name() : command.get_name();
}

std::string hint(const std::string& word, const std::vector<std::string>& known) {
    const auto nearest = nearest_word(word, known);
    return nearest ? fmt::format(" Did you mean {}?", *nearest) : "";
}

std::vector<std::string> flags_of(const CLI::App& command) {
    std::vector<std::string> flags;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    return flags;
}

/// A command line without a command: the word that stands in its place may be one with a fault, or its file.
std::string without_command(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    const auto words = app.remaining(true);
    if (words.empty()) return fmt::format("a command is missing: one of {}.", fmt::join(names, ", "));
    const std::string hinted = hint(words.front(), names);
    return fmt::format("'{}' is no command.{}", words.front(),
                       hinted.empty() ? fmt::format(" Commands are {}.", fmt::join(names, ", ")) : hinted);
}

/// "fast|balanced|exact" as words; nothing where it is something else.
std::vector<std::string> alternatives_of(const std::string& type) {
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
    if (!is_flag) result.choices = alternatives_of(option.get_type_name());
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

Flag& Flag::group(const std::string& heading) {
    option_->group(heading);
    return *this;
}

Flag& Flag::rarely_needed() {
    option_->group(option_->get_group() + apps::rarely_needed);
    return *this;
}

Flag& Flag::takes(const std::string& value) {
    option_->type_name(value);
    return *this;
}

Flag& Flag::by_default(const std::string& value) {
    option_->default_str(value);
    return *this;
}

Flag& Flag::required() {
    option_->required();
    return *this;
}

Flag& Flag::one_of(const std::vector<std::string>& words) {
    return refuse([words](const std::string& text) {
        if (std::ranges::find(words, text) != words.end()) return std::string();
        return fmt::format("'{}' is not known; choose one of {}.", text, fmt::join(words, ", "));
    });
}

Flag& Flag::refuse(const std::function<std::string(const std::string&)>& fault) {
    option_->check(CLI::Validator(fault, ""));
    return *this;
}

Flag& Flag::several() {
    option_->expected(1)->take_all();
    return *this;
}

Flag& Flag::one_at_a_time() {
    option_->allow_extra_args(false);
    return *this;
}

Flag& Flag::comma_separated() {
    option_->delimiter(',');
    return *this;
}

Flag& Flag::excludes(const Flag& other) {
    option_->excludes(other.option_);
    return *this;
}

Flag& Flag::needs(const Flag& other) {
    option_->needs(other.option_);
    return *this;
}

bool Flag::is_given() const { return option_->count() > 0; }
std::string Flag::name() const { return option_->get_name(); }

CommandParser::CommandParser() : CommandParser("", "") {}

CommandParser::CommandParser(const std::string& name, const std::string& purpose)
    : program_(std::make_unique<CLI::App>(purpose, name)), app_(*program_) {
    app_.formatter(std::make_shared<HelpFormatter>());
    app_.failure_message([this](const CLI::App* app, const CLI::Error& error) {
        const std::string text = fmt::format("{}: error: {} ({} --help lists all options.)\n", app->get_name(),
                                             in_words(*app, error), full_name(given_command(*app)));
        return for_terminal(as_utf8(text), STDERR_FILENO);
    });
}

CommandParser::CommandParser(CLI::App& command) : app_(command) {}
CommandParser::~CommandParser() = default;

Flag CommandParser::text(const std::string& name, const std::function<void(const std::string&)>& read,
                         const std::string& help) {
    const auto read_or_refuse = [read](const std::string& text) {
        try {
            read(text);
        } catch (const BadInput& error) {
            throw CLI::ValidationError(error.what());
        }
    };
    return Flag(*app_.add_option_function<std::string>(name, read_or_refuse, help));
}

Flag CommandParser::text(const std::string& name, std::string& value, const std::string& help) {
    return Flag(*app_.add_option(name, value, help));
}

Flag CommandParser::path(const std::string& name, std::filesystem::path& value, const std::string& help) {
    return Flag(*app_.add_option(name, value, help));
}

Flag CommandParser::texts(const std::string& name, std::vector<std::string>& values, const std::string& help) {
    return Flag(*app_.add_option(name, values, help));
}

Flag CommandParser::flag(const std::string& name, bool& value, const std::string& help) {
    return Flag(*app_.add_flag(name, value, help));
}

Flag CommandParser::flag(const std::string& name, const std::function<void()>& set, const std::string& help) {
    return Flag(*app_.add_flag_callback(name, set, help));
}

Flag CommandParser::at(const std::string& name) const { return Flag(*app_.get_option(name)); }

std::vector<Flag> CommandParser::of_group(const std::string& heading) const {
    std::vector<Flag> flags;
    for (CLI::Option* option : app_.get_options([&](const CLI::Option* one) { return one->get_group() == heading; }))
        flags.emplace_back(*option);
    return flags;
}

void CommandParser::add_version(const std::string& text) { app_.set_version_flag("--version", text); }
void CommandParser::add_help_of_all() { app_.set_help_all_flag("--help-all", "Print this help with all options"); }
void CommandParser::end_help_with(const std::string& text) { app_.footer(text); }
void CommandParser::explain_unknown(std::function<std::string(const std::string&)> explanation) {
    explanation_ = std::move(explanation);
}

std::string CommandParser::in_words(const CLI::App& app, const CLI::Error& error) const {
    const CLI::App& command = given_command(app);
    if (error.get_name() == "RequiredError" && &command == &app) return without_command(app);
    if (!dynamic_cast<const CLI::ExtrasError*>(&error)) return error.what();
    const auto words = app.remaining(true);
    const auto option = std::ranges::find_if(words, [](const std::string& word) { return word.starts_with("--"); });
    if (option == words.end()) return error.what();
    const std::string name = option->substr(0, option->find('='));
    const std::string explained = explanation_ ? explanation_(name.substr(2)) : "";
    return fmt::format("{}: {} has no such option.{}", name, full_name(command),
                       explained.empty() ? hint(name, flags_of(command)) : explained);
}

void CommandParser::take_no_help() { app_.set_help_flag(); }

CommandParser& CommandParser::add_command(const std::string& name, const std::string& purpose) {
    app_.require_subcommand(1);
    commands_.push_back(std::unique_ptr<CommandParser>(new CommandParser(*app_.add_subcommand(name, purpose))));
    return *commands_.back();
}

std::vector<Command> CommandParser::commands() const {
    std::vector<Command> commands;
    for (const auto& command : commands_) commands.push_back(described(command->app_));
    return commands;
}

std::optional<std::string> CommandParser::help_of(const std::string& command) const {
    for (const auto& one : commands_)
        if (one->name() == command) return one->app_.help(name());
    return std::nullopt;
}

std::string CommandParser::name() const { return app_.get_name(); }
std::string CommandParser::purpose() const { return app_.get_description(); }

void CommandParser::parse(int argc, char** argv) {
    try {
        app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        throw BadInput(error.what());
    }
}

void CommandParser::parse(const std::string& words) {
    try {
        app_.parse(words, false);
    } catch (const CLI::ParseError& error) {
        throw BadInput(error.what());
    }
}

std::optional<std::string> CommandParser::parse_or_print(int argc, char** argv) {
    try {
        app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app_.exit(error) == 0 ? "" : error.what();
    }
    return std::nullopt;
}

bool CommandParser::is_given() const { return app_.parsed(); }

}  // namespace abut::apps
