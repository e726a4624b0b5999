#pragma once
// Private to the layer.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/ledger.hpp"

namespace abut::run {

/// Values of all entries, row by row (Checkpoint::ledger).
template <int Dim>
[[nodiscard]] std::vector<double> ledger_rows(const dynamics::Ledger<Dim>& ledger) {
    std::vector<double> rows;
    for (const auto& entry : ledger.entries()) {
        const std::vector<double> values = dynamics::ledger_values(entry);
        rows.insert(rows.end(), values.begin(), values.end());
    }
    return rows;
}

/// Records the entries that have these values. Throws BadInput where there are none, or part of a row.
template <int Dim>
void record_rows(std::span<const double> rows, dynamics::Ledger<Dim>& ledger) {
    const std::size_t n = dynamics::ledger_columns<Dim>().size();
    if (rows.empty()) throw BadInput("a checkpoint without ledger cannot be gone on from.");
    for (; !rows.empty(); rows = rows.subspan(n))
        ledger.record(dynamics::ledger_entry<Dim>(rows.first(std::min(n, rows.size()))));
}

}  // namespace abut::run
