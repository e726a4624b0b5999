#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace abut {

/// "1 face", "2 faces", "0 bodies": a count before its noun, whose plural ends with s, with ies in the place of a y behind a
/// consonant, and with es behind s, x and ch. `noun` may have adjectives, "unusable face".
[[nodiscard]] std::string counted(std::int64_t count, std::string_view noun);
/// Count with its noun and verb in both numbers: "cell is", "cells are".
[[nodiscard]] std::string counted(std::int64_t count, std::string_view one, std::string_view several);

}  // namespace abut
