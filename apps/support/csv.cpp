#include "apps/support/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <variant>

#include "abut/base/text.hpp"
#include "abut/run/files/files.hpp"

namespace abut::apps {

void write_csv(const std::filesystem::path& path, const Table& table) {
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(table.columns, ","));
    for (const auto& row : table.rows) fmt::format_to(std::back_inserter(text), "{:.17g}\n", fmt::join(row, ","));
    run::write_whole(path, fmt::to_string(text));
}

std::string all_digits(double number) { return std::isnan(number) ? "" : fmt::format("{:.17g}", number); }
std::string two_digits(double number) { return std::isnan(number) ? "-" : fmt::format("{:.2g}", number); }
nlohmann::ordered_json json_number(double number) {
    return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json();
}

nlohmann::ordered_json to_json(const run::Value& value) {
    return std::visit(
        [](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
                return nlohmann::ordered_json();
            else
                return nlohmann::ordered_json(held);
        },
        value);
}

nlohmann::ordered_json to_json(const run::NamedValues& values) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const run::NamedValue& value : values) json[value.name] = to_json(value.value);
    return json;
}

void append(run::NamedValues& values, const run::NamedValues& more) {
    values.insert(values.end(), more.begin(), more.end());
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
    run::write_whole(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : as_cell(text)) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

}  // namespace abut::apps
