#pragma once
// Private to the sources of run.
#include <nlohmann/json.hpp>

#include <string>

#include "abut/run/values/value.hpp"

namespace abut::run {

using Json = nlohmann::ordered_json;

/// As a file or a line; what is not UTF-8 in it, as of a path, has U+FFFD in its place: no result is lost for a name.
[[nodiscard]] inline std::string text_of(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

[[nodiscard]] inline Json to_json(const Value& value) {
    return std::visit(
        [](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
                return Json();
            else
                return Json(held);
        },
        value);
}

[[nodiscard]] inline Json to_json(const NamedValues& values) {
    Json json = Json::object();
    for (const NamedValue& value : values) json[value.name] = to_json(value.value);
    return json;
}

}  // namespace abut::run
