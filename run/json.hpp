#pragma once
// Private to the sources of run.
#include <nlohmann/json.hpp>

#include "abut/run/value.hpp"

namespace abut::run {

using Json = nlohmann::ordered_json;

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
