#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "abut/mesh/io/point_series.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/run/observer.hpp"

namespace abut::run {

/// A run as a series for ParaView: displacement [m], velocity [m/s], stress and von Mises stress [Pa] on cells, contact
/// pressure [Pa] and gap [m] on boundary faces (a face that nothing faces has the gap NaN); and, as points of a series of
/// their own, SERIES_pairs, pairs of faces that push each other, in the middle between their centres: bodies (-1: an
/// obstacle), normal and force on the second body [N], normal force [N], gap [m] and area [m^(Dim-1)]. `n_frames` equally
/// far apart, first and last step included; Outputs::fields may leave fields out. `series` is what the files are called by, see
/// mesh::VtuSeries, which also says what they throw if they cannot be written.
template <int Dim>
class Frames : public Observer<Dim> {
public:
    /// Nothing is written before the run begins; `n_frames` > 0.
    Frames(std::filesystem::path directory, std::string series, int n_frames);

    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Writes a frame if one is due at this step.
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override;
    [[nodiscard]] bool wants_look(std::int64_t step) const override;
    void save(StateWriter& state) override;
    [[nodiscard]] bool has_pairs() const { return pairs_.has_value(); }  ///< whether SERIES_pairs is written
    /// Throws BadInput if frames that were written are gone.
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;

private:
    void write(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid);

    std::filesystem::path directory_;
    std::string name_;
    std::int64_t n_frames_;
    std::int64_t n_steps_ = 0;
    FrameFields fields_;
    std::optional<mesh::VtuSeries<Dim>> series_;
    std::optional<mesh::PointSeries<Dim>> pairs_;
};

/// von Mises equivalent stress [Pa]; in 2D of plane strain, with sigma_zz = nu (sigma_xx + sigma_yy).
template <int Dim>
[[nodiscard]] double von_mises(const Matrix<Dim>& stress, double poisson);

}  // namespace abut::run
