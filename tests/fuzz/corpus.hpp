#pragma once
#include <string>
#include <vector>

namespace abut::fuzz {

/// The formats that can be asked for: their extensions without the point.
[[nodiscard]] const std::vector<std::string>& formats();

/// Small valid files of a format, each different in kind: text and binary, compressed and not. Throws std::invalid_argument
/// for one that is none of formats().
[[nodiscard]] std::vector<std::string> corpus(const std::string& format);

}  // namespace abut::fuzz
