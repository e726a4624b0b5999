#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/run/files/contact_forces.hpp"
#include "abut/run/files/partial_file.hpp"
#include "abut/run/observer.hpp"

namespace abut::run {

/// Forces of contact (ContactForces) as CSV. Columns: step, time [s], body_1, body_2 (names), the mean on body 2 as
/// "force_on_2_x" and so on [N], "normal_force" [N], what of the first is friction, "friction_on_2_x", the part of the
/// second where there is friction, "rubbing_force" [N], and the velocity of body 2 past body 1 there,
/// "slip_velocity_of_2_x" [m/s].
///
/// It is written as it goes, and is called `path`.partial until `finish`.
template <int Dim>
class ForceFile : public Observer<Dim> {
public:
    explicit ForceFile(std::filesystem::path path);

    /// Opens the file. Throws BadInput if it cannot be written.
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Throws BadInput if rows cannot be written.
    void note(const Moment<Dim>& moment) override;
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
