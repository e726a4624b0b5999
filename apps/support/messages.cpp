#include "apps/support/messages.hpp"
#include "apps/support/command_line.hpp"

#include <spdlog/spdlog.h>

namespace abut::apps {

void set_log(Messages messages) {
    spdlog::set_level(messages == Messages::normal ? spdlog::level::info : spdlog::level::off);
}

void add_message_options(CLI::App& app, Messages& messages) {
    const auto add = [&](const char* name, Messages meant, const char* help) {
        return app
            .add_flag_callback(
                name, [&messages, meant] { messages = meant; }, help)
            ->default_str("off")
            ->group("Messages");
    };
    auto* quiet = add("--quiet", Messages::quiet, "errors alone");
    add("--json", Messages::json,
        "a line of JSON for each thing that happens: start, warning, progress, record, end, error (docs/results.md)")
        ->excludes(quiet);
}

}  // namespace abut::apps
