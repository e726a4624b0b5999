// What acts on the boundary faces: prescribed displacements, tractions and temperatures.
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/ccg/ccg_impl.hpp"

namespace abut::solid {

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
                       "Precision::double_precision and StepDevice::host (--device host).");
    impl_->thermal = ThermalCells<Dim>(mesh, materials, temperature, impl_->finite);
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
double Ccg<Dim>::traction_work(BoundaryFace face, const BoundaryLoad<Dim>& load) const {
    return load.traction[static_cast<std::size_t>(face)].dot(impl_->sweeps.face_displacement(face));
}

#define ABUT_INSTANTIATE(Dim)                                                                                              \
    template bool Ccg<Dim>::load_varies() const;                                                                           \
    template void Ccg<Dim>::set_temperature(const mesh::Mesh<Dim>&, std::span<const Material>,                             \
                                            std::span<const TemperatureRise<Dim>>);                                        \
    template bool Ccg<Dim>::is_warm() const;                                                                               \
    template void Ccg<Dim>::set_traction(const std::string&, std::span<const Vector<Dim>>);                                \
    template Vector<Dim> Ccg<Dim>::face_displacement(BoundaryFace, std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&) \
        const;                                                                                                             \
    template BoundaryLoad<Dim> Ccg<Dim>::load_at(double, double) const;                                                    \
    template BoundaryLoad<Dim> Ccg<Dim>::load_free() const;                                                                \
    template IdSpan<BoundaryFace, const Matrix<Dim>> Ccg<Dim>::prescribed() const;                                         \
    template std::vector<BoundaryFace> Ccg<Dim>::prescribed_faces_of(std::int32_t) const;                                  \
    template double Ccg<Dim>::traction_work(BoundaryFace, const BoundaryLoad<Dim>&) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
