#include "abut/solid/cells/finite_cells.hpp"

#include <algorithm>

#include "abut/base/decompositions.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {
namespace {

// An eigenvalue of the sum of n n^T over the largest that counts as none: two normals count as one up to 28 degrees
// between them. Chords of a curve differ by less, and a cell that is condensed along both of them would bear nothing.
constexpr double one_direction = 0.25 * 0.25;
constexpr double rounding = 1e-10;  // the same of normals that are one

template <int Dim>
struct FreeFace {
    Vector<Dim> normal;
    double measure;
};

/// The principal axes of what the normals span, those that they do not span first; right-handed.
template <int Dim>
FreeCell<Dim> cell_behind(std::int32_t cell, double measure, const std::vector<FreeFace<Dim>>& faces) {
    Matrix<Dim> sum = Matrix<Dim>::Zero();
    for (const FreeFace<Dim>& face : faces) sum += face.normal * face.normal.transpose();
    const SymmetricEigen<Dim> eigen = symmetric_eigen(sum);
    FreeCell<Dim> free{.cell = cell, .n_tangents = 0, .axes = eigen.vectors, .to_faces = Matrix<Dim>::Zero()};
    while (eigen.values[free.n_tangents] <= one_direction * eigen.values[Dim - 1]) ++free.n_tangents;
    if (free.has_one_normal() && eigen.values[Dim - 2] <= rounding * eigen.values[Dim - 1])
        free.axes.col(Dim - 1) = faces.front().normal;
    if (free.axes.determinant() < 0.0) free.axes.col(0) *= -1.0;
    Matrix<Dim> shares = Matrix<Dim>::Identity();  // M on the axes
    for (int i = free.n_tangents; i < Dim; ++i)
        for (int j = free.n_tangents; j < Dim; ++j) {
            shares(i, j) = 0.0;
            for (const FreeFace<Dim>& face : faces)
                shares(i, j) +=
                    face.measure / measure * face.normal.dot(free.axes.col(i)) * face.normal.dot(free.axes.col(j));
        }
    Matrix<Dim> inverse = shares.inverse();
    for (int i = 0; i < free.n_tangents; ++i) inverse(i, i) = 0.0;
    free.to_faces = free.axes * inverse * free.axes.transpose();
    return free;
}

}  // namespace

template <int Dim>
FiniteCells<Dim>::FiniteCells(const mesh::Mesh<Dim>& mesh, const FaceConditions<Dim>& conditions,
                              std::span<const Kinematics> kinematics, const FiniteOptions<Dim>& options) {
    if (!any_body(kinematics, &KinematicsProperties::finite_strains)) return;
    takes_ends_ = options.mean_force != MeanForce::discrete_gradient;
    position_.assign(static_cast<std::size_t>(mesh.n_cells()), linear);
    if (std::ranges::any_of(options.stored_energy, [](const auto& law) { return law != nullptr; }))
        set_elastic(mesh, options);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (properties_of(kinematics[static_cast<std::size_t>(mesh.cell_body[c])]).finite_strains) position_[c] = inside;
    is_thick_ = conditions.is_thick;
    is_free_.assign(mesh.boundary_faces.size(), 0);
    std::vector<std::vector<FreeFace<Dim>>> faces(position_.size());
    const auto is_loaded = conditions.are_loaded();  // what is behind these bears it, as it does a bond
    for (const BoundaryFace b : boundary_faces(mesh)) {
        const std::int32_t cell = cell_of(mesh, b), face = mesh_face(mesh, b);
        if (!contains(cell) || !conditions.prescribed[b].isZero(0.0) || is_loaded[b] || conditions.joined[b]) continue;
        is_free_[b] = 1;
        faces[cell].push_back({mesh.face_normal[face], mesh.face_measure[face]});
    }
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        if (faces[c].empty()) continue;
        position_[c] = static_cast<std::int32_t>(free_.size());
        free_.push_back(cell_behind<Dim>(c, mesh.cell_measure[c], faces[c]));
    }
    if (std::ranges::any_of(options.inelastic, [](const auto& law) { return law != nullptr; })) set_inelastic(mesh, options);
}

/// Law of its body; where this is warm a copy, so that each cell has its own temperature.
template <int Dim>
template <class WarmLaw, class Law>
const Law* FiniteCells<Dim>::law_of_cell(std::int32_t cell, const Law* of_body,
                                         std::vector<std::unique_ptr<WarmLaw>>& warm_laws) {
    const auto* warm = dynamic_cast<const WarmLaw*>(of_body);
    if (!warm) return of_body;
    stretch_.resize(position_.size(), nullptr);
    warm_laws.push_back(warm->copy());
    stretch_[static_cast<std::size_t>(cell)] = &warm_laws.back()->stretch();
    return warm_laws.back().get();
}

template <int Dim>
void FiniteCells<Dim>::set_elastic(const mesh::Mesh<Dim>& mesh, const FiniteOptions<Dim>& options) {
    laws_ = options.stored_energy;
    for (const auto& law : laws_) any_warm_ = any_warm_ || dynamic_cast<const WarmEnergy<Dim>*>(law.get());
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        law_.push_back(law_of_cell(c, laws_[static_cast<std::size_t>(mesh.cell_body[c])].get(), warm_energies_));
}

template <int Dim>
void FiniteCells<Dim>::set_temperature(std::span<const double> rise) const {
    for (std::size_t c = 0; c < stretch_.size(); ++c)
        if (stretch_[c]) stretch_[c]->set_rise(rise.empty() ? 0.0 : rise[c]);
}

template <int Dim>
void FiniteCells<Dim>::set_inelastic(const mesh::Mesh<Dim>& mesh, const FiniteOptions<Dim>& options) {
    inelastic_laws_ = options.inelastic;
    for (const auto& law : inelastic_laws_) any_warm_ = any_warm_ || dynamic_cast<const WarmInelastic<Dim>*>(law.get());
    inelastic_index_.assign(position_.size(), -1);
    std::ptrdiff_t begin = 0;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const InelasticLaw<Dim>* of_body = inelastic_laws_[static_cast<std::size_t>(mesh.cell_body[c])].get();
        if (!of_body) continue;
        const InelasticLaw<Dim>* law = law_of_cell(c, of_body, warm_inelastic_);
        const std::type_info* kind = stretch(c) ? &typeid(warm_inelastic_.back()->law()) : &typeid(*law);
        const auto size = static_cast<std::int32_t>(law->initial_memory().size());
        const std::ptrdiff_t end = begin + size + (free_position(c) >= 0 ? Dim * Dim : 0);
        inelastic_index_[c] = static_cast<std::int32_t>(inelastic_.size());
        inelastic_.push_back({law, kind, c, size, begin, end});
        begin = end;
    }
}

template <int Dim>
std::vector<double> FiniteCells<Dim>::initial_memory() const {
    std::vector<double> memory;
    const Matrix<Dim> unit = Matrix<Dim>::Identity();
    for (const Inelastic& cell : inelastic_) {
        const std::vector<double> initial = cell.law->initial_memory();
        memory.insert(memory.end(), initial.begin(), initial.end());
        if (free_position(cell.cell) >= 0) memory.insert(memory.end(), unit.data(), unit.data() + unit.size());
    }
    return memory;
}

template class FiniteCells<2>;
template class FiniteCells<3>;

}  // namespace abut::solid
