#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/mesh/io/point_series.hpp"
#include "abut/mesh/io/write_pieces.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/options.hpp"
#include "abut/run/values/outputs.hpp"

namespace abut::run {

template <int Dim>
class ObstacleFrames;
template <int Dim>
class XdmfSeries;

/// A run as a series for ParaView: displacement [m], velocity [m/s], stress and von Mises stress [Pa] on cells, contact
/// pressure [Pa] and gap [m] on boundary faces (NaN on faces that are not in contact); and, as points of a series of
/// their own, SERIES_pairs, pairs of faces that push each other, in the middle between their centres: bodies (-1: an
/// obstacle), normal and force on the second body [N], normal force [N], gap [m] and area [m^(Dim-1)]; and, where there are
/// obstacles, SERIES_obstacles with their faces where they are. `n_frames` equally
/// far apart, first and last step included (a run that goes on beyond the end of another one writes more, as far apart), or
/// at RunOptions::times; Outputs::fields may leave fields out. `series` is what files are called by, see mesh::VtuSeries,
/// which also says what they throw if they cannot be written.
///
/// Of a run that cells may leave, those that have left are missing, and "cell of the scene" is the number that a cell has in
/// the scene's mesh.
///
/// With FrameFormat::xdmf cells and boundary faces are in one file (SERIES.h5, beside SERIES.xmf and SERIES_surface.xmf) in
/// place of the .vtu and .vtp files.
///
/// In pieces the same, but each rank writes its own cells and their boundary faces (mesh::PieceSeries; on ranks other
/// than 0 by PieceFiles). Pairs are not in pieces: rank 0 writes them, and brings the whole together for them unless
/// they are left out.
template <int Dim>
class Frames : public Observer<Dim> {
public:
    /// Nothing is written before the run begins; `n_frames` > 0, unless the run has RunOptions::times.
    Frames(std::filesystem::path directory, std::string series, int n_frames, FrameFormat format = FrameFormat::vtu,
           bool in_pieces = false);
    ~Frames() override;
    Frames(const Frames&) = delete;
    Frames& operator=(const Frames&) = delete;

    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    /// Writes a frame.
    void see(const Sight<Dim>& sight) override;
    void see_at_time(const Sight<Dim>& sight) override;
    void cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) override;
    [[nodiscard]] bool wants_sight(std::int64_t step) const override;
    [[nodiscard]] std::int64_t wants_piece(std::int64_t step) const override;
    void piece(const FramePiece<Dim>& piece) override;
    void all_pieces(const FramePiece<Dim>& piece) override;
    void save(StateWriter& state) override;
    /// Extension of the files that list the frames of cells and boundary faces.
    [[nodiscard]] std::string list_extension() const { return format_ == FrameFormat::xdmf ? ".xmf" : ".pvd"; }
    [[nodiscard]] bool has_pairs() const { return pairs_.has_value(); }         ///< whether SERIES_pairs is written
    [[nodiscard]] bool has_obstacles() const { return obstacles_ != nullptr; }  ///< whether SERIES_obstacles is written
    /// Throws BadInput if frames that were written are gone.
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;

private:
    void write(const Sight<Dim>& sight);
    void write_pairs(const Sight<Dim>& sight, std::span<const Vector<Dim>> of_vertices);
    [[nodiscard]] std::int64_t due(std::int64_t step, std::int64_t n_written) const;

    [[nodiscard]] const std::vector<double>& times() const;
    void write_whole_frame(const mesh::Frame<Dim>& frame);

    std::filesystem::path directory_;
    std::string name_;
    std::int64_t n_frames_;
    FrameFormat format_;
    bool in_pieces_;
    bool at_times_ = false;  // those of the scene
    std::int64_t n_steps_ = 0;
    std::int64_t n_spread_ = 0;  // steps that the frames are spread over: those of the run, or of the one it goes on from
    FrameFields fields_;
    std::vector<double> first_cells_;             // numbers of the cells in the scene; empty: none may leave
    std::optional<mesh::VtuSeries<Dim>> series_;  // of the whole, or
    std::unique_ptr<XdmfSeries<Dim>> xdmf_;       // in one file, or
    std::optional<mesh::PieceSeries> pieces_;     // in pieces
    std::optional<mesh::PointSeries<Dim>> pairs_;
    std::vector<mesh::NamedNumber> bodies_;  // of pairs
    std::unique_ptr<ObstacleFrames<Dim>> obstacles_;
};

/// Files of frames in pieces that a rank other than 0 writes.
template <int Dim>
class PieceFiles : public Observer<Dim> {
public:
    PieceFiles(std::filesystem::path directory, std::string series, FrameFields fields)
        : directory_(std::move(directory)), name_(std::move(series)), fields_(fields) {}
    void piece(const FramePiece<Dim>& piece) override;

private:
    std::filesystem::path directory_;
    std::string name_;
    FrameFields fields_;
};

/// von Mises equivalent stress [Pa]; in 2D with the stress out of the plane, Solid::out_of_plane_stress.
template <int Dim>
[[nodiscard]] double von_mises(const Matrix<Dim>& stress, double out_of_plane_stress);

}  // namespace abut::run
