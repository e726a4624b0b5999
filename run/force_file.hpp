#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/observer.hpp"
#include "abut/run/partial_file.hpp"
#include "abut/solid/contact_results.hpp"

namespace abut::run {

/// Forces of contact as CSV: a row for each pair of bodies, or of a body and an obstacle, that touched since the last rows,
/// every `Outputs::interval` steps and at the end. Columns: step, time [s], body_1, body_2 (names), the mean force on body 2
/// since the last rows, "force_x" and so on [N], and "normal_force" [N], the sum over all faces of what presses them
/// together. Force times interval, summed over all rows, is the change of momentum that contact made, to round-off; not so
/// of Bilbao's scheme, whose steps take more than the force.
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
    std::int64_t interval_ = 1;
    std::int64_t n_steps_ = 0;
    double time_ = std::numeric_limits<double>::quiet_NaN();  // of the last rows, or of the start [s]
    std::map<std::pair<std::int32_t, std::int32_t>, solid::BodyImpulse<Dim>> last_;
};

}  // namespace abut::run
