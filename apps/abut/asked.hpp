#pragma once
#include <filesystem>
#include <string>

#include "apps/support/cli.hpp"

namespace abut::apps {

/// Commands that answer with text and leave nothing behind.
struct Asked {
    CLI::App* app = nullptr;  ///< of which help, manual page and completion speak
    CLI::App* info = nullptr;
    CLI::App* help = nullptr;
    CLI::App* completion = nullptr;
    CLI::App* man = nullptr;
    std::filesystem::path file;  ///< of info
    std::string topic;           ///< of help; empty: all of them
    std::string shell;           ///< of completion
};

/// Adds info, help, completion and man to a program whose other commands are there already. `asked` must outlive the app.
void add_asked(CLI::App& app, Asked& asked);

/// The text of the command that was parsed. Throws BadInput.
[[nodiscard]] std::string answer(const Asked& asked);

}  // namespace abut::apps
