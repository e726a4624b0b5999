#include "apps/support/program.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>

#include "abut/base/text.hpp"
#include "abut/run/user_words.hpp"
#include "apps/support/command_parser.hpp"
#include "apps/support/json_lines.hpp"
#include "apps/support/rank_session.hpp"
#include "apps/support/signals.hpp"
#include "apps/support/standard_streams.hpp"
#include "apps/support/terminal.hpp"

namespace abut::apps {
namespace {

/// Says it wherever somebody may hear it. What is not UTF-8 in it, as of a path, has another letter in its place.
int report(const Program& program, const std::exception& error) {
    const std::string text = as_utf8(fmt::format("{}: error: {}", program.name, run::in_user_words(error.what())));
    std::fputs((for_terminal(text, STDERR_FILENO) + "\n").c_str(), stderr);
    const int exit_code =
        noted_signal() == 0 ? 1 : exit_code_of(noted_signal());  // a run that was asked to stop before it began
    if (program.messages == Messages::json) json_error(error, exit_code);
    leave_ranks(text);
    return exit_code;
}

/// Calls body(), whose exit code it returns; 1, with a message, where that throws anything.
template <class Body>
int report_errors(const Program& program, const Body& body) {
    try {
        return body();
    } catch (const std::exception& error) {
        return report(program, error);
    } catch (...) {
        return report(program, std::runtime_error("an error of unknown kind, of a library that Abut builds on. This is a "
                                                  "fault of Abut: please report it with the input."));
    }
}

int run_body(const Program& program, const std::function<void()>& body) {
    const auto terminal = std::make_shared<spdlog::sinks::stdout_color_sink_mt>();
    if (!is_terminal(STDOUT_FILENO)) terminal->set_color_mode(spdlog::color_mode::never);
    terminal->set_color(spdlog::level::info, terminal->reset);  // what warns is coloured alone
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(program.name, terminal));
    spdlog::set_pattern("[%T] %^%v%$");
    if (!program.takes_ranks) refuse_ranks(program.name.c_str());
    body();
    return noted_signal() == 0 ? 0 : exit_code_of(noted_signal());
}

int run_on_ranks(const Program& program, int argc, char** argv, const std::function<void(CommandParser&)>& add_options,
                 const std::function<void()>& body) {
    CommandParser parser(program.name, program.purpose);
    parser.end_help_with(for_terminal(program.footer, STDOUT_FILENO));
    add_options(parser);
    const std::optional<std::string> end = parser.parse_or_print(argc, argv);
    if (!end) return run_body(program, body);
    if (end->empty()) return 0;
    leave_ranks(fmt::format("{}: error: {}", program.name, *end));
    return 1;
}

}  // namespace

int run_program(const Program& program, int argc, char** argv, const std::function<void(CommandParser&)>& add_options,
                const std::function<void()>& body) {
    open_closed_streams();
    go_on_at_largest_file();
    std::unique_ptr<ranks::Session> ranks;  // ends after all that is said
    return report_errors(program, [&] {
        ranks = join_ranks();
        return run_on_ranks(program, argc, argv, add_options, body);
    });
}

}  // namespace abut::apps
