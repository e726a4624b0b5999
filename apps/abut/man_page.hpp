#pragma once
#include <span>
#include <string>
#include <vector>

#include "apps/abut/topics.hpp"
#include "apps/support/command_parser.hpp"

namespace abut::apps {

/// Head of a manual page.
struct ManPage {
    std::string program;
    std::string version;
    std::string purpose;  ///< one sentence, with its full stop
};

/// The page as troff with the macros of man(7): commands with their options, then the topics.
[[nodiscard]] std::string man_page(const ManPage& page, const std::vector<Command>& commands, std::span<const Topic> topics);

}  // namespace abut::apps
