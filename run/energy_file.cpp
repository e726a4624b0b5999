#include "abut/run/energy_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/run/files.hpp"

namespace abut::run {

template <int Dim>
EnergyFile<Dim>::EnergyFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
    partial_ += ".partial";
}

template <int Dim>
void EnergyFile<Dim>::begin(const Scene<Dim>&, const RunResult<Dim>&) {
    file_.open(partial_, std::ios::binary);
    file_ << fmt::format("{}\n", fmt::join(dynamics::ledger_columns<Dim>(), ","));
    check();
}

template <int Dim>
void EnergyFile<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>&) {
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
    if (!file_) throw BadInput(cannot_be_written(partial_));
}

template class EnergyFile<2>;
template class EnergyFile<3>;

}  // namespace abut::run
