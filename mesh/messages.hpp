#pragma once
#include <cstdio>
#include <string>

namespace abut::mesh {

/// A value as error messages show it: "2.1e-04".
[[nodiscard]] inline std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace abut::mesh
