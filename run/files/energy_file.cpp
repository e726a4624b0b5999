#include "abut/run/files/energy_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "abut/run/files/column_units.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {

template <int Dim>
EnergyFile<Dim>::EnergyFile(std::filesystem::path path) : file_(std::move(path)) {}

template <int Dim>
void EnergyFile<Dim>::begin(const Scene<Dim>&, const RunResult<Dim>&) {
    file_.open();
    file_.write(fmt::format("{}\n", fmt::join(with_units<Dim>(dynamics::ledger_columns<Dim>()), ",")));
}

template <int Dim>
void EnergyFile<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader&) {
    begin(scene, result);
    for (const auto& entry : result.ledger.entries()) record(entry, result);
}

template <int Dim>
void EnergyFile<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>&) {
    std::vector<std::string> values;
    for (const double value : dynamics::ledger_values(entry)) values.push_back(fmt::format("{:.17g}", value));
    file_.write(fmt::format("{}\n", fmt::join(values, ",")));
}

template <int Dim>
void EnergyFile<Dim>::finish() {
    file_.finish();
}

template class EnergyFile<2>;
template class EnergyFile<3>;

}  // namespace abut::run
