#include "abut/run/frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "abut/run/cell_velocity.hpp"
#include "abut/run/files.hpp"
#include "abut/solid/boundary_face.hpp"

namespace abut::run {
namespace {

template <int Dim>
Matrix<3> full_stress(const Matrix<Dim>& stress, double poisson) {
    Matrix<3> full = Matrix<3>::Zero();
    full.topLeftCorner<Dim, Dim>() = stress;
    if constexpr (Dim == 2) full(2, 2) = poisson * stress.trace();
    return full;
}

std::vector<double> finite_or_nan(std::vector<double> values) {
    for (double& value : values)
        if (!std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
    return values;
}

/// Stresses of the cells as the last evaluation of the solid left them.
template <int Dim>
struct Stresses {
    explicit Stresses(solid::Solid<Dim>& solid) {
        for (std::int32_t c = 0; c < solid.mesh().n_cells(); ++c) {
            const auto body = static_cast<std::size_t>(solid.mesh().cell_body[static_cast<std::size_t>(c)]);
            const double poisson = solid.options().materials[body].poisson;
            stress.push_back(solid.stress(c));
            equivalent.push_back(von_mises<Dim>(stress.back(), poisson));
            out_of_plane.push_back(full_stress<Dim>(stress.back(), poisson)(2, 2));
        }
    }
    std::vector<Matrix<Dim>> stress;
    std::vector<double> equivalent;
    std::vector<double> out_of_plane;
};

/// Where a face is, of bodies whose vertices are known or whose cells are displaced as a whole.
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
    PairPoints(const std::vector<solid::ActingPair<Dim>>& pairs, const solid::Solid<Dim>& solid,
               std::span<const Vector<Dim>> of_cells, std::span<const Vector<Dim>> of_vertices) {
        const mesh::Mesh<Dim>& mesh = solid.mesh();
        const auto body_of = [&](solid::BoundaryFace face) {
            return face == solid::no_face ? -1 : mesh.cell_body[static_cast<std::size_t>(solid::cell_of(mesh, face))];
        };
        for (const solid::ActingPair<Dim>& pair : pairs) {
            Vector<Dim> sum = Vector<Dim>::Zero();
            int n_faces = 0;
            for (const solid::BoundaryFace face : {pair.face_1, pair.face_2})
                if (face != solid::no_face) {
                    sum += middle_of(face, mesh, of_cells, of_vertices);
                    ++n_faces;
                }
            position_.push_back(sum / n_faces);
            body_1_.push_back(body_of(pair.face_1));
            body_2_.push_back(body_of(pair.face_2));
            normal_.push_back(pair.normal);
            force_.push_back(pair.force);
            normal_force_.push_back(pair.normal_force);
            gap_.push_back(pair.gap);
            area_.push_back(pair.area);
        }
    }

    [[nodiscard]] mesh::PointFrame<Dim> frame(double time) const {
        return {.time = time,
                .position = position_,
                .fields = {{"body 1", body_1_},
                           {"body 2", body_2_},
                           {"normal", normal_},
                           {"force [N]", force_},
                           {"normal force [N]", normal_force_},
                           {"gap [m]", gap_},
                           {Dim == 2 ? "area [m]" : "area [m^2]", area_}}};
    }

private:
    std::vector<Vector<Dim>> position_, normal_, force_;
    std::vector<double> body_1_, body_2_, normal_force_, gap_, area_;
};

}  // namespace

template <int Dim>
double von_mises(const Matrix<Dim>& stress, double poisson) {
    const Matrix<3> full = full_stress<Dim>(stress, poisson);
    const Matrix<3> deviator = full - full.trace() / 3.0 * Matrix<3>::Identity();
    return std::sqrt(1.5) * deviator.norm();
}

template <int Dim>
Frames<Dim>::Frames(std::filesystem::path directory, std::string series, int n_frames)
    : directory_(std::move(directory)), name_(std::move(series)), n_frames_(n_frames) {}

template <int Dim>
void Frames<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    series_.emplace(directory_, name_, scene.mesh);
    fields_ = scene.outputs.fields;
    if (fields_.pairs && scene.contact) pairs_.emplace(directory_, pairs_series(name_));
    n_steps_ = result.steps;
}

template <int Dim>
void Frames<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    if (wants_look(run.steps)) write(run, solid);
}

template <int Dim>
bool Frames<Dim>::wants_look(std::int64_t step) const {
    const std::int64_t frame = series_->n_frames();
    const std::int64_t intervals = std::max<std::int64_t>(1, n_frames_ - 1);
    return frame < n_frames_ && step * intervals >= frame * n_steps_;
}

template <int Dim>
void Frames<Dim>::save(StateWriter& state) {
    state.put_all(std::span(series_->times()));
}

template <int Dim>
void Frames<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    begin(scene, result);
    const auto times = state.get_all<double>();
    series_->go_on_after(times);
    if (pairs_) pairs_->go_on_after(times);
}

template <int Dim>
void Frames<Dim>::write(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    const auto contact = solid.contact_field(run.q);
    const auto gap = finite_or_nan(contact.gap);
    static_cast<void>(solid.potential(run.q));  // leaves the stresses of this state behind
    const Stresses<Dim> stresses(solid);
    const auto velocity = cell_velocity(run, solid);
    const auto displacement = solid.cell_displacement(run.q);
    std::vector<Vector<Dim>> of_vertices;  // a body that turns is not where the mean displacement of its cells takes it
    if (solid.moment_arms() == dynamics::MomentArms::mid_step) of_vertices = solid.vertex_displacement(run.q);
    mesh::Frame<Dim> frame{.time = run.time, .displacement = displacement, .vertex_displacement = of_vertices};
    if (fields_.velocity) frame.cell_fields.push_back({"velocity [m/s]", velocity});
    if (fields_.stress) frame.cell_fields.push_back({"stress [Pa]", stresses.stress});
    if (fields_.von_mises) frame.cell_fields.push_back({"von Mises [Pa]", stresses.equivalent});
    if (Dim == 2 && fields_.stress) frame.cell_fields.push_back({"stress zz [Pa]", stresses.out_of_plane});
    if (fields_.pressure) frame.boundary_fields.push_back({"contact pressure [Pa]", contact.pressure});
    if (fields_.gap) frame.boundary_fields.push_back({"gap [m]", gap});
    if (pairs_) pairs_->write(PairPoints<Dim>(solid.acting_pairs(run.q), solid, displacement, of_vertices).frame(run.time));
    series_->write(frame);
}

#define ABUT_INSTANTIATE(Dim)   \
    template class Frames<Dim>; \
    template double von_mises<Dim>(const Matrix<Dim>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
