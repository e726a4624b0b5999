#include <fmt/format.h>

#include "apps/abut/build_info.hpp"

namespace abut::apps {

std::string version_text() {
    const BuildInfo& info = build_info();
    std::string text = fmt::format("abut {}\n", info.version);
    const auto line = [&](const std::string& name, const std::string& value) {
        if (!value.empty()) text += fmt::format("  {:<15}{}\n", name, value);
    };
    line("commit", info.commit);
    line("compiler", info.compiler);
    line("build", fmt::format("{}, for {}", info.build_type.empty() ? "no build type" : info.build_type, info.processor));
    for (const LibraryVersion& library : info.libraries)
        line(library.name, library.version.empty() ? "not in this build" : library.version);
    text.pop_back();  // who prints a version ends its last line
    return text;
}

}  // namespace abut::apps
