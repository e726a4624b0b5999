#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/run/files/partial_file.hpp"
#include "abut/run/files/snapshot.hpp"
#include "abut/run/observer.hpp"

namespace abut::run {

/// File name of the animation of a run.
inline constexpr const char* animation_name = "animation.html";
/// Size that an animation is kept within [bytes].
inline constexpr double animation_limit = 50e6;

/// A run as a film in one HTML file that needs no other and no network: the bodies as SnapshotMaker has them and the
/// obstacles, in `n_frames` frames equally far apart, first and last step included; fewer where as many would not fit
/// in `limit`, two at least, which the page says. A run that goes on beyond the end of another one adds more, as far
/// apart, whatever their size. Positions are rounded to 1/65535 of the box that holds all bodies of a frame, values to
/// 1/65534 of the largest one.
///
/// It is written as it goes, and is called `path`.partial until `finish`; renamed to .html that can be looked at, too. On
/// several ranks the whole is brought together for each frame.
template <int Dim>
class Animation : public Observer<Dim> {
public:
    Animation(std::filesystem::path path, std::string program, int n_frames, double limit = animation_limit);

    /// Opens the file. Throws BadInput if it cannot be written.
    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Throws BadInput if a frame cannot be written.
    void see(const Sight<Dim>& sight) override;
    void cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) override;
    [[nodiscard]] bool wants_sight(std::int64_t step) const override;
    void save(StateWriter& state) override;
    /// Throws BadInput if frames that were written are gone.
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;
    /// The run is complete: gives the file its name. Throws BadInput if it cannot.
    void finish();

private:
    void look_up(const Scene<Dim>& scene, const RunResult<Dim>& result);

    PartialFile file_;
    std::string program_;
    std::int64_t n_frames_;
    double limit_;
    std::optional<SnapshotMaker<Dim>> maker_;  // once the run has begun
    std::vector<contact::RigidObstacle<Dim>> obstacles_;
    std::int64_t n_kept_ = 0;  // of the frames asked for
    std::int64_t n_written_ = 0;
    std::int64_t n_steps_ = 0;
    std::int64_t n_spread_ = 0;  // steps that the frames are spread over: those of the run, or of the one it goes on from
};

}  // namespace abut::run
