#pragma once
#include <fmt/format.h>

#include <string>

namespace abut::apps {

[[nodiscard]] inline std::string info_line(const std::string& name, const std::string& value) {
    return fmt::format("  {:<17} {}\n", name, value);
}

}  // namespace abut::apps
