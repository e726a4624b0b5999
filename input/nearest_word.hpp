#pragma once
// Private to the layer.
#include <string>
#include <vector>

namespace abut::input {

/// " Did you mean 'density'?" for the known word with the fewest letters to change, take out, put in or swap; where none is
/// near, " Known are 'a', 'b'."; empty if nothing is known.
[[nodiscard]] std::string hint(const std::string& word, const std::vector<std::string>& known);

/// Hint for a key: words that other programs have for one of ours are known ("E", "rho", "t_end"), and so are some for what
/// is not there.
[[nodiscard]] std::string hint_of_key(const std::string& word, const std::vector<std::string>& known);

/// As `hint`, of a name of several words: names that hold all of it, or one of its words, in small or capital letters,
/// come first.
[[nodiscard]] std::string hint_of_name(const std::string& name, const std::vector<std::string>& known);

}  // namespace abut::input
