#pragma once
// Private to the sources of run.
#include <string>
#include <string_view>

namespace abut::run {

/// Bytes as text of letters, digits, + and /, with = at the end where they are not a multiple of three (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace abut::run
