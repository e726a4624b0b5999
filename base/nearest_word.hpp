#pragma once
#include <optional>
#include <string>
#include <vector>

namespace abut {

/// The known word with the fewest letters to change, take out, put in or swap; of several that are as near, the one that
/// begins alike for longest. Nothing where more than a third of the letters would change.
[[nodiscard]] std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace abut
