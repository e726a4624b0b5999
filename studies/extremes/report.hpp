#pragma once
#include <filesystem>
#include <vector>

#include "apps/support/program.hpp"
#include "studies/extremes/families.hpp"

namespace abut::studies::extremes {

/// The heads of the columns, and a line per row as they come.
[[nodiscard]] std::string table_heads();
void print(const Row& row);

/// Leaves extremes.csv, one line per row, and summary.json: of each family how many held, were refused and failed, the worst
/// numbers of those that ran, and all rows.
void write_report(const apps::Program& program, const std::filesystem::path& out, const SweepOptions& options,
                  const std::vector<Row>& rows);

}  // namespace abut::studies::extremes
