#include "abut/solid/cells/capped_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {
namespace {

// MetalFlow::jump_cap where none is given. Gradients of bricks are central differences, so that jumps have more to hold.
constexpr double cap_of_simplices = 0.1, cap_of_others = 0.3;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double same_normal = 1e-10;  // 1 - |cos| of two normals that count as one

template <int Dim>
bool is_simplex(const mesh::Mesh<Dim>& mesh, std::int32_t cell) {
    return mesh.cell_faces[cell].size() == Dim + 1;
}

bool is_finite(std::span<const Kinematics> kinematics, std::size_t body) {
    return properties_of(kinematics, body).finite_strains;
}

/// Directions in which jumps alone hold a cell: along the normals of its faces, or along all directions.
enum class Held : char { no, along_normals, all };

/// How the jumps around each cell hold it where it has
///
///  - a free face that contact may push: what it pushes with is not in the stress of the cell, but in the jumps behind it;
///  - free faces of more than one normal, which leave no more stress than a bar has, or none;
///  - a load or a bond that it does not balance itself, and is no simplex: these faces go where the cells around point.
template <int Dim>
std::vector<Held> held_by_jumps(const mesh::Mesh<Dim>& mesh, std::span<const Kinematics> kinematics,
                                const FaceConditions<Dim>& conditions, FreeFaces free_faces) {
    const auto is_loaded = conditions.are_loaded();
    const auto bends = [&](std::int32_t cell) {
        return is_finite(kinematics, static_cast<std::size_t>(mesh.cell_body[cell]));
    };
    const bool may_touch = free_faces != FreeFaces::stay_alone;
    std::vector<Held> held(static_cast<std::size_t>(mesh.n_cells()), Held::no);
    std::vector<const Vector<Dim>*> first(held.size(), nullptr);
    for (const BoundaryFace b : boundary_faces(mesh)) {
        const std::int32_t cell = cell_of(mesh, b);
        const auto i = static_cast<std::size_t>(cell);
        const auto hold = [&](Held by) { held[i] = std::max(held[i], by); };
        const bool is_affine = conditions.joined[b] || (is_loaded[b] && bends(cell));
        if (is_affine && !is_simplex(mesh, cell)) hold(Held::all);
        if (!conditions.prescribed[b].isZero(0.0)) continue;
        const Vector<Dim>& normal = mesh.face_normal[mesh_face(mesh, b)];
        if (!first[i]) first[i] = &normal;
        const bool has_other = std::abs(first[i]->dot(normal)) < 1.0 - same_normal;
        if (may_touch)
            hold(bends(cell) ? Held::along_normals : Held::all);
        else if (has_other)
            hold(Held::all);
    }
    return held;
}

}  // namespace

template <int Dim>
CappedJumps<Dim>::CappedJumps(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                              std::span<const Kinematics> kinematics, const FaceConditions<Dim>& conditions,
                              FreeFaces free_faces, const CcgArrays<Dim>& arrays)
    : arrays_(arrays) {
    // By default not where contact squeezes finite bodies: what flows further needs a shorter step than at rest.
    const auto yields = [&](std::size_t body) {
        const bool may_fold = free_faces != FreeFaces::stay_alone && is_finite(kinematics, body);
        return materials[body].law == MaterialLaw::j2 && (materials[body].flow.jump_cap > 0.0 || !may_fold);
    };
    for (std::size_t body = 0; body < materials.size(); ++body) any_ = any_ || yields(body);
    if (!any_) return;
    const auto body_of = [&](std::int32_t cell) { return static_cast<std::size_t>(mesh.cell_body[cell]); };
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) capped_.push_back(yields(body_of(c)) ? 1 : 0);
    const std::vector<Held> held = held_by_jumps(mesh, kinematics, conditions, free_faces);
    largest_.assign(arrays.half_faces.size(), std::numeric_limits<double>::infinity());
    only_slides_.assign(largest_.size(), 0);
    for (std::size_t i = 0; i < largest_.size(); ++i) {
        const auto f = static_cast<std::size_t>(arrays.half_faces[i].face);
        if (arrays.boundary_index[f] != no_face) continue;
        const auto [a, b] = arrays.face_cells[f];
        const double stiffness = arrays.faces[f].jump_stiffness;
        if (!contains(a) || stiffness == 0.0) continue;
        const Held by = std::max(held[static_cast<std::size_t>(a)], held[static_cast<std::size_t>(b)]);
        if (by == Held::all) {
            if (!is_finite(kinematics, body_of(a))) largest_[i] = never_reached;  // it goes with free faces that flow
            continue;
        }
        only_slides_[i] = by == Held::along_normals ? 1 : 0;
        const Material& material = materials[body_of(a)];
        const double by_default = is_simplex(mesh, a) && is_simplex(mesh, b) ? cap_of_simplices : cap_of_others;
        const double traction =
            (material.flow.jump_cap > 0.0 ? material.flow.jump_cap : by_default) * material.flow.yield_stress;
        largest_[i] = mesh.face_measure[f] * traction / stiffness;
    }
    memory_.assign(arrays.half_faces.size(), Vector<Dim>::Zero());
    next_ = memory_;
    elastic_.assign(memory_.size(), Vector<Dim>::Constant(not_known));
    next_elastic_ = elastic_;
    start_.resize(memory_.size());
    end_.resize(memory_.size());
    loss_.assign(capped_.size(), 0.0);
    loss_by_flow_ = loss_;
}

template <int Dim>
Vector<Dim> CappedJumps<Dim>::limited(std::ptrdiff_t half_face, const Vector<Dim>& jump, const Vector<Dim>& normal) const {
    if (only_slides_[static_cast<std::size_t>(half_face)] == 0) return jump;
    return jump - (normal.dot(jump) / normal.squaredNorm()) * normal;
}

template <int Dim>
Vector<Dim> CappedJumps<Dim>::excess(std::ptrdiff_t half_face, const Vector<Dim>& trial) const {
    const double size = trial.norm(), largest = largest_[static_cast<std::size_t>(half_face)];
    if (!(size > largest)) return Vector<Dim>::Zero();
    return (1.0 - largest / size) * trial;
}

/// With J_b and [u]_b the means of both ends D = k ([u]_b - J_b) . Delta J, which is exact; half of it is of this cell.
template <int Dim>
Vector<Dim> CappedJumps<Dim>::advance(std::ptrdiff_t cell, std::ptrdiff_t half_face, const Vector<Dim>& mean,
                                      const Vector<Dim>& change, const Vector<Dim>& of_flow) {
    const auto i = static_cast<std::size_t>(half_face);
    const Vector<Dim> trial = mean + 0.5 * change - memory_[i] - of_flow;
    const Vector<Dim> yielded = excess(half_face, trial);
    if (!yielded.isZero(0.0)) any_yielded_.store(true, std::memory_order_relaxed);
    next_[i] = memory_[i] + of_flow + yielded;
    next_elastic_[i] = trial - yielded;
    const Vector<Dim> lasting = 0.5 * (memory_[i] + next_[i]);
    const Vector<Dim> gradient = 0.5 * arrays_.faces[arrays_.half_faces[i].face].jump_stiffness * (mean - lasting);
    loss_[static_cast<std::size_t>(cell)] += gradient.dot(yielded);
    loss_by_flow_[static_cast<std::size_t>(cell)] += gradient.dot(of_flow);
    return lasting;
}

template <int Dim>
auto CappedJumps<Dim>::of(const Vector<Dim>& lasting, const Vector<Dim>& jump, const Matrix<Dim>& gradient) -> Elastic {
    return {jump - lasting - gradient * lasting, gradient, lasting};
}

template <int Dim>
auto CappedJumps<Dim>::at(std::ptrdiff_t half_face, const Vector<Dim>& jump, const Matrix<Dim>& gradient) const -> Elastic {
    return of(lasting(half_face), jump, gradient);
}

template <int Dim>
auto CappedJumps<Dim>::start(std::ptrdiff_t half_face, const Vector<Dim>& jump, const Matrix<Dim>& gradient) -> Elastic {
    return start_[static_cast<std::size_t>(half_face)] = at(half_face, jump, gradient);
}

/// With s = [x] - F J, F the mean of both cells, the energy is k s^2/2 and its gradient k s . (d[x] - dF J). The mean
/// of both ends does
///
///     k s_b . (Delta [x] - Delta F J_b) - k/4 Delta s . Delta F Delta J
///         = Delta V + k s_b . F_b Delta J - k/4 Delta s . Delta F Delta J
template <int Dim>
auto CappedJumps<Dim>::advance(std::ptrdiff_t cell, std::ptrdiff_t half_face, const Vector<Dim>& jump,
                               const Matrix<Dim>& gradient, double& defect) -> Elastic {
    const auto i = static_cast<std::size_t>(half_face);
    const std::int32_t face = arrays_.half_faces[i].face;
    const Elastic& start = start_[i];
    Elastic& end = end_[i] = at(half_face, jump, gradient);
    next_[i] = memory_[i];
    if (end.jump.norm() <= largest_[i]) return end;
    const Matrix<Dim> deformed = Matrix<Dim>::Identity() + gradient, back = deformed.inverse();
    const Vector<Dim> normal = back.transpose() * Vector<Dim>(arrays_.faces[face].area_vector.data());
    const Vector<Dim> yielded = excess(half_face, limited(half_face, end.jump, normal));
    if (yielded.isZero(0.0)) return end;
    next_[i] = memory_[i] + back * yielded;
    end = of(next_[i], jump, gradient);
    const Vector<Dim> change = next_[i] - memory_[i];
    const Matrix<Dim> turned = gradient - start.gradient;
    const double taken = (0.5 * (start.jump + end.jump)).dot(deformed * change - 0.5 * turned * change) -
                         0.25 * (end.jump - start.jump).dot(turned * change);
    const double of_cell = 0.5 * arrays_.faces[face].jump_stiffness * taken;
    loss_[static_cast<std::size_t>(cell)] += std::max(0.0, of_cell);
    defect += std::min(0.0, of_cell);
    return end;
}

/// A step sets `next_` and `end_` of all cells that anybody looks at.
template <int Dim>
void CappedJumps<Dim>::end_step() {
    std::swap(memory_, next_);
    std::swap(elastic_, next_elastic_);
    std::swap(start_, end_);
    any_yielded_ = false;
}

template <int Dim>
std::int32_t CappedJumps<Dim>::memory_size(std::ptrdiff_t cell) const {
    if (!contains(cell)) return 0;
    return Dim * static_cast<std::int32_t>(arrays_.half_faces_of(static_cast<std::int32_t>(cell)).size());
}

template <int Dim>
void CappedJumps<Dim>::put_memory(std::ptrdiff_t cell, std::vector<double>& values) const {
    if (!contains(cell)) return;
    for (std::int32_t i = arrays_.half_face_offsets[cell]; i < arrays_.half_face_offsets[cell + 1]; ++i)
        values.insert(values.end(), lasting(i).data(), lasting(i).data() + Dim);
}

template <int Dim>
void CappedJumps<Dim>::set_memory(std::ptrdiff_t cell, std::span<const double> values) {
    for (std::int32_t i = arrays_.half_face_offsets[cell]; i < arrays_.half_face_offsets[cell + 1]; ++i) {
        memory_[i] = next_[i] = Vector<Dim>(values.data());
        if (!may_last(i) && !memory_[i].isZero(0.0)) largest_[static_cast<std::size_t>(i)] = never_reached;
        elastic_[i].setConstant(not_known);
        values = values.subspan(Dim);
    }
}

template class CappedJumps<2>;
template class CappedJumps<3>;

}  // namespace abut::solid
