#include "apps/support/program.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "apps/support/command_line.hpp"
#include "apps/support/json_lines.hpp"
#include "apps/support/rank_session.hpp"
#include "apps/support/signals.hpp"
#include "apps/support/terminal.hpp"

namespace abut::apps {
namespace {

std::string message_of(const CLI::App* app, const CLI::Error& error) {
    return for_terminal(fmt::format("{0}: error: {1} ({0} --help lists all options.)\n", app->get_name(), error.what()),
                        STDERR_FILENO);
}

int report_errors(const Program& program, const std::function<void()>& body) {
    try {
        spdlog::set_default_logger(spdlog::stdout_color_mt(program.name));
        spdlog::set_pattern("[%T] %v");
        if (!program.takes_ranks) refuse_ranks(program.name.c_str());
        body();
        return noted_signal() == 0 ? 0 : exit_code_of(noted_signal());
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}", for_terminal(fmt::format("{}: error: {}\n", program.name, error.what()), STDERR_FILENO));
        if (program.messages == Messages::json) json_error(error, 1);
        leave_ranks(fmt::format("{}: error: {}", program.name, error.what()));
        return 1;
    }
}

}  // namespace

int run_program(const Program& program, int argc, char** argv, const std::function<void(CLI::App&)>& add_options,
                const std::function<void()>& body) {
    const std::unique_ptr<ranks::Session> ranks = join_ranks();
    CLI::App app(program.purpose, program.name);
    app.formatter(std::make_shared<HelpFormatter>());
    app.failure_message(message_of);
    app.footer(for_terminal(program.footer, STDOUT_FILENO));
    add_options(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (app.exit(error) == 0) return 0;
        leave_ranks(fmt::format("{}: error: {}", program.name, error.what()));
        return 1;
    }
    return report_errors(program, body);
}

}  // namespace abut::apps
