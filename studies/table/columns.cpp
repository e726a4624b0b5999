#include "studies/table/columns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/support/csv.hpp"

namespace abut::studies {

std::string shown(const Cell& cell, int width, const char* digits) {
    std::string text = std::visit([](const auto& value) { return fmt::format("{}", value); }, cell);
    if (const auto* number = std::get_if<double>(&cell))
        text = std::isnan(*number) ? "-" : fmt::format(fmt::runtime(digits), *number);
    return width < 0 ? fmt::format("{:<{}}", text, -width) : fmt::format("{:>{}}", text, width);
}

std::string field(const Cell& cell, bool is_quoted) {
    if (const auto* number = std::get_if<double>(&cell)) return apps::all_digits(*number);
    if (const auto* is = std::get_if<bool>(&cell)) return *is ? "1" : "0";
    const std::string text = std::visit([](const auto& value) { return fmt::format("{}", value); }, cell);
    return is_quoted ? apps::quoted(text) : text;
}

nlohmann::ordered_json to_json(const std::vector<std::pair<std::string, Cell>>& members) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [key, cell] : members) {
        const auto* number = std::get_if<double>(&cell);
        json[key] = number ? apps::json_number(*number)
                           : std::visit([](const auto& value) { return nlohmann::ordered_json(value); }, cell);
    }
    return json;
}

nlohmann::ordered_json begun_summary(const apps::Program& program) {
    return {{"program", program.name}, {"version", ABUT_VERSION}};
}

}  // namespace abut::studies
