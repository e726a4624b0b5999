#include "apps/support/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "abut/base/text.hpp"
#include "abut/run/files.hpp"

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

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json) {
    run::write_whole(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : as_cell(text)) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + "\"";
}

}  // namespace abut::apps
