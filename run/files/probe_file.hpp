#pragma once
#include <cstdint>
#include <filesystem>

#include "abut/run/files/partial_file.hpp"
#include "abut/run/files/probes.hpp"
#include "abut/run/observer.hpp"

namespace abut::run {

/// Probes as CSV: a row at each look. Columns are step, time and, for each probe, "<name>.displacement_x" and so on,
/// Probes::columns.
///
/// It is written as it goes, and is called `path`.partial until `finish`.
template <int Dim>
class ProbeFile : public Observer<Dim> {
public:
    explicit ProbeFile(std::filesystem::path path);

    /// Opens the file. Throws BadInput if it cannot be written, for a body that does not exist, and for a place that is
    /// beside its body, with the distance.
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Throws BadInput if a row cannot be written.
    void see(const Sight<Dim>& sight) override;
    void cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) override;
    [[nodiscard]] bool wants_sight(std::int64_t step) const override;
    void save(StateWriter& state) override;
    /// Throws BadInput if rows that were written are gone.
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;
    /// The run is complete: gives the file its name. Throws BadInput if it cannot.
    void finish();

private:
    PartialFile file_;
    Probes<Dim> probes_;
};

}  // namespace abut::run
