#include "abut/solid/ccg/ccg.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/arrays.hpp"
#include "abut/solid/ccg/capped_jumps.hpp"
#include "abut/solid/ccg/device_sweeps.hpp"
#include "abut/solid/ccg/finite_cells.hpp"
#include "abut/solid/ccg/motion_bound.hpp"
#include "abut/solid/ccg/plastic_cells.hpp"
#include "abut/solid/ccg/region.hpp"
#include "abut/solid/ccg/single_sweeps.hpp"
#include "abut/solid/ccg/sweeps.hpp"
#include "abut/solid/ccg/thermal_cells.hpp"
#include "abut/solid/ccg/viscous_cells.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {
namespace {

template <int Dim>
std::span<const Material> checked(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    const auto n_bodies = static_cast<std::size_t>(mesh.n_bodies());
    if (materials.size() != n_bodies)
        throw BadInput(mesh.name + ": " + std::to_string(materials.size()) + " materials are given for " +
                           std::to_string(n_bodies) + " bodies. Give one per body.",
                       {.value = static_cast<double>(materials.size()), .allowed = static_cast<double>(n_bodies)});
    for (std::size_t body = 0; body < n_bodies; ++body) check(materials[body], static_cast<int>(body));
    return materials;
}

template <int Dim>
void refuse_finite(const mesh::Mesh<Dim>& mesh, std::span<const Kinematics> kinematics, const std::string& steps,
                   const std::string& remedy) {
    for (std::size_t body = 0; body < kinematics.size(); ++body)
        if (properties_of(kinematics[body]).finite_strains)
            throw BadInput(mesh.name + ": body '" + mesh.body_names[body] +
                           "' is of Kinematics::finite, whose steps are not made " + steps + ". Take " + remedy +
                           ", or other kinematics.");
}

template <int Dim>
void refuse_materials(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    for (std::size_t body = 0; body < materials.size(); ++body)
        if (materials[body].remembers() || !materials[body].is_isotropic())
            throw BadInput(mesh.name + ": body '" + mesh.body_names[body] +
                           "' is of a material that flows, is damped or orthotropic, whose steps are made in double "
                           "precision on the host "
                           "alone. Take Precision::double_precision (--precision double) and StepDevice::host (--device "
                           "host), or another material.");
}

/// Null where steps are made in double precision on the host.
template <int Dim>
std::unique_ptr<StepSweeps<Dim>> step_sweeps(const mesh::Mesh<Dim>& mesh, std::span<const Kinematics> kinematics,
                                             std::span<const Material> materials, const CcgArrays<Dim>& arrays,
                                             const FiniteCells<Dim>& finite, const CcgSweeps<Dim>& sweeps,
                                             Precision precision, StepDevice device) {
    const bool is_single = precision == Precision::single_precision;
    if (is_single || device != StepDevice::host) refuse_materials(mesh, materials);
    if (is_single)
        refuse_finite(mesh, kinematics, "in single precision", "Precision::double_precision (--precision double)");
    if (device == StepDevice::host) return is_single ? std::make_unique<SingleSweeps<Dim>>(arrays, finite) : nullptr;
    refuse_finite(mesh, kinematics, "on a device", "StepDevice::host (--device host)");
    if (is_single)
        throw BadInput(mesh.name +
                       ": steps on a device are made in double precision alone. Take Precision::double_precision "
                       "(--precision double), or StepDevice::host (--device host).");
    return std::make_unique<DeviceSweeps<Dim>>(arrays, finite, sweeps);
}

}  // namespace

template <int Dim>
struct Ccg<Dim>::Impl {
    BoundaryConditions<Dim> conditions;
    FaceConditions<Dim> face_conditions;
    CcgArrays<Dim> arrays;
    FiniteCells<Dim> finite;
    ViscousCells<Dim> viscous;
    PlasticCells<Dim> plastic;
    CappedJumps<Dim> capped;
    ThermalCells<Dim> thermal;
    CcgSweeps<Dim> sweeps;
    std::unique_ptr<StepSweeps<Dim>> steps;  // null: `sweeps` make them
    bool steps_were_last = false;            // to compute gradients
    bool steps_have_state = false;           // were the last to be given a state
    std::optional<MotionBound<Dim>> motion_bound;
    IdVector<BoundaryFace, Vector<Dim>> boundary_centroid;
    IdVector<BoundaryFace, double> boundary_measure;
    std::vector<std::vector<Vector<Dim>>> outside;  // tractions by face, of each traction condition; empty: not from outside
    bool varies = false;

    Impl(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
         const BoundaryConditions<Dim>& boundary_conditions, std::span<const Kinematics> kinematics, CellForm form,
         Precision precision, StepDevice device, const FiniteOptions<Dim>& finite_options, FreeFaces free_faces);

    /// Free faces bear the thermal stress of their cell as if it were a traction.
    [[nodiscard]] Vector<Dim> moved_by_heat(BoundaryFace b, std::span<const double> temperature) const {
        const std::int32_t cell = arrays.cell_of(b);
        const Matrix<Dim> stress = temperature[static_cast<std::size_t>(cell)] * thermal.stress(cell);
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (std::int32_t i = arrays.boundary.load_offsets[number_of(b)]; i < arrays.boundary.load_offsets[number_of(b) + 1];
             ++i)
            sum += arrays.boundary.from_traction[i] * (stress * arrays.normal_of(arrays.boundary.load_faces[i]));
        return sum;
    }

    /// evaluate(sweeps) of those that make steps.
    template <class Evaluate>
    void take_step(const Evaluate& evaluate) {
        if (!steps) return evaluate(sweeps);
        evaluate(*steps);
        steps_were_last = steps_have_state = true;
    }
};

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
      sweeps(arrays, arrays, finite, &viscous, &plastic, &capped, &thermal),
      steps(step_sweeps(mesh, kinematics, materials, arrays, finite, sweeps, precision, device)) {
    const auto all = solid::boundary_faces(mesh);
    motion_bound.emplace(arrays, std::vector<BoundaryFace>(all.begin(), all.end()));
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
bool Ccg<Dim>::load_varies() const {
    return impl_->varies;
}

template <int Dim>
void Ccg<Dim>::set_temperature(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                               std::span<const TemperatureRise<Dim>> temperature) {
    if (impl_->steps)
        throw BadInput(mesh.name +
                       ": a temperature is given, with which steps are made in double precision on the host alone. Take "
                       "Precision::double_precision (--precision double) and StepDevice::host (--device host).");
    impl_->thermal = ThermalCells<Dim>(mesh, materials, temperature);
    impl_->varies = impl_->varies || impl_->thermal.varies();
}

template <int Dim>
bool Ccg<Dim>::is_warm() const {
    return impl_->thermal.any();
}

template <int Dim>
void Ccg<Dim>::set_traction(const std::string& group, std::span<const Vector<Dim>> traction) {
    for (std::size_t i = 0; i < impl_->outside.size(); ++i)
        if (impl_->conditions.traction[i].group == group && impl_->conditions.traction[i].from_outside)
            impl_->outside[i].assign(traction.begin(), traction.end());
}

template <int Dim>
Vector<Dim> Ccg<Dim>::face_displacement(BoundaryFace face, std::span<const Vector<Dim>> u,
                                        const BoundaryLoad<Dim>& load) const {
    const BoundaryReconstruction<Dim>& boundary = impl_->arrays.boundary;
    const Vector<Dim>& origin = u[impl_->arrays.cell_of(face)];  // as the sweeps do
    const std::int32_t b = number_of(face);
    Vector<Dim> sum = origin;
    for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i)
        sum += boundary.weights[i] * (u[boundary.cells[i]] - origin);
    return load.displacement.empty() ? sum : Vector<Dim>(sum + load.displacement[b] - boundary.deficit[b] * origin);
}

template <int Dim>
BoundaryLoad<Dim> Ccg<Dim>::load_at(double displacement_time, double traction_time) const {
    const Impl& m = *impl_;
    BoundaryLoad<Dim> load;
    if (m.conditions.dirichlet.empty() && m.conditions.traction.empty() && !m.thermal.any()) return load;
    if (m.thermal.any()) load.temperature = m.thermal.rise_at(traction_time);
    const BoundaryReconstruction<Dim>& boundary = m.arrays.boundary;
    const auto n = static_cast<std::size_t>(boundary.size());
    IdVector<BoundaryFace, Vector<Dim>> prescribed(n, Vector<Dim>::Zero());
    IdVector<BoundaryFace, Vector<Dim>> traction(n, Vector<Dim>::Zero());
    const auto value_at = [&](const auto& condition, double time, BoundaryFace b) {
        const Vector<Dim> value = condition.history ? condition.history(time, m.boundary_centroid[b]) : condition.value;
        if (!value.allFinite())
            throw BadInput("boundary condition on '" + condition.group + "': its value at t = " + number(time) +
                               " s is not finite. Correct its value or history.",
                           {.face_1 = m.arrays.face_of(b)});
        return value;
    };
    for (std::size_t i = 0; i < m.conditions.dirichlet.size(); ++i)
        for (const auto& [b, projector] : m.face_conditions.dirichlet[i])
            prescribed[b] += projector * value_at(m.conditions.dirichlet[i], displacement_time, b);
    for (std::size_t i = 0; i < m.conditions.traction.size(); ++i) {
        const std::vector<BoundaryFace>& faces = m.face_conditions.traction[i];
        for (std::size_t k = 0; k < faces.size(); ++k)
            traction[faces[k]] +=
                m.outside[i].empty() ? value_at(m.conditions.traction[i], traction_time, faces[k]) : m.outside[i][k];
    }

    load.displacement.assign(n, Vector<Dim>::Zero());
    load.traction.assign(n, Vector<Dim>::Zero());
    for (std::size_t b = 0; b < n; ++b) {
        load.traction[b] = m.boundary_measure[BoundaryFace(b)] * traction[BoundaryFace(b)];
        for (std::int32_t i = boundary.load_offsets[b]; i < boundary.load_offsets[b + 1]; ++i)
            load.displacement[b] += boundary.from_displacement[i] * prescribed[boundary.load_faces[i]] +
                                    boundary.from_traction[i] * traction[boundary.load_faces[i]];
        if (m.thermal.any()) load.displacement[b] += m.moved_by_heat(static_cast<BoundaryFace>(b), load.temperature);
    }
    return load;
}

template <int Dim>
BoundaryLoad<Dim> Ccg<Dim>::load_free() const {
    if (impl_->conditions.dirichlet.empty() && impl_->conditions.traction.empty()) return {};
    const std::vector<Vector<Dim>> zero(static_cast<std::size_t>(impl_->arrays.n_boundary()), Vector<Dim>::Zero());
    return {zero, zero, {}};
}

template <int Dim>
IdSpan<BoundaryFace, const Matrix<Dim>> Ccg<Dim>::prescribed() const {
    return IdSpan<BoundaryFace, const Matrix<Dim>>(std::as_const(impl_->face_conditions.prescribed).values());
}

template <int Dim>
std::vector<BoundaryFace> Ccg<Dim>::prescribed_faces_of(std::int32_t cell) const {
    std::vector<BoundaryFace> faces;
    for (const HalfFace& half_face : impl_->arrays.half_faces_of(cell)) {
        const BoundaryFace b = impl_->arrays.boundary_index[half_face.face];
        if (b != no_face && !impl_->face_conditions.prescribed[b].isZero(0.0)) faces.push_back(b);
    }
    return faces;
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
    impl_->sweeps.gradient(u, load, corrections, result);
    impl_->steps_were_last = impl_->steps_have_state = false;
}

template <int Dim>
void Ccg<Dim>::step_gradient(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                             const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    impl_->take_step([&](auto& sweeps) { sweeps.gradient(u, load, corrections, result); });
}

template <int Dim>
void Ccg<Dim>::mean_gradient(const StepEnds<Dim>& ends, const BoundaryLoad<Dim>& load,
                             const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result) {
    impl_->take_step([&](auto& sweeps) { sweeps.mean_gradient(ends, load, corrections, result); });
}

template <int Dim>
void Ccg<Dim>::gradient_of_packed(LargeArray<double>& u, const BoundaryLoad<Dim>& load,
                                  const FaceCorrections<Dim>& corrections, std::span<Vector<Dim>> result,
                                  const StepEnds<Dim>& ends) {
    if (impl_->steps)
        return impl_->take_step([&](auto& sweeps) { sweeps.gradient_of_packed(u, load, corrections, result); });
    impl_->sweeps.gradient_of_packed(u, load, corrections, result, ends);
}

template <int Dim>
StepDefect<Dim> Ccg<Dim>::step_defect(std::int32_t cell, const Vector<Dim>& arm) const {
    return impl_->sweeps.step_defect(cell, arm);
}

template <int Dim>
bool Ccg<Dim>::any_inelastic() const {
    return impl_->finite.any_inelastic() || impl_->plastic.any();
}

template <int Dim>
bool Ccg<Dim>::flows_linearly() const {
    return impl_->plastic.any();
}

template <int Dim>
bool Ccg<Dim>::may_have_flowed() const {
    return impl_->finite.any_inelastic() || impl_->plastic.any_flowed() || impl_->capped.any_yielded();
}

template <int Dim>
bool Ccg<Dim>::any_face_moves() const {
    return impl_->plastic.any_face_moves();
}

template <int Dim>
void Ccg<Dim>::begin_step(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, double dt) {
    if (impl_->finite.any_inelastic()) impl_->sweeps.begin_step(u, load, dt);
}

template <int Dim>
void Ccg<Dim>::end_step() {
    impl_->sweeps.end_step();
    impl_->viscous.end_step();
    impl_->plastic.end_step();
    impl_->capped.end_step();
}

template <int Dim>
void Ccg<Dim>::bring_to_rest() {
    impl_->viscous.bring_to_rest();
}

template <int Dim>
bool Ccg<Dim>::any_damped() const {
    return impl_->viscous.any();
}

template <int Dim>
double Ccg<Dim>::damping_ratio(double omega) const {
    return impl_->viscous.damping_ratio(omega);
}

template <int Dim>
Vector<Dim> Ccg<Dim>::drag(std::int32_t cell, double mass, const Vector<Dim>& motion, double dt) {
    if (!impl_->viscous.contains(cell)) return Vector<Dim>::Zero();
    return impl_->viscous.drag(cell, mass, motion, dt);
}

template <int Dim>
dynamics::Losses Ccg<Dim>::step_loss(std::int32_t cell) const {
    dynamics::Losses loss;
    if (impl_->viscous.any()) loss = impl_->viscous.loss(cell);
    loss.in_cells = impl_->plastic.loss(cell);
    loss.on_faces = -impl_->plastic.work_of_push(cell);
    if (impl_->finite.any_inelastic()) loss += impl_->sweeps.step_loss(cell);
    loss.in_jumps = impl_->capped.loss(cell);
    return loss;
}

template <int Dim>
double Ccg<Dim>::plastic_strain(std::int32_t cell) const {
    const std::int32_t inelastic = impl_->finite.inelastic(cell);
    if (inelastic < 0) return impl_->plastic.plastic_strain(cell);
    return impl_->finite.inelastic_cell(inelastic).law->plastic_strain(impl_->sweeps.memory_of(inelastic));
}

template <int Dim>
std::optional<double> Ccg<Dim>::out_of_plane_stress(std::int32_t cell) const {
    if (impl_->plastic.contains(cell))
        return impl_->plastic.out_of_plane_stress(cell, displacement_gradient(cell)) - impl_->sweeps.heat_out_of_plane(cell);
    if (impl_->arrays.directed.contains(cell))
        return impl_->sweeps.directed_out_of_plane_stress(cell) - impl_->sweeps.heat_out_of_plane(cell);
    if (const std::int32_t inelastic = impl_->finite.inelastic(cell); inelastic >= 0)
        return impl_->finite.inelastic_cell(inelastic).law->out_of_plane_stress(impl_->sweeps.law_gradient(cell),
                                                                                impl_->sweeps.memory_of(inelastic));
    if (!impl_->thermal.any() || impl_->finite.contains(cell)) return std::nullopt;
    return impl_->arrays.cells[cell].lambda * displacement_gradient(cell).trace() - impl_->sweeps.heat_out_of_plane(cell);
}

template <int Dim>
std::vector<std::int32_t> Ccg<Dim>::memory_sizes() const {
    std::vector<std::int32_t> sizes;
    for (std::int32_t c = 0; c < n_cells(); ++c)
        sizes.push_back(impl_->viscous.memory_size(c) + impl_->plastic.memory_size(c) + impl_->capped.memory_size(c));
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(impl_->finite.n_inelastic()); ++i) {
        const auto& cell = impl_->finite.inelastic_cell(i);
        sizes[static_cast<std::size_t>(cell.cell)] += static_cast<std::int32_t>(cell.end - cell.begin);
    }
    return sizes;
}

template <int Dim>
std::vector<double> Ccg<Dim>::memory() const {
    std::vector<double> values;
    for (std::int32_t c = 0; c < n_cells(); ++c) {
        if (const std::int32_t inelastic = impl_->finite.inelastic(c); inelastic >= 0) {
            const auto& cell = impl_->finite.inelastic_cell(inelastic);
            const std::span<const double> all = impl_->sweeps.memory();
            values.insert(values.end(), all.begin() + cell.begin, all.begin() + cell.end);
        }
        impl_->viscous.put_memory(c, values);
        impl_->plastic.put_memory(c, values);
        impl_->capped.put_memory(c, values);
    }
    return values;
}

template <int Dim>
void Ccg<Dim>::set_memory(std::span<const double> values) {
    std::vector<double> of_laws;
    for (std::int32_t c = 0; c < n_cells(); ++c) {
        const auto take = [&](std::ptrdiff_t size) {
            const std::span<const double> taken = values.first(static_cast<std::size_t>(size));
            values = values.subspan(taken.size());
            return taken;
        };
        if (const std::int32_t inelastic = impl_->finite.inelastic(c); inelastic >= 0) {
            const auto& cell = impl_->finite.inelastic_cell(inelastic);
            const std::span<const double> of_law = take(cell.end - cell.begin);
            of_laws.insert(of_laws.end(), of_law.begin(), of_law.end());
        }
        if (impl_->viscous.contains(c)) impl_->viscous.set_memory(c, take(impl_->viscous.memory_size(c)));
        if (impl_->plastic.contains(c)) impl_->plastic.set_memory(c, take(impl_->plastic.memory_size(c)));
        if (impl_->capped.contains(c)) impl_->capped.set_memory(c, take(impl_->capped.memory_size(c)));
    }
    if (impl_->finite.any_inelastic()) impl_->sweeps.set_memory(of_laws);
}

template <int Dim>
void Ccg<Dim>::take_memory(const Ccg& before, std::span<const std::int32_t> old_cells,
                           std::span<const std::int32_t> old_faces) {
    const Impl& from = *before.impl_;
    std::vector<double> of_laws(impl_->sweeps.memory().begin(), impl_->sweeps.memory().end()), values;
    for (std::int32_t c = 0; c < n_cells(); ++c) {
        const std::int32_t old = old_cells[static_cast<std::size_t>(c)];
        const std::int32_t inelastic = impl_->finite.inelastic(c), old_inelastic = from.finite.inelastic(old);
        if (impl_->viscous.contains(c) != from.viscous.contains(old) ||
            impl_->plastic.contains(c) != from.plastic.contains(old) ||
            impl_->capped.contains(c) != from.capped.contains(old) || (inelastic < 0) != (old_inelastic < 0))
            throw BadInput("cell " + std::to_string(c) +
                               ", counted from 0 among those of bodies that deform, is of a "
                               "material that remembers other things than before. Keep the laws of materials.",
                           {.cell = c});
        if (inelastic >= 0) {
            const auto &cell = impl_->finite.inelastic_cell(inelastic),
                       &old_cell = from.finite.inelastic_cell(old_inelastic);
            const std::ptrdiff_t size = std::min(cell.end - cell.begin, old_cell.end - old_cell.begin);
            std::copy_n(from.sweeps.memory().begin() + old_cell.begin, size, of_laws.begin() + cell.begin);
        }
        const auto take = [&](const auto& old_cells_of, auto& cells) {
            if (!cells.contains(c)) return;
            values.clear();
            old_cells_of.put_memory(old, values);
            cells.set_memory(c, values);
        };
        take(from.viscous, impl_->viscous);
        take(from.plastic, impl_->plastic);
        if (!impl_->capped.contains(c)) continue;
        values.clear();
        for (const HalfFace& half_face : impl_->arrays.half_faces_of(c)) {
            const Vector<Dim> lasting = from.capped.lasting_on(old, old_faces[static_cast<std::size_t>(half_face.face)]);
            values.insert(values.end(), lasting.begin(), lasting.end());
        }
        impl_->capped.set_memory(c, values);
    }
    if (impl_->finite.any_inelastic()) impl_->sweeps.set_memory(of_laws);
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
    impl_->sweeps.cell_energies(u, load, corrections, energy);
    impl_->steps_have_state = false;
    return energy;
}

template <int Dim>
double Ccg<Dim>::traction_work(BoundaryFace face, const BoundaryLoad<Dim>& load) const {
    return load.traction[static_cast<std::size_t>(face)].dot(impl_->sweeps.face_displacement(face));
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
double Ccg<Dim>::corner_amplification(BoundaryFace face, const Vector<Dim>& arm) const {
    return impl_->motion_bound->corner_amplification(face, arm);
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
FiniteExtremes Ccg<Dim>::finite_extremes(std::span<const std::int32_t> cells) const {
    return impl_->sweeps.finite_extremes(cells);
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
