#include "apps/support/energy_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/support/files.hpp"

namespace abut::examples {

template <int Dim>
EnergyFile<Dim>::EnergyFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
    partial_ += ".partial";
    file_.open(partial_, std::ios::binary);
    file_ << fmt::format("{}\n", fmt::join(dynamics::ledger_columns<Dim>(), ","));
    check();
}

template <int Dim>
void EnergyFile<Dim>::append(const dynamics::LedgerEntry<Dim>& entry) {
    std::vector<std::string> values;
    for (const double value : dynamics::ledger_values(entry)) values.push_back(fmt::format("{:.17g}", value));
    file_ << fmt::format("{}\n", fmt::join(values, ","));
    check();
}

template <int Dim>
void EnergyFile<Dim>::finish() {
    file_.close();
    check();
    move_file(partial_, path_);
}

template <int Dim>
void EnergyFile<Dim>::check() const {
    if (!file_) throw std::runtime_error(cannot_be_written(partial_));
}

template class EnergyFile<2>;
template class EnergyFile<3>;

}  // namespace abut::examples
