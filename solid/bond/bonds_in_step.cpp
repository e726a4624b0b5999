// Bonds in one state, or along a step.
#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

#include "abut/solid/bond/bonds.hpp"

namespace abut::solid {
namespace {

template <int Dim>
std::size_t position_of(const FaceCorrections<Dim>& corrections, BoundaryFace face) {
    const auto at = std::ranges::lower_bound(corrections.faces, face);
    return at != corrections.faces.end() && *at == face ? static_cast<std::size_t>(at - corrections.faces.begin())
                                                        : corrections.faces.size();
}

}  // namespace

template <int Dim>
void Bonds<Dim>::stand_at(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load) {
    if (!any()) return;
    stand_linear(of_cells(q, frames_.end()), load, pressed_at);
    springs_->stand_at(q, load);
}

/// Displacements in these frames of the cells that joints depend on; those of small bodies move as their points do.
template <int Dim>
std::span<const Vector<Dim>> Bonds<Dim>::of_cells(std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames) {
    if (!frames_.any() || cells_.empty()) return q;
    frames_.displacement(cells_, q, frames, in_frames_);
    return in_frames_;
}

template <int Dim>
void Bonds<Dim>::stand_linear(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                              PressedSides (*pressed)(double distance)) {
    take_own_sides(u, load, of_side_0_);
    sides_.bring({{as_values<Dim>(of_side_0_), Dim}});
    take_jumps(of_side_0_, jump_);
    look_at_sides([&](std::size_t i) { return pressed(normal_part(joints_[i], jump_[i])); }, pressed_);
    set_corrections(jump_, pressed_, delta_, delta_here_);
}

/// look(i): of joint i.
template <int Dim>
template <class Look>
void Bonds<Dim>::look_at_sides(const Look& look, std::vector<PressedSides>& pressed) const {
    pressed.resize(joints_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i)
        if (share_of(joints_[i]) < 1.0)  // nobody asks for those of whole ones
            pressed[i] = fracture_energy(joints_[i].place) > 0.0 ? look(i) : PressedSides{};
}

template <int Dim>
std::span<const Vector<Dim>> Bonds<Dim>::displacement_at(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    take_own_sides(u, load, of_side_0_);
    sides_.bring({{as_values<Dim>(of_side_0_), Dim}});
    jump_at_.resize(joints_.size());
    delta_at_.resize(delta_.size());
    delta_here_at_.resize(delta_here_.size());
    take_jumps(of_side_0_, jump_at_);
    look_at_sides([&](std::size_t i) { return pressed_at(normal_part(joints_[i], jump_at_[i])); }, pressed_at_);
    set_corrections(jump_at_, pressed_at_, delta_at_, delta_here_at_);
    return delta_here_at_;
}

template <int Dim>
void Bonds<Dim>::follow(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0, std::span<const Vector<Dim>> q_1,
                        const BoundaryLoad<Dim>& load_1) {
    if (!any()) return;
    if (begins_at_end(q_0, load_0))
        std::swap(of_side_0_, of_side_1_);
    else
        take_own_sides(of_cells(q_0, frames_.start()), load_0, of_side_0_);
    take_own_sides(of_cells(q_1, frames_.end()), load_1, of_side_1_);
    keep_end(q_1, load_1);
    sides_.bring({{as_values<Dim>(of_side_0_), Dim}, {as_values<Dim>(of_side_1_), Dim}});
    take_jumps(of_side_0_, jump_0_);
    take_jumps(of_side_1_, jump_1_);
    if (!change_here_.empty()) {
        for (std::size_t i = 0; i < joints_.size(); ++i) jump_[i] = jump_1_[i] - jump_0_[i];
        look_at_sides(
            [&](std::size_t i) {
                const double start = normal_part(joints_[i], jump_0_[i]), end = normal_part(joints_[i], jump_1_[i]);
                return PressedSides{.mean = std::min(end, 0.0) - std::min(start, 0.0)};
            },
            pressed_);
        set_corrections(jump_, pressed_, delta_, change_here_);
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) jump_[i] = 0.5 * (jump_0_[i] + jump_1_[i]);
    look_at_sides(
        [&](std::size_t i) {
            return pressed_along(normal_part(joints_[i], jump_0_[i]), normal_part(joints_[i], jump_1_[i]));
        },
        pressed_);
    set_corrections(jump_, pressed_, delta_, delta_here_);
    springs_->follow(q_0, load_0, q_1, load_1);
}

/// Whether a step begins where the last one ended, to the bit.
template <int Dim>
bool Bonds<Dim>::begins_at_end(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0) const {
    if (!end_.is_known || end_.prescribed.empty() != load_0.displacement.empty()) return false;
    const auto is_same_frame = [](const BodyFrame<Dim>& a, const BodyFrame<Dim>& b) {
        return a.centre == b.centre && a.turn == b.turn;
    };
    if (frames_.any() && !std::ranges::equal(frames_.start(), end_.frames, is_same_frame)) return false;
    for (std::size_t i = 0; i < end_.prescribed.size(); ++i)
        if (load_0.displacement[static_cast<std::size_t>(faces_->own_faces()[i])] != end_.prescribed[i]) return false;
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (q_0[static_cast<std::size_t>(cells_[i])] != end_.q[i]) return false;
    return true;
}

template <int Dim>
void Bonds<Dim>::keep_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1) {
    end_.is_known = true;
    for (std::size_t i = 0; i < cells_.size(); ++i) end_.q[i] = q_1[static_cast<std::size_t>(cells_[i])];
    if (frames_.any()) end_.frames.assign(frames_.end().begin(), frames_.end().end());
    end_.prescribed.clear();
    if (load_1.displacement.empty()) return;
    for (const BoundaryFace face : faces_->own_faces())
        end_.prescribed.push_back(load_1.displacement[static_cast<std::size_t>(face)]);
}

template <int Dim>
void Bonds<Dim>::take_own_sides(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                std::vector<Vector<Dim>>& of_sides) {
    for (const std::size_t face : faces_->own()) of_face_[face] = ccg_.face_displacement((*faces_)[face], u, load);
    for (const std::size_t i : sides_.own()) {
        const Joint& joint = joints_[i / 2];
        const std::size_t side = i % 2, face = joint.face[side];
        const Vector<Dim>& origin = u[of_faces_[face].cell];
        Vector<Dim> displacement = of_face_[face];
        for (std::size_t k = joint.slope_of[side]; k < joint.slope_end[side]; ++k)
            displacement += slope_[k].weight * (u[slope_[k].cell] - origin);
        of_sides[i] = displacement;
    }
}

template <int Dim>
void Bonds<Dim>::take_jumps(std::span<const Vector<Dim>> of_sides, std::vector<Vector<Dim>>& jump) const {
    for (std::size_t p = 0; p < joints_.size(); ++p) jump[p] = of_sides[2 * p + 1] - of_sides[2 * p];
}

template <int Dim>
void Bonds<Dim>::set_corrections(std::span<const Vector<Dim>> jump, std::span<const PressedSides> pressed,
                                 std::vector<Vector<Dim>>& delta, std::vector<Vector<Dim>>& here) const {
    for (Vector<Dim>& of_face : delta) of_face.setZero();
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const double share = share_of(joint);
        const Vector<Dim> borne =
            share < 1.0 ? Vector<Dim>(share * jump[p] + (1.0 - share) * pressed[p].mean * joint.under_pressure) : jump[p];
        for (std::size_t side = 0; side < 2; ++side) {
            const std::size_t face = joint.face[side];
            delta[face] += joint.area / of_faces_[face].measure * (joint.share[side] * borne);
        }
    }
    for (std::size_t i = 0; i < here.size(); ++i) here[i] = delta[faces_->here()[i]];
}

template <int Dim>
FaceCorrections<Dim> Bonds<Dim>::corrections(const FaceCorrections<Dim>& of_contact) {
    if (!any()) return of_contact;
    of_others_ = springs_->corrections(of_contact);
    return merged_.of(of_others_, own_corrections());
}

template <int Dim>
std::span<const BodyPush<Dim>> Bonds<Dim>::pushes(std::span<const BodyPush<Dim>> others) {
    return any() ? springs_->pushes(others) : others;
}

template <int Dim>
double Bonds<Dim>::energy() const {
    if (!any()) return 0.0;
    double energy = springs_->energy();
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const double share = share_of(joint);
        energy += 0.5 * share * joint.area * jump_[p].dot(joint.stiffness * jump_[p]);
        if (share < 1.0)
            energy += 0.5 * (1.0 - share) * joint.area * joint.normal_stiffness * pressed_[p].mean * pressed_[p].mean;
    }
    for (std::size_t i = 0; i < of_faces_.size(); ++i)
        energy -= 0.5 * of_faces_[i].measure * delta_[i].dot(of_faces_[i].stiffness * delta_[i]);
    return energy;
}

/// dV/dû of a face without what others push it with: the points that they push have no part in the corrections.
template <int Dim>
Vector<Dim> Bonds<Dim>::bulk_gradient(const BondedFace& of_cell, BoundaryFace face) const {
    Vector<Dim> gradient = ccg_.boundary_gradient(face);
    if (of_others_.faces.empty()) return gradient;
    const std::size_t n = of_others_.faces.size();
    if (const std::size_t i = position_of(of_others_, face); i < n) gradient -= of_others_.energy_gradient[i];
    if (of_others_.moment.empty()) return gradient;
    const std::int32_t f = mesh_face(mesh_, face);
    const Vector<Dim> spread = mesh_.face_measure[f] / mesh_.cell_measure[of_cell.cell] * mesh_.face_normal[f];
    for (const BoundaryFace neighbour : of_cell.neighbours)
        if (const std::size_t i = position_of(of_others_, neighbour); i < n) gradient -= of_others_.moment[i] * spread;
    return gradient;
}

template <int Dim>
void Bonds<Dim>::take_excess() {
    for (const std::size_t i : faces_->own()) {
        const BondedFace& face = of_faces_[i];
        const BoundaryFace b = (*faces_)[i];
        Vector<Dim> of_face = bulk_gradient(face, b);
        ccg_.boundary().for_each_answer(b, [&](BoundaryFace answering, const Matrix<Dim>& answer) {
            of_face += answer.transpose() * bulk_gradient(face, answering);
        });
        excess_[i] = of_face / face.measure - face.stiffness * delta_[i];
    }
    faces_->items().bring({{as_values<Dim>(excess_), Dim}});
}

/// dV/dDelta of a place [N].
template <int Dim>
Vector<Dim> Bonds<Dim>::push_of(const Joint& joint, const Vector<Dim>& jump, const PressedSides& pressed) const {
    const double share = share_of(joint);
    const Vector<Dim> of_first = joint.share[0].transpose() * excess_[joint.face[0]],
                      of_second = joint.share[1].transpose() * excess_[joint.face[1]];
    const Vector<Dim> whole = joint.stiffness * jump + of_first + of_second;
    if (share == 1.0) return joint.area * whole;
    const double pressure =
        joint.normal_stiffness * pressed.gradient + pressed.slope * joint.under_pressure.dot(of_first + of_second);
    return joint.area * (share * whole + (1.0 - share) * pressure * joint.normal);
}

/// Each place pushes both faces, and the cells on whose slope it depends beside that.
template <int Dim>
void Bonds<Dim>::push_faces(std::span<Vector<Dim>> gradient) {
    for (Vector<Dim>& of_face : gradient_) of_face.setZero();
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const Vector<Dim> push = push_of(joint, jump_[p], pressed_[p]);
        for (std::size_t side = 0; side < 2; ++side) {
            const Vector<Dim> on_side = side == 0 ? Vector<Dim>(-push) : push;
            gradient_[joint.face[side]] += on_side;
            for (std::size_t i = joint.slope_of[side]; i < joint.slope_end[side]; ++i)
                gradient[static_cast<std::size_t>(slope_[i].cell)] += slope_[i].weight * on_side;
        }
    }
}

template <int Dim>
void Bonds<Dim>::add_gradient(std::span<Vector<Dim>> gradient) {
    if (joints_.empty()) return;
    take_excess();
    push_faces(gradient);
    const BoundaryReconstruction<Dim>& rows = ccg_.boundary();
    for (const std::size_t i : faces_->here()) {
        const std::int32_t b = number_of((*faces_)[i]);
        for (std::int32_t k = rows.offsets[b]; k < rows.offsets[b + 1]; ++k)
            gradient[static_cast<std::size_t>(rows.cells[k])] += rows.weights[k].transpose() * gradient_[i];
    }
}

template <int Dim>
double Bonds<Dim>::work_of_loads(const BoundaryLoad<Dim>& start, const BoundaryLoad<Dim>& end) const {
    const std::vector<double> of_faces = faces_->of_owners(1, [&](std::size_t i) {
        const auto b = static_cast<std::size_t>((*faces_)[i]);
        return std::array{gradient_[i].dot(end.displacement[b] - start.displacement[b])};
    });
    return std::accumulate(of_faces.begin(), of_faces.end(), 0.0);
}

#define ABUT_INSTANTIATE(Dim)                                                                                              \
    template void Bonds<Dim>::stand_at(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&);                            \
    template void Bonds<Dim>::stand_linear(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&,                         \
                                           PressedSides (*)(double));                                                      \
    template std::span<const Vector<Dim>> Bonds<Dim>::displacement_at(std::span<const Vector<Dim>>,                        \
                                                                      const BoundaryLoad<Dim>&);                           \
    template void Bonds<Dim>::follow(std::span<const Vector<Dim>>, const BoundaryLoad<Dim>&, std::span<const Vector<Dim>>, \
                                     const BoundaryLoad<Dim>&);                                                            \
    template FaceCorrections<Dim> Bonds<Dim>::corrections(const FaceCorrections<Dim>&);                                    \
    template std::span<const BodyPush<Dim>> Bonds<Dim>::pushes(std::span<const BodyPush<Dim>>);                            \
    template double Bonds<Dim>::energy() const;                                                                            \
    template void Bonds<Dim>::add_gradient(std::span<Vector<Dim>>);                                                        \
    template double Bonds<Dim>::work_of_loads(const BoundaryLoad<Dim>&, const BoundaryLoad<Dim>&) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
