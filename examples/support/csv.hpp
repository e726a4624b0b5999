#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace abut::examples {

/// Rows of numbers under the names of their columns.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;  ///< each as long as `columns`
};

/// 17 significant digits, so that every bit comes back. Never seen half-written; throws std::runtime_error.
void write_csv(const std::filesystem::path& path, const Table& table);

/// Text as a field: in quotation marks, those inside doubled.
[[nodiscard]] std::string quoted(const std::string& text);

}  // namespace abut::examples
