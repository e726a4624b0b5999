#pragma once
// Private to the sources of run.
#include <fmt/format.h>

#include <string>

namespace abut::run {

[[nodiscard]] inline std::string table_line(const std::string& name, const std::string& value) {
    return fmt::format("  {:<39} {}\n", name, value);
}

}  // namespace abut::run
