#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "abut/run/values/value.hpp"

namespace abut::apps {

/// Rows of numbers under the names of their columns.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;  ///< each as long as `columns`
};

/// 17 significant digits, so that every bit comes back. Never seen half-written. Throws BadInput.
void write_csv(const std::filesystem::path& path, const Table& table);

/// A number as a field: 17 significant digits; nothing where it is NaN.
[[nodiscard]] std::string all_digits(double number);
/// A number for people: two digits; "-" where it is NaN.
[[nodiscard]] std::string two_digits(double number);
/// null where it is no finite number.
[[nodiscard]] nlohmann::ordered_json json_number(double number);
/// A value, and values by name, as a summary shows them.
[[nodiscard]] nlohmann::ordered_json to_json(const run::Value& value);
[[nodiscard]] nlohmann::ordered_json to_json(const run::NamedValues& values);
/// Adds what else a summary names.
void append(run::NamedValues& values, const run::NamedValues& more);
/// A file of JSON. Never seen half-written; what is not UTF-8 in it, as of a path, has U+FFFD in its place. Throws BadInput.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& json);
/// Text as a field: in quotation marks, those inside doubled; as_cell.
[[nodiscard]] std::string quoted(const std::string& text);

}  // namespace abut::apps
