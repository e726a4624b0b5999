#include "apps/support/messages.hpp"

#include <spdlog/spdlog.h>

#include "apps/support/command_parser.hpp"

namespace abut::apps {

void set_log(Messages messages) {
    spdlog::set_level(messages == Messages::normal ? spdlog::level::info : spdlog::level::off);
}

void add_message_options(CommandParser& parser, Messages& messages) {
    const auto add = [&](const char* name, Messages meant, const char* help) {
        const auto set = [&messages, meant] { messages = meant; };
        return parser.flag(name, set, help).by_default("off").group("Messages");
    };
    const Flag quiet = add("--quiet", Messages::quiet, "errors alone");
    add("--json", Messages::json,
        "a line of JSON for each thing that happens: start, warning, progress, record, end, error (docs/results.md)")
        .excludes(quiet);
}

}  // namespace abut::apps
