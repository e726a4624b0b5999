#pragma once
#include <filesystem>
#include <string>

namespace abut::studies {

/// A script of gnuplot without its beginning: terminal, size, what the file is called and the looks that all pictures share
/// are put in front of it.
struct Picture {
    std::string name;     ///< of the files: NAME.gp and NAME.png
    std::string purpose;  ///< one line, ends the first comment of the script
    int width = 1200;     ///< [pixels]
    int height = 1000;
    std::string script;
};

/// NAME.gp in a folder, and NAME.png, which the program gnuplot makes of it. Says why there is no picture; empty if there
/// is one. Throws BadInput if the script cannot be written.
[[nodiscard]] std::string draw(const std::filesystem::path& directory, const Picture& picture);

/// A text as it stands between single quotes of gnuplot, which takes all else there as it is.
[[nodiscard]] std::string in_quotes(const std::string& text);

}  // namespace abut::studies
