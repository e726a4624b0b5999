#pragma once
#include <string>

namespace abut::input {

/// All materials that scenes know by their names (solid::known_materials) with their values and sources, in Markdown.
[[nodiscard]] std::string table_of_materials();

}  // namespace abut::input
