#pragma once
#include <string>

namespace abut::input {

/// All keys of a scene, table by table, in Markdown: what each takes, its unit, its default and what it means. It is printed
/// from what reads a scene.
[[nodiscard]] std::string grammar();

}  // namespace abut::input
