#include "abut/run/report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "abut/base/error.hpp"

namespace abut::run {

std::string shown(const Json& value, bool rough) {
    if (value.is_null()) return "–";
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float())
        return rough ? fmt::format("{:.2g}", value.get<double>()) : fmt::format("{:.6g}", value.get<double>());
    if (!value.is_array()) return text_of(value);
    std::string text;
    for (const Json& each : value) text += (text.empty() ? "" : ", ") + shown(each, rough);
    return text.empty() ? "–" : text;
}

const Json& Figures::find(const std::string& path) const {
    std::string pointer = "/" + path;
    std::ranges::replace(pointer, '.', '/');
    const Json::json_pointer place(pointer);
    if (!summary_.contains(place)) throw Misuse(fmt::format("a summary has no {}", path));
    return summary_.at(place);
}

Markup Figures::at(const std::string& path, bool rough) const {
    const Json& value = find(path);
    Attributes attributes{{"id", path}, {"value", text_of(value)}};
    if (value.is_string()) attributes.emplace_back("class", "words");
    return element("data", attributes, shown(value, rough));
}

double Figures::number(const std::string& path) const {
    const Json& value = find(path);
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Markup Figures::over(const std::string& path, const EnergyScale& scale) const {
    return fmt::format("{:.2e}", scale.over(number(path)));
}

}  // namespace abut::run
