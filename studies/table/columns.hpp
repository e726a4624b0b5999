#pragma once
#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/support/program.hpp"

/// The one writer of tables: a list of columns says how a row is printed, and what it is in a CSV file and in a summary.
namespace abut::studies {

/// A value in a row. A number that is NaN stands for none: "-" for people, an empty field, null.
using Cell = std::variant<std::string, bool, std::int64_t, double>;

template <class Row>
struct Column {
    std::string key;                        ///< name in files; empty: for people alone
    std::string head;                       ///< name for people
    int width;                              ///< characters for people; below 0: text to the left; 0: for files alone
    std::function<Cell(const Row&)> value;  ///< also a pointer to a member
    const char* digits = "{:.2g}";          ///< of a number, for people
    bool is_quoted = false;                 ///< in CSV files, as text with commas has to be
};
template <class Row>
using Columns = std::vector<Column<Row>>;

/// A cell for people: padded to `width`.
[[nodiscard]] std::string shown(const Cell& cell, int width, const char* digits = "{}");
/// A field of a CSV file: all digits, 1 and 0 for true and false.
[[nodiscard]] std::string field(const Cell& cell, bool is_quoted);
/// An object; what is not finite is null.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<std::pair<std::string, Cell>>& members);
/// Members that every summary begins with: program and version.
[[nodiscard]] nlohmann::ordered_json begun_summary(const apps::Program& program);

/// The heads of the columns for people.
template <class Row>
[[nodiscard]] std::string heads(const Columns<Row>& columns) {
    std::string text;
    for (const Column<Row>& column : columns)
        if (column.width != 0) text += shown(column.head, column.width);
    return text;
}

/// A row for people, as far as the first `n` of the columns.
template <class Row>
[[nodiscard]] std::string line(const Columns<Row>& columns, const Row& row, std::size_t n = static_cast<std::size_t>(-1)) {
    std::string text;
    for (const Column<Row>& column : std::span(columns).first(n < columns.size() ? n : columns.size()))
        if (column.width != 0) text += shown(column.value(row), column.width, column.digits);
    return text;
}

/// A CSV file: the names, then a line per row.
template <class Row>
[[nodiscard]] std::string csv_text(const Columns<Row>& columns, const std::vector<Row>& rows) {
    std::string names, lines;
    for (const Column<Row>& column : columns)
        if (!column.key.empty()) names += (names.empty() ? "" : ",") + column.key;
    for (const Row& row : rows) {
        const char* between = "";
        for (const Column<Row>& column : columns) {
            if (column.key.empty()) continue;
            lines += between + field(column.value(row), column.is_quoted);
            between = ",";
        }
        lines += "\n";
    }
    return names + "\n" + lines;
}

/// A row of a file by the names of its columns.
template <class Row>
[[nodiscard]] std::vector<std::pair<std::string, Cell>> members(const Columns<Row>& columns, const Row& row) {
    std::vector<std::pair<std::string, Cell>> cells;
    for (const Column<Row>& column : columns)
        if (!column.key.empty()) cells.emplace_back(column.key, column.value(row));
    return cells;
}

}  // namespace abut::studies
