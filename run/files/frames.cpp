#include "abut/run/files/frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "abut/run/files/files.hpp"
#include "abut/run/files/obstacle_frames.hpp"
#include "abut/run/files/xdmf_series.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/frame_piece.hpp"
#include "abut/run/values/sight.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {
namespace {

std::vector<double> in_contact(std::vector<double> gaps) {
    for (double& gap : gaps) gap = gap_in_contact(gap);
    return gaps;
}

/// Stresses of some cells, and what follows from them.
template <int Dim>
struct Stresses {
    explicit Stresses(const Sight<Dim>& sight) {
        for (std::size_t c = 0; c < sight.stress.size(); ++c) add(sight.stress[c], sight.out_of_plane_stress[c]);
        plastic_strain = sight.plastic_strain;
    }
    explicit Stresses(const FramePiece<Dim>& piece) {
        for (std::size_t i = 0; i < piece.cells.size(); ++i) add(piece.stress[i], piece.out_of_plane_stress[i]);
        plastic_strain = piece.plastic_strain;
    }
    void add(const Matrix<Dim>& of_cell, double out_of_plane_stress) {
        stress.push_back(of_cell);
        equivalent.push_back(von_mises<Dim>(of_cell, out_of_plane_stress));
        out_of_plane.push_back(out_of_plane_stress);
    }
    std::vector<Matrix<Dim>> stress;
    std::vector<double> equivalent;
    std::vector<double> out_of_plane;
    std::vector<double> plastic_strain;  // empty where no material has one
};

template <int Dim>
std::vector<mesh::Field<Dim>> cell_fields(const FrameFields& fields, std::span<const Vector<Dim>> velocity,
                                          const Stresses<Dim>& stresses, std::span<const double> fragment) {
    std::vector<mesh::Field<Dim>> chosen;
    if (fields.velocity) chosen.push_back({"velocity [m/s]", velocity});
    if (fields.stress) chosen.push_back({"stress [Pa]", std::span<const Matrix<Dim>>(stresses.stress)});
    if (fields.von_mises) chosen.push_back({"von Mises [Pa]", std::span<const double>(stresses.equivalent)});
    if (Dim == 2 && fields.stress) chosen.push_back({"stress zz [Pa]", std::span<const double>(stresses.out_of_plane)});
    if (fields.plastic_strain && !stresses.plastic_strain.empty())
        chosen.push_back({"plastic strain", std::span<const double>(stresses.plastic_strain)});
    if (!fragment.empty()) chosen.push_back({"fragment", fragment});
    return chosen;
}

template <int Dim>
std::vector<mesh::Field<Dim>> boundary_fields(const FrameFields& fields, std::span<const double> gap, const auto& contact,
                                              std::span<const double> bond) {
    std::vector<mesh::Field<Dim>> chosen;
    if (fields.pressure) chosen.push_back({"contact pressure [Pa]", contact.pressure});
    if (fields.gap) chosen.push_back({"gap [m]", gap});
    if (fields.friction && !contact.friction.empty()) {
        chosen.push_back({"friction [Pa]", contact.friction});
        chosen.push_back({"slip [m]", contact.slip});
        chosen.push_back({"sticks 1, slides 2", contact.sliding});
    }
    if (!bond.empty()) chosen.push_back({"bond", bond});
    return chosen;
}

/// Fields that files show of a piece; both arguments must outlive it.
template <int Dim>
mesh::PieceFrame<Dim> shown(const FrameFields& fields, const FramePiece<Dim>& piece, const Stresses<Dim>& stresses) {
    return {.time = piece.time,
            .cells = piece.cells,
            .cell_number = piece.cell_number,
            .vertices = piece.vertices,
            .boundary = piece.boundary,
            .face_number = piece.face_number,
            .displacement = piece.displacement,
            .vertex_displacement = piece.vertex_displacement,
            .cell_fields = cell_fields<Dim>(fields, piece.velocity, stresses, piece.fragment),
            .boundary_fields = boundary_fields<Dim>(fields, piece.gap, piece, piece.bond)};
}

template <int Dim>
void write_piece(const std::filesystem::path& directory, const std::string& series, const FrameFields& fields,
                 const FramePiece<Dim>& piece) {
    const Stresses<Dim> stresses(piece);
    mesh::write_piece(directory, series, static_cast<std::size_t>(piece.frame), piece.number, *piece.mesh,
                      shown<Dim>(fields, piece, stresses));
}

/// Position of a face of bodies whose vertices are known or whose cells are displaced as a whole.
template <int Dim>
Vector<Dim> middle_of(solid::BoundaryFace boundary, const mesh::Mesh<Dim>& mesh, std::span<const Vector<Dim>> of_cells,
                      std::span<const Vector<Dim>> of_vertices) {
    const std::int32_t face = solid::mesh_face(mesh, boundary);
    const Vector<Dim>& x = mesh.face_centroid[static_cast<std::size_t>(face)];
    if (of_vertices.empty()) return x + of_cells[static_cast<std::size_t>(solid::cell_of(mesh, boundary))];
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const std::int32_t vertex : mesh.face_vertices[face]) sum += of_vertices[static_cast<std::size_t>(vertex)];
    return x + sum / static_cast<double>(mesh.face_vertices[face].size());
}

/// Pairs as points with fields.
template <int Dim>
class PairPoints {
public:
    PairPoints(const Sight<Dim>& sight, std::span<const Vector<Dim>> of_vertices) {
        const mesh::Mesh<Dim>& mesh = *sight.mesh;
        const auto body_of = [&](solid::BoundaryFace face) {
            return face == solid::no_face ? -1 : mesh.cell_body[static_cast<std::size_t>(solid::cell_of(mesh, face))];
        };
        for (const solid::ActingPair<Dim>& pair : sight.pairs) {
            Vector<Dim> sum = Vector<Dim>::Zero();
            int n_faces = 0;
            for (const solid::BoundaryFace face : {pair.face_1, pair.face_2})
                if (face != solid::no_face) {
                    sum += middle_of<Dim>(face, mesh, sight.displacement, of_vertices);
                    ++n_faces;
                }
            position_.push_back(sum / n_faces);
            body_1_.push_back(body_of(pair.face_1));
            body_2_.push_back(body_of(pair.face_2));
            normal_.push_back(pair.normal);
            force_.push_back(pair.force);
            friction_.push_back(pair.friction);
            normal_force_.push_back(pair.normal_force);
            gap_.push_back(pair.gap);
            area_.push_back(pair.area);
        }
    }

    [[nodiscard]] mesh::PointFrame<Dim> frame(double time, bool with_friction) const {
        mesh::PointFrame<Dim> frame{.time = time,
                                    .position = position_,
                                    .fields = {{"body 1", body_1_},
                                               {"body 2", body_2_},
                                               {"normal", normal_},
                                               {"force [N]", force_},
                                               {"normal force [N]", normal_force_},
                                               {"gap [m]", gap_},
                                               {Dim == 2 ? "area [m]" : "area [m^2]", area_}}};
        if (with_friction) frame.fields.push_back({"friction [N]", friction_});
        return frame;
    }

private:
    std::vector<Vector<Dim>> position_, normal_, force_, friction_;
    std::vector<double> body_1_, body_2_, normal_force_, gap_, area_;
};

}  // namespace

template <int Dim>
double von_mises(const Matrix<Dim>& stress, double out_of_plane_stress) {
    Matrix<3> full = in_3d<Dim>(stress);
    if constexpr (Dim == 2) full(2, 2) = out_of_plane_stress;
    const Matrix<3> deviator = full - full.trace() / 3.0 * Matrix<3>::Identity();
    return std::sqrt(1.5) * deviator.norm();
}

template <int Dim>
Frames<Dim>::Frames(std::filesystem::path directory, std::string series, int n_frames, FrameFormat format, bool in_pieces)
    : directory_(std::move(directory)),
      name_(std::move(series)),
      n_frames_(n_frames),
      format_(format),
      in_pieces_(in_pieces) {}

template <int Dim>
Frames<Dim>::~Frames() = default;

template <int Dim>
void Frames<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    if (in_pieces_)
        pieces_.emplace(directory_, name_);
    else if (format_ == FrameFormat::xdmf)
        xdmf_ = std::make_unique<XdmfSeries<Dim>>(directory_, name_, scene.mesh);
    else
        series_.emplace(directory_, name_, scene.mesh);
    fields_ = scene.outputs.fields;
    if (fields_.pairs && scene.contact) pairs_.emplace(directory_, pairs_series(name_));
    for (std::int32_t body = 0; body < scene.mesh.n_bodies(); ++body)
        bodies_.push_back({"body: " + scene.mesh.body_names[static_cast<std::size_t>(body)], body});
    if (!scene.solid.obstacles.empty())
        obstacles_ = std::make_unique<ObstacleFrames<Dim>>(directory_, obstacles_series(name_), scene);
    if (may_lose_cells(scene)) {
        first_cells_.resize(scene.mesh.cell_measure.size());
        std::iota(first_cells_.begin(), first_cells_.end(), 0.0);
    }
    at_times_ = !result.options.times.empty();
    n_spread_ = n_steps_ = result.run.steps;
}

template <int Dim>
void Frames<Dim>::cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) {
    first_cells_.assign(first_cells.begin(), first_cells.end());
    if (xdmf_)
        xdmf_->take_mesh(solid.mesh());
    else
        series_->take_mesh(solid.mesh());
}

template <int Dim>
void Frames<Dim>::see(const Sight<Dim>& sight) {
    write(sight);
}

template <int Dim>
void Frames<Dim>::see_at_time(const Sight<Dim>& sight) {
    write(sight);
}

/// The number of the frame that is due at this step, where so many are written; -1: none.
template <int Dim>
std::int64_t Frames<Dim>::due(std::int64_t step, std::int64_t n_written) const {
    if (at_times_) return -1;
    const std::int64_t intervals = std::max<std::int64_t>(1, n_frames_ - 1);
    const bool more = n_written < n_frames_ || n_steps_ > n_spread_;
    return more && step * intervals >= n_written * n_spread_ ? n_written : -1;
}

template <int Dim>
bool Frames<Dim>::wants_sight(std::int64_t step) const {
    if (!in_pieces_) return due(step, std::ssize(times())) >= 0;
    return pairs_ && due(step, static_cast<std::int64_t>(pairs_->times().size())) >= 0;
}

template <int Dim>
std::int64_t Frames<Dim>::wants_piece(std::int64_t step) const {
    return in_pieces_ ? due(step, static_cast<std::int64_t>(pieces_->n_frames())) : -1;
}

template <int Dim>
const std::vector<double>& Frames<Dim>::times() const {
    if (in_pieces_) return pieces_->times();
    return xdmf_ ? xdmf_->times() : series_->times();
}

template <int Dim>
void Frames<Dim>::write_whole_frame(const mesh::Frame<Dim>& frame) {
    if (xdmf_)
        xdmf_->write(frame);
    else
        series_->write(frame);
}

template <int Dim>
void Frames<Dim>::save(StateWriter& state) {
    state.put(n_spread_);
    state.put_all(std::span(times()));
}

template <int Dim>
void Frames<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    begin(scene, result);
    n_spread_ = state.get<std::int64_t>();
    const auto times = state.get_all<double>();
    if (in_pieces_)
        pieces_->go_on_after(times);
    else if (xdmf_)
        xdmf_->go_on_after(times);
    else
        series_->go_on_after(times);
    if (pairs_) pairs_->go_on_after(times);
    if (obstacles_) obstacles_->go_on_after(times);
}

template <int Dim>
void Frames<Dim>::write(const Sight<Dim>& sight) {
    std::vector<Vector<Dim>> of_vertices;  // a body that turns is not where the mean displacement of its cells takes it
    if (sight.any_turns) of_vertices = sight.vertex_displacement();
    if (pairs_) write_pairs(sight, of_vertices);
    if (in_pieces_) return;
    const auto gap = in_contact(sight.contact.gap);
    const Stresses<Dim> stresses(sight);
    mesh::Frame<Dim> frame{
        .time = sight.moment.time, .displacement = sight.displacement, .vertex_displacement = of_vertices};
    frame.cell_fields = cell_fields<Dim>(fields_, sight.velocity, stresses, sight.fragment);
    if (!first_cells_.empty()) frame.cell_fields.push_back({"cell of the scene", std::span<const double>(first_cells_)});
    frame.boundary_fields = boundary_fields<Dim>(fields_, gap, sight.contact, sight.bond);
    if (obstacles_) obstacles_->write(sight.moment.time);
    write_whole_frame(frame);
}

template <int Dim>
void Frames<Dim>::write_pairs(const Sight<Dim>& sight, std::span<const Vector<Dim>> of_vertices) {
    const PairPoints<Dim> points(sight, of_vertices);
    mesh::PointFrame<Dim> frame = points.frame(sight.moment.time, fields_.friction && sight.options->has_friction());
    frame.numbers = bodies_;
    pairs_->write(frame);
}

template <int Dim>
void Frames<Dim>::piece(const FramePiece<Dim>& piece) {
    if (in_pieces_) write_piece<Dim>(directory_, name_, fields_, piece);
}

template <int Dim>
void Frames<Dim>::all_pieces(const FramePiece<Dim>& piece) {
    if (!in_pieces_) return;
    const Stresses<Dim> stresses(piece);
    if (obstacles_) obstacles_->write(piece.time);
    pieces_->publish(piece.n_pieces, *piece.mesh, shown<Dim>(fields_, piece, stresses));
}

template <int Dim>
void PieceFiles<Dim>::piece(const FramePiece<Dim>& piece) {
    write_piece<Dim>(directory_, name_, fields_, piece);
}

#define ABUT_INSTANTIATE(Dim)       \
    template class Frames<Dim>;     \
    template class PieceFiles<Dim>; \
    template double von_mises<Dim>(const Matrix<Dim>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
