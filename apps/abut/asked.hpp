#pragma once
#include <filesystem>
#include <string>

#include "apps/support/command_parser.hpp"

namespace abut::apps {

/// Commands that answer with text and leave nothing behind.
struct Asked {
    CommandParser* program = nullptr;  ///< of which help, manual page and completion speak
    CommandParser* info = nullptr;
    CommandParser* help = nullptr;
    CommandParser* completion = nullptr;
    CommandParser* man = nullptr;
    std::filesystem::path file;  ///< of info
    std::string topic;           ///< of help; empty: all of them
    std::string shell;           ///< of completion
};

/// Adds info, help, completion and man to a program whose other commands are there already. `asked` must outlive the parser.
void add_asked(CommandParser& parser, Asked& asked);

/// The text of the command that was parsed. Throws BadInput.
[[nodiscard]] std::string answer(const Asked& asked);

}  // namespace abut::apps
