#pragma once
#include <string>
#include <vector>

namespace abut::apps {

/// A library that this build was made with.
struct LibraryVersion {
    std::string name;
    std::string version;  ///< empty: built without it
};

/// How this program was built. The values come from CMake, at the time when it was configured.
struct BuildInfo {
    std::string version;
    std::string commit;  ///< empty: not known
    std::string compiler;
    std::string build_type;
    std::string processor;  ///< "this machine" or "any"
    std::vector<LibraryVersion> libraries;
};

[[nodiscard]] const BuildInfo& build_info();

/// Text that abut --version prints: the first line is "abut 0.1.0".
[[nodiscard]] std::string version_text();

}  // namespace abut::apps
