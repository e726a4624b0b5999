#include "abut/solid/ccg/ccg.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/rotation.hpp"
#include "abut/solid/ccg/ccg_impl.hpp"
#include "abut/solid/ccg/device_sweeps.hpp"
#include "abut/solid/ccg/single_sweeps.hpp"
#include "abut/solid/combinations/combinations.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/operator/region.hpp"

namespace abut::solid {
namespace {

template <int Dim>
std::span<const Material> checked(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    const auto n_bodies = static_cast<std::size_t>(mesh.n_bodies());
    if (materials.size() != n_bodies)
        throw BadInput(mesh.name + ": " + counted(std::ssize(materials), "material is", "materials are") + " given for " +
                           counted(std::int64_t(n_bodies), "body") + ". Give one per body.",
                       {.value = static_cast<double>(materials.size()), .allowed = static_cast<double>(n_bodies)});
    for (std::size_t body = 0; body < n_bodies; ++body) check(materials[body], static_cast<int>(body));
    return materials;
}

/// Bodies of which the chosen way of making steps does not know something are named.
template <int Dim>
void check_steps(const mesh::Mesh<Dim>& mesh, std::span<const Kinematics> kinematics, std::span<const Material> materials,
                 FeatureSet steps) {
    for (std::size_t body = 0; body < materials.size(); ++body)
        require_together(mesh.name, "body '" + mesh.body_names[body] + "'",
                         features_of(kinematics_of(kinematics, body), materials[body]) | steps);
}

/// Null where steps are made in double precision on the host.
template <int Dim>
std::unique_ptr<StepSweeps<Dim>> step_sweeps(const mesh::Mesh<Dim>& mesh, std::span<const Kinematics> kinematics,
                                             std::span<const Material> materials, const CcgArrays<Dim>& arrays,
                                             const FiniteCells<Dim>& finite, const CcgSweeps<Dim>& sweeps,
                                             Precision precision, StepDevice device) {
    const bool is_single = precision == Precision::single_precision;
    FeatureSet steps;
    steps.add(Feature::single_precision, is_single);
    steps.add(Feature::device, device != StepDevice::host);
    if (!steps.is_empty()) check_steps(mesh, kinematics, materials, steps);
    if (device == StepDevice::host) return is_single ? std::make_unique<SingleSweeps<Dim>>(arrays, finite) : nullptr;
    return std::make_unique<DeviceSweeps<Dim>>(arrays, finite, sweeps);
}

}  // namespace

template <int Dim>
Ccg<Dim>::Impl::Impl(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                     const BoundaryConditions<Dim>& boundary_conditions, std::span<const Kinematics> kinematics,
                     CellForm form, Precision precision, StepDevice device, const FiniteOptions<Dim>& finite_options,
                     FreeFaces free_faces)
    : conditions(boundary_conditions),
      face_conditions(sort_to_faces(mesh, boundary_conditions)),
      arrays(mesh, checked(mesh, materials), face_conditions, conditions.free_face_rule, conditions.corner_rule, kinematics,
             form),
      finite(mesh, face_conditions, kinematics, finite_options),
      viscous(mesh, materials),
      plastic(mesh, materials, kinematics, face_conditions, conditions.free_face_rule, free_faces, arrays),
      capped(mesh, materials, kinematics, face_conditions, free_faces, arrays),
      sweeps(arrays, finite, viscous, plastic, capped, thermal),
      steps(step_sweeps(mesh, kinematics, materials, arrays, finite, sweeps, precision, device)),
      are_moved(free_faces == FreeFaces::are_moved) {
    const auto all = solid::boundary_faces(mesh);
    motion_bound.emplace(arrays, std::vector<BoundaryFace>(all.begin(), all.end()));
    if (free_faces == FreeFaces::are_pushed && finite.any()) give_way_at_corners(mesh, materials);
    for (const std::int32_t f : arrays.boundary_faces) {
        boundary_centroid.push_back(mesh.face_centroid[f]);
        boundary_measure.push_back(mesh.face_measure[f]);
    }
    for (const auto& condition : conditions.dirichlet) varies = varies || condition.history;
    for (std::size_t i = 0; i < conditions.traction.size(); ++i) {
        const TractionCondition<Dim>& condition = conditions.traction[i];
        varies = varies || condition.history || condition.from_outside;
        outside.emplace_back(condition.from_outside ? face_conditions.traction[i].size() : 0, condition.value);
    }
}

/// Free faces of finite bodies give way with the others of their cell that turn away from them, as those of other bodies do
/// by their rows.
template <int Dim>
void Ccg<Dim>::Impl::give_way_at_corners(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    for (std::int32_t c = 0; c < arrays.n_cells(); ++c) {
        if (!finite.shows_condensed(c)) continue;
        const std::vector<BoundaryFace> free = free_faces_of(c);
        for (const BoundaryFace b : free) {
            const Vector<Dim>& normal = arrays.normal_of(b);
            std::vector<Vector<Dim>> normals{normal};
            for (const BoundaryFace other : free)
                if (other != b && meet_at_corner<Dim>(normal, arrays.normal_of(other)))
                    normals.push_back(arrays.normal_of(other));
            if (normals.size() == 1) continue;
            const double alone = answers_of(c, {normal}).modulus(0), left = answers_of(c, std::move(normals)).modulus(0);
            if (left >= least_stiffness * materials[mesh.cell_body[c]].mean_young())
                arrays.boundary.normal_stiffness[number_of(b)] *= left / alone;
        }
    }
}

template <int Dim>
FreeFaceAnswers<Dim> Ccg<Dim>::Impl::answers_of(std::int32_t cell, std::vector<Vector<Dim>> normals) const {
    const auto& [inverse_measure, lambda, mu] = arrays.cells[cell];
    return {std::move(normals), lambda, mu, directed_of(cell)};
}

/// They belong to a cell of a finite body; none to others.
template <int Dim>
std::vector<BoundaryFace> Ccg<Dim>::Impl::free_faces_of(std::int32_t cell) const {
    std::vector<BoundaryFace> faces;
    if (!finite.free_cell(cell)) return faces;
    for (const HalfFace& half_face : arrays.half_faces_of(cell)) {
        const BoundaryFace b = arrays.boundary_index[half_face.face];
        if (b != no_face && finite.is_free(b)) faces.push_back(b);
    }
    return faces;
}

/// Stress by what pushes on free faces of a cell; nothing where there is none.
template <int Dim>
auto Ccg<Dim>::Impl::stress_of_pushes(std::int32_t cell, const Matrix<Dim>& displacement_gradient) const
    -> std::optional<StressOfPushes<Dim>> {
    if (pushed.empty()) return std::nullopt;
    return finite.contains(cell) ? stress_of_pushes_on_finite(cell, displacement_gradient)
                                 : stress_of_pushes_on_linear(cell);
}

/// By L of the free faces: the least energy of a cell and of what pushes its faces is where these give way to it.
template <int Dim>
auto Ccg<Dim>::Impl::stress_of_pushes_on_linear(std::int32_t cell) const -> std::optional<StressOfPushes<Dim>> {
    const BoundaryReconstruction<Dim>& boundary = arrays.boundary;
    Matrix<Dim> g = Matrix<Dim>::Zero();
    for (const HalfFace& half_face : arrays.half_faces_of(cell)) {
        const BoundaryFace b = arrays.boundary_index[half_face.face];
        if (b == no_face) continue;
        Vector<Dim> moved = Vector<Dim>::Zero();
        for (std::int32_t i = boundary.load_offsets[number_of(b)]; i < boundary.load_offsets[number_of(b) + 1]; ++i)
            moved += boundary.from_traction[i] * push_on(boundary.load_faces[i]);
        g += arrays.cells[cell].inverse_measure * boundary_measure[b] * moved * arrays.normal_of(b).transpose();
    }
    if (g.isZero(0.0)) return std::nullopt;
    const auto& [inverse_measure, lambda, mu] = arrays.cells[cell];
    return stress_of_gradient<Dim>(g, lambda, mu, directed_of(cell));
}

/// Faces, their normals and tractions are those of the deformed cell.
template <int Dim>
auto Ccg<Dim>::Impl::stress_of_pushes_on_finite(std::int32_t cell, const Matrix<Dim>& displacement_gradient) const
    -> std::optional<StressOfPushes<Dim>> {
    const std::vector<BoundaryFace> faces = free_faces_of(cell);
    if (std::ranges::none_of(faces, [&](BoundaryFace b) { return !push_on(b).isZero(0.0); })) return std::nullopt;
    const Matrix<Dim> f = Matrix<Dim>::Identity() + displacement_gradient, turn = nearest_rotation(f);
    const Matrix<Dim> to_area = f.determinant() * f.transpose().inverse();  // of areas at rest
    std::vector<Vector<Dim>> normals, tractions;
    for (const BoundaryFace b : faces) {
        const Vector<Dim> area = to_area * arrays.normal_of(b);
        normals.push_back(turn.transpose() * area.normalized());
        tractions.push_back(turn.transpose() * push_on(b) / area.norm());
    }
    StressOfPushes<Dim> answer = answers_of(cell, std::move(normals)).stress(tractions);
    answer.in_space = turn * answer.in_space * turn.transpose();
    return answer;
}

template <int Dim>
Ccg<Dim>::Ccg(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const BoundaryConditions<Dim>& conditions,
              std::span<const Kinematics> kinematics, CellForm form, Precision precision, StepDevice device,
              const FiniteOptions<Dim>& finite, FreeFaces free_faces)
    : impl_(std::make_unique<Impl>(mesh, materials, conditions, kinematics, form, precision, device, finite, free_faces)) {}

template <int Dim>
Ccg<Dim>::~Ccg() = default;
template <int Dim>
Ccg<Dim>::Ccg(Ccg&&) noexcept = default;
template <int Dim>
Ccg<Dim>& Ccg<Dim>::operator=(Ccg&&) noexcept = default;

template <int Dim>
std::int32_t Ccg<Dim>::n_cells() const {
    return impl_->arrays.n_cells();
}

template <int Dim>
std::int32_t Ccg<Dim>::n_boundary() const {
    return impl_->arrays.n_boundary();
}

template <int Dim>
const Vector<Dim>& Ccg<Dim>::centroid(BoundaryFace face) const {
    return impl_->boundary_centroid[face];
}

template <int Dim>
void Ccg<Dim>::boundary_displacement(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                     std::span<Vector<Dim>> displacement) {
    impl_->sweeps.boundary_displacement(u, load, displacement);
}

template <int Dim>
void Ccg<Dim>::gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                        const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    impl_->keep_pushes(corrections);
    impl_->sweeps.gradient(u, load, corrections, result);
    impl_->steps_were_last = impl_->steps_have_state = false;
}

template <int Dim>
void Ccg<Dim>::gradient_and_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                     const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                     std::span<double> energies) {
    impl_->keep_pushes(corrections);
    impl_->sweeps.gradient_and_energies(u, load, corrections, result, energies);
    impl_->steps_were_last = impl_->steps_have_state = false;
}

template <int Dim>
void Ccg<Dim>::step_gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                             const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    impl_->keep_pushes(corrections);
    impl_->take_step([&](auto& sweeps) { sweeps.gradient(u, load, corrections, result); });
}

template <int Dim>
void Ccg<Dim>::mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load,
                             const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    impl_->keep_pushes(corrections);
    impl_->take_step([&](auto& sweeps) { sweeps.mean_gradient(ends, load, corrections, result); });
}

template <int Dim>
void Ccg<Dim>::gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load,
                                  const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                  const StepEnds<Dim>& ends) {
    impl_->keep_pushes(corrections);
    if (impl_->steps)
        return impl_->take_step([&](auto& sweeps) { sweeps.gradient_of_packed(u, load, corrections, result); });
    impl_->sweeps.gradient_of_packed(u, load, corrections, result, ends);
}

template <int Dim>
StepDefect<Dim> Ccg<Dim>::step_defect(std::int32_t cell, const Vector<Dim>& arm) const {
    return impl_->sweeps.step_defect(cell, arm);
}

template <int Dim>
Vector<Dim> Ccg<Dim>::boundary_gradient(BoundaryFace face) const {
    return impl_->steps_were_last ? impl_->steps->face_gradient(face) : impl_->sweeps.face_gradient(face);
}

template <int Dim>
double Ccg<Dim>::potential(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                           const FaceCorrections<Dim>& corrections) {
    const std::vector<double> energy = cell_energies(u, load, corrections);
    const double stored = ordered_sum(std::ssize(energy), 0.0, [&](std::ptrdiff_t c) { return energy[c]; });
    double work = 0.0;
    for (std::size_t b = 0; b < load.traction.size(); ++b) work += traction_work(static_cast<BoundaryFace>(b), load);
    return stored - work;
}

template <int Dim>
std::vector<double> Ccg<Dim>::cell_energies(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                            const FaceCorrections<Dim>& corrections) {
    std::vector<double> energy(static_cast<std::size_t>(n_cells()));
    impl_->keep_pushes(corrections);
    impl_->sweeps.cell_energies(u, load, corrections, energy);
    impl_->steps_have_state = false;
    return energy;
}

template <int Dim>
Region<Dim> Ccg<Dim>::region_of_faces(std::span<const BoundaryFace> faces) const {
    return solid::region_of_faces(impl_->arrays, faces);
}

template <int Dim>
Region<Dim> Ccg<Dim>::region_of_cells(std::span<const std::int32_t> cells) const {
    Region<Dim> region = solid::region_of_cells(impl_->arrays, cells);
    impl_->sweeps.divide_into_chunks(region);
    return region;
}

template <int Dim>
void Ccg<Dim>::evaluate_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                              std::span<Vector<Dim>> displacement, std::span<Vector<Dim>> gradient) {
    impl_->sweeps.evaluate_faces(region, u, load, displacement, gradient);
}

template <int Dim>
Region<Dim> Ccg<Dim>::region_of_tilted_faces(std::span<const BoundaryFace> faces) const {
    return solid::region_of_tilted_faces(impl_->arrays, faces);
}

template <int Dim>
void Ccg<Dim>::evaluate_tilted_faces(const Region<Dim>& region, std::span<const Vector<Dim>> u,
                                     const BoundaryLoad<Dim>& load, std::span<Vector<Dim>> displacement,
                                     std::span<Matrix<Dim>> displacement_gradient, StepState state) {
    impl_->sweeps.evaluate_tilted_faces(region, u, load, displacement, displacement_gradient, state);
}

template <int Dim>
void Ccg<Dim>::evaluate_cells(const Region<Dim>& region, std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                              const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    impl_->keep_pushes(corrections);
    impl_->sweeps.evaluate_cells(region, u, load, corrections, result);
}

template <int Dim>
contact::FaceCoupling<Dim> Ccg<Dim>::coupling(std::span<const BoundaryFace> faces) const {
    return face_coupling(impl_->arrays, faces);
}

template <int Dim>
std::vector<std::int32_t> Ccg<Dim>::compute_only(std::span<const std::int32_t> cells) {
    Region<Dim> region = solid::region_of_cells(impl_->arrays, cells);
    impl_->sweeps.compute_only(region);
    if (impl_->steps) impl_->steps->compute_only(region);
    return std::move(region.input_cells);
}

template <int Dim>
void Ccg<Dim>::watch_only(std::span<const BoundaryFace> faces) {
    impl_->motion_bound.emplace(impl_->arrays, faces);
}

template <int Dim>
double Ccg<Dim>::motion_bound(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from,
                              std::span<const Vector<Dim>> u_to, const BoundaryLoad<Dim>& load_to) {
    return (*impl_->motion_bound)(u_from, load_from, u_to, load_to);
}

template <int Dim>
double Ccg<Dim>::motion_amplification() const {
    return impl_->motion_bound->amplification();
}

template <int Dim>
CornerWeights Ccg<Dim>::corner_weights(BoundaryFace face, const Vector<Dim>& arm) const {
    return impl_->motion_bound->corner_weights(face, arm, Matrix<Dim>::Identity() - prescribed()[face]);
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::displacement_gradient(std::int32_t cell) const {
    return impl_->steps_have_state ? impl_->steps->displacement_gradient(cell) : impl_->sweeps.displacement_gradient(cell);
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::stress(std::int32_t cell) const {
    return impl_->steps_have_state ? impl_->steps->stress(cell) : impl_->sweeps.stress(cell);
}

template <int Dim>
Matrix<Dim> Ccg<Dim>::stress_under_pushes(std::int32_t cell) const {
    const auto pushed = impl_->stress_of_pushes(cell, displacement_gradient(cell));
    return pushed ? Matrix<Dim>(stress(cell) + pushed->in_space) : stress(cell);
}

template <int Dim>
FiniteExtremes Ccg<Dim>::finite_extremes(std::span<const std::int32_t> cells) const {
    return impl_->sweeps.finite_extremes(cells);
}

template <int Dim>
void Ccg<Dim>::watch_strains() {
    impl_->sweeps.watch_strains();
}

template <int Dim>
std::vector<std::int32_t> Ccg<Dim>::strained_beyond(std::span<const double> limit_of_body) const {
    std::vector<std::int32_t> cells = impl_->sweeps.strained_beyond(limit_of_body);
    if (impl_->pushed.empty()) return cells;
    const std::vector<std::int32_t>& begin = impl_->arrays.body_begin;
    for (const BoundaryFace face : impl_->pushed) {
        const std::int32_t cell = impl_->arrays.cell_of(face);
        const auto body = static_cast<std::size_t>(std::ranges::upper_bound(begin, cell) - begin.begin()) - 1;
        if (std::isfinite(limit_of_body[body])) cells.push_back(cell);
    }
    std::ranges::sort(cells);
    cells.erase(std::ranges::unique(cells).begin(), cells.end());
    return cells;
}

template <int Dim>
const StencilReport& Ccg<Dim>::stencil_report() const {
    return impl_->arrays.report;
}

template <int Dim>
const BoundaryReconstruction<Dim>& Ccg<Dim>::boundary() const {
    return impl_->arrays.boundary;
}

template <int Dim>
std::span<const FaceStencil<Dim>> Ccg<Dim>::stencils() const {
    return impl_->arrays.stencils;
}

template <int Dim>
double Ccg<Dim>::normal_stiffness(BoundaryFace face) const {
    return impl_->arrays.boundary.normal_stiffness[static_cast<std::size_t>(face)];
}

template <int Dim>
std::span<const std::int32_t> Ccg<Dim>::cells_of(BoundaryFace face) const {
    const BoundaryReconstruction<Dim>& boundary = impl_->arrays.boundary;
    const std::int32_t begin = boundary.offsets[number_of(face)];
    return {boundary.cells.data() + begin, static_cast<std::size_t>(boundary.offsets[number_of(face) + 1] - begin)};
}

template class Ccg<2>;
template class Ccg<3>;

}  // namespace abut::solid
