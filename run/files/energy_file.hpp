#pragma once
#include <filesystem>

#include "abut/run/files/partial_file.hpp"
#include "abut/run/observer.hpp"

namespace abut::run {

/// The ledger of a run as CSV: a row per entry, 17 significant digits, so that every bit comes back; the columns are those
/// of dynamics::ledger_columns, in SI units. It is written as it goes, and is called `path`.partial until `finish`.
template <int Dim>
class EnergyFile : public Observer<Dim> {
public:
    explicit EnergyFile(std::filesystem::path path);

    /// Opens the file. Throws BadInput if it cannot be written.
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Writes the rows of all entries so far once more.
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;
    /// Throws BadInput if the row cannot be written.
    void record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>& result) override;
    [[nodiscard]] bool wants_look(std::int64_t) const override { return false; }
    /// The run is complete: gives the file its name. Throws BadInput if it cannot.
    void finish();

    [[nodiscard]] const std::filesystem::path& path() const { return file_.path(); }

private:
    PartialFile file_;
};

}  // namespace abut::run
