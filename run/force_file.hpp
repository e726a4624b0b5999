#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/run/contact_forces.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/partial_file.hpp"

namespace abut::run {

/// Forces of contact (ContactForces) as CSV. Columns: step, time [s], body_1, body_2 (names), "force_x" and so on [N], the mean
/// on body 2, and "normal_force" [N].
///
/// It is written as it goes, and is called `path`.partial until `finish`.
template <int Dim>
class ForceFile : public Observer<Dim> {
public:
    explicit ForceFile(std::filesystem::path path);

    /// Opens the file. Throws BadInput if it cannot be written.
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Throws BadInput if rows cannot be written.
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override;
    [[nodiscard]] bool wants_look(std::int64_t step) const override;
    void save(StateWriter& state) override;
    /// Throws BadInput if rows that were written are gone.
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;
    /// The run is complete: gives the file its name. Throws BadInput if it cannot.
    void finish();

private:
    void look_up(const Scene<Dim>& scene, const RunResult<Dim>& result);
    PartialFile file_;
    std::vector<std::string> names_;  // of bodies, then of obstacles
    ContactForces<Dim> forces_;
};

}  // namespace abut::run
