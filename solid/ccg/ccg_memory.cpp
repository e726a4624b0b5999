// What cells remember and lose: flow, damping and viscosity.
#include <optional>
#include <string>

#include "abut/base/error.hpp"
#include "abut/solid/ccg/ccg_impl.hpp"

namespace abut::solid {
namespace {

/// Part of the jump of a face that flow makes by moving free faces, as the cell with the half-face sees it: traces do
/// not have it [m].
template <int Dim>
Vector<Dim> jump_of_tilts(const CcgArrays<Dim>& arrays, const PlasticCells<Dim>& plastic, std::int32_t cell,
                          std::int32_t half_face) {
    const HalfFace& half = arrays.half_faces[static_cast<std::size_t>(half_face)];
    const auto of_trace = [&](std::int32_t c, std::int32_t half_of_cell) -> Vector<Dim> {
        if (!plastic.contains(c) || !arrays.affine_faces_of(c).empty()) return Vector<Dim>::Zero();
        return plastic.tilted(c) * Vector<Dim>(arrays.lever_arms[static_cast<std::size_t>(half_of_cell)].data());
    };
    const auto [first, second] = arrays.face_cells[half.face];
    return of_trace(cell, half_face) - of_trace(cell == first ? second : first, half.twin);
}

/// Number of the half-face that a cell has of a face; -1: none.
template <int Dim>
std::int32_t half_face_of(const CcgArrays<Dim>& arrays, std::int32_t cell, std::int32_t face) {
    for (std::int32_t i = arrays.half_face_offsets[cell]; i < arrays.half_face_offsets[cell + 1]; ++i)
        if (arrays.half_faces[i].face == face) return i;
    return -1;
}

/// Throws BadInput unless a cell remembers the same things as the old one.
template <RememberingCells Cells>
void check_memory(const Cells& cells, std::int32_t cell, const Cells& before, std::int32_t old) {
    if (cells.remembers_as(cell, before, old)) return;
    throw BadInput("cell " + std::to_string(cell) +
                       ", counted from 0 among those of bodies that deform, is of a "
                       "material that remembers other things than before. Keep the laws of materials.",
                   {.cell = cell});
}

}  // namespace

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
    impl_->for_memories([](auto& cells) { cells.end_step(); });
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
    loss.on_faces = impl_->capped.loss_by_flow(cell) - impl_->plastic.work_of_push(cell);
    if (impl_->finite.any_inelastic()) loss += impl_->sweeps.finite().loss(cell);
    loss.in_jumps = impl_->capped.loss(cell);
    return loss;
}

template <int Dim>
double Ccg<Dim>::plastic_strain(std::int32_t cell) const {
    const std::int32_t inelastic = impl_->finite.inelastic(cell);
    if (inelastic < 0) return impl_->plastic.plastic_strain(cell);
    return impl_->finite.inelastic_cell(inelastic).law->plastic_strain(impl_->sweeps.finite().memory_of(inelastic));
}

template <int Dim>
std::optional<double> Ccg<Dim>::out_of_plane_stress(std::int32_t cell) const {
    const Matrix<Dim> g = displacement_gradient(cell);
    const std::optional<double> alone = impl_->out_of_plane_stress(cell, g);
    const auto pushed = alone ? impl_->stress_of_pushes(cell, g) : std::nullopt;
    return pushed ? *alone + pushed->out_of_plane : alone;
}

template <int Dim>
std::optional<double> Ccg<Dim>::Impl::out_of_plane_stress(std::int32_t cell,
                                                          const Matrix<Dim>& displacement_gradient) const {
    if (plastic.contains(cell))
        return plastic.out_of_plane_stress(cell, displacement_gradient) - sweeps.materials().heat_out_of_plane(cell);
    if (finite.stretch(cell) && sweeps.finite().bears_nothing(cell)) return 0.0;
    if (const WarmEnergy<Dim>* warm = finite.warm_energy(cell))
        return warm->out_of_plane_stress(sweeps.finite().law_gradient(cell));
    if (arrays.directed.contains(cell))
        return sweeps.directed_out_of_plane_stress(cell) - sweeps.materials().heat_out_of_plane(cell);
    if (const std::int32_t inelastic = finite.inelastic(cell); inelastic >= 0)
        return finite.inelastic_cell(inelastic).law->out_of_plane_stress(sweeps.finite().law_gradient(cell),
                                                                         sweeps.finite().memory_of(inelastic));
    if (!thermal.any() || finite.contains(cell)) return std::nullopt;
    return arrays.cells[cell].lambda * displacement_gradient.trace() - sweeps.materials().heat_out_of_plane(cell);
}

template <int Dim>
std::vector<std::int32_t> Ccg<Dim>::memory_sizes() const {
    std::vector<std::int32_t> sizes(static_cast<std::size_t>(n_cells()), 0);
    impl_->for_memories([&](const auto& cells) {
        for (std::int32_t c = 0; c < n_cells(); ++c) sizes[static_cast<std::size_t>(c)] += cells.memory_size(c);
    });
    return sizes;
}

template <int Dim>
std::vector<double> Ccg<Dim>::memory() const {
    std::vector<double> values;
    for (std::int32_t c = 0; c < n_cells(); ++c)
        impl_->for_memories([&](const auto& cells) { cells.put_memory(c, values); });
    return values;
}

template <int Dim>
void Ccg<Dim>::set_memory(std::span<const double> values) {
    if (impl_->finite.any_inelastic()) impl_->sweeps.finite().forget_ends();
    for (std::int32_t c = 0; c < n_cells(); ++c)
        impl_->for_memories([&](auto& cells) {
            const auto size = static_cast<std::size_t>(cells.memory_size(c));
            if (size > 0) cells.set_memory(c, values.first(size));
            values = values.subspan(size);
        });
}

template <int Dim>
void Ccg<Dim>::take_memory(const Ccg& before, std::span<const std::int32_t> old_cells,
                           std::span<const std::int32_t> old_faces) {
    Impl& to = *impl_;
    const Impl& from = *before.impl_;
    for (std::int32_t c = 0; c < n_cells(); ++c) {
        const std::int32_t old = old_cells[static_cast<std::size_t>(c)];
        check_memory(to.sweeps.finite(), c, from.sweeps.finite(), old);
        check_memory(to.viscous, c, from.viscous, old);
        check_memory(to.plastic, c, from.plastic, old);
        check_memory(to.capped, c, from.capped, old);
    }
    if (to.finite.any_inelastic()) to.sweeps.finite().forget_ends();
    std::vector<double> values;
    const auto take = [&](auto& cells, const auto& old_cells_of) {
        for (std::int32_t c = 0; c < n_cells(); ++c) {
            values.clear();
            old_cells_of.put_memory(old_cells[static_cast<std::size_t>(c)], values);
            if (!values.empty()) cells.set_memory(c, values);
        }
    };
    take(to.sweeps.finite(), from.sweeps.finite());
    take(to.viscous, from.viscous);
    take(to.plastic, from.plastic);
    to.take_jumps(from, old_cells, old_faces);
}

/// Faces that have become free are, for the cells beside them, where flow would have brought them.
template <int Dim>
void Ccg<Dim>::Impl::take_jumps(const Impl& from, std::span<const std::int32_t> old_cells,
                                std::span<const std::int32_t> old_faces) {
    std::vector<double> values;
    for (std::int32_t c = 0; c < arrays.n_cells(); ++c) {
        if (!capped.contains(c)) continue;
        const std::int32_t old_cell = old_cells[static_cast<std::size_t>(c)];
        values.clear();
        for (std::int32_t i = arrays.half_face_offsets[c]; i < arrays.half_face_offsets[c + 1]; ++i) {
            const std::int32_t old_face = old_faces[static_cast<std::size_t>(arrays.half_faces[i].face)];
            Vector<Dim> lasting = -jump_of_tilts(arrays, plastic, c, i);
            if (const std::int32_t old = half_face_of(from.arrays, old_cell, old_face); old >= 0)
                lasting += from.capped.lasting(old) + jump_of_tilts(from.arrays, from.plastic, old_cell, old);
            values.insert(values.end(), lasting.begin(), lasting.end());
        }
        capped.set_memory(c, values);
    }
}

#define ABUT_INSTANTIATE(Dim)                                                                           \
    template bool Ccg<Dim>::any_inelastic() const;                                                      \
    template bool Ccg<Dim>::flows_linearly() const;                                                     \
    template bool Ccg<Dim>::may_have_flowed() const;                                                    \
    template bool Ccg<Dim>::any_face_moves() const;                                                     \
    template void Ccg<Dim>::begin_step(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&, double); \
    template void Ccg<Dim>::end_step();                                                                 \
    template void Ccg<Dim>::bring_to_rest();                                                            \
    template bool Ccg<Dim>::any_damped() const;                                                         \
    template double Ccg<Dim>::damping_ratio(double) const;                                              \
    template Vector<Dim> Ccg<Dim>::drag(std::int32_t, double, const Vector<Dim>&, double);              \
    template dynamics::Losses Ccg<Dim>::step_loss(std::int32_t) const;                                  \
    template double Ccg<Dim>::plastic_strain(std::int32_t) const;                                       \
    template std::optional<double> Ccg<Dim>::out_of_plane_stress(std::int32_t) const;                   \
    template std::vector<std::int32_t> Ccg<Dim>::memory_sizes() const;                                  \
    template std::vector<double> Ccg<Dim>::memory() const;                                              \
    template void Ccg<Dim>::set_memory(std::span<const double>);                                        \
    template void Ccg<Dim>::take_memory(const Ccg&, std::span<const std::int32_t>, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
