#include "abut/run/frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "abut/run/cell_velocity.hpp"

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
    n_steps_ = result.steps;
}

template <int Dim>
void Frames<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    const std::int64_t frame = series_->n_frames();
    if (frame >= n_frames_) return;
    const std::int64_t intervals = std::max<std::int64_t>(1, n_frames_ - 1);
    if (run.steps * intervals >= frame * n_steps_) write(run, solid);
}

template <int Dim>
void Frames<Dim>::save(StateWriter& state) {
    state.put_all(std::span(series_->times()));
}

template <int Dim>
void Frames<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    begin(scene, result);
    series_->go_on_after(state.get_all<double>());
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
    series_->write(frame);
}

#define ABUT_INSTANTIATE(Dim)   \
    template class Frames<Dim>; \
    template double von_mises<Dim>(const Matrix<Dim>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
