#include "abut/solid/bond_springs.hpp"

#include <algorithm>

#include "abut/base/sort_unique.hpp"

namespace abut::solid {

template <int Dim>
BondSprings<Dim>::BondSprings(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames,
                              std::span<const BondPlace<Dim>> places, std::span<const std::array<BoundaryFace, 2>> faces,
                              std::span<const std::size_t> of_springs, const std::vector<double>& share)
    : mesh_(bodies.deformable()), ccg_(ccg), frames_(frames), places_(places), share_(share) {
    for (const std::size_t place : of_springs) faces_.insert(faces_.end(), faces[place].begin(), faces[place].end());
    sort_unique(faces_);
    for (const std::size_t place : of_springs) {
        BondSpring spring{};
        spring.place = place;
        double compliance = 0.0;
        for (std::size_t side = 0; side < 2; ++side) {
            const BoundaryFace face = faces[place][side];
            compliance += 1.0 / ccg.normal_stiffness(face);
            spring.ends[side] = {static_cast<std::size_t>(std::ranges::lower_bound(faces_, face) - faces_.begin()),
                                 places[place].position - ccg.centroid(face), places[place].position,
                                 static_cast<std::size_t>(mesh_.cell_body[cell_of(mesh_, face)])};
        }
        spring.stiffness = places[place].area / compliance;
        springs_.push_back(spring);
    }
    if (springs_.empty()) return;
    region_ = ccg.region_of_tilted_faces(faces_);
    u_.resize(static_cast<std::size_t>(bodies.n_cells()));
    displacement_.resize(faces_.size());
    tilt_.resize(faces_.size());
    x_0_.resize(springs_.size());
    x_1_.resize(springs_.size());
}

template <int Dim>
void BondSprings<Dim>::place(std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames,
                             const BoundaryLoad<Dim>& load, StepState state, Positions& x) {
    frames_.displacement(region_.input_cells, q, frames, u_);
    ccg_.evaluate_tilted_faces(region_, u_, load, displacement_, tilt_, state);
    for (std::size_t i = 0; i < springs_.size(); ++i)
        for (std::size_t side = 0; side < 2; ++side) {
            const End& end = springs_[i].ends[side];
            x[i][side] = frames[end.body](end.rest - frames_.rest_centre(end.body) + displacement_[end.face] +
                                          tilt_[end.face] * end.arm);
        }
}

template <int Dim>
void BondSprings<Dim>::stand_at(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load) {
    if (!any()) return;
    place(q, frames_.end(), load, StepState::given, x_1_);
    x_0_ = x_1_;
    collect();
}

template <int Dim>
void BondSprings<Dim>::follow(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0,
                              std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1) {
    if (!any()) return;
    place(q_0, frames_.start(), load_0, StepState::given, x_0_);
    place(q_1, frames_.end(), load_1, StepState::end, x_1_);
    collect();
}

/// Where the points are in the middle of a step, springs pull with the mean of both ends.
template <int Dim>
void BondSprings<Dim>::collect() {
    face_gradient_.assign(faces_.size(), Vector<Dim>::Zero());
    cell_moment_.assign(faces_.size(), Matrix<Dim>::Zero());
    pushes_.assign(frames_.n_bodies(), {});
    for (std::size_t i = 0; i < springs_.size(); ++i) {
        const Vector<Dim> pull = 0.5 * share_[springs_[i].place] * springs_[i].stiffness *
                                 (x_0_[i][1] - x_0_[i][0] + x_1_[i][1] - x_1_[i][0]);  // dV/dx_2
        for (std::size_t side = 0; side < 2; ++side) {
            const End& end = springs_[i].ends[side];
            const Vector<Dim> gradient = side == 0 ? Vector<Dim>(-pull) : pull;
            pushes_[end.body].add(gradient, 0.5 * (x_0_[i][side] - frames_.start()[end.body].centre + x_1_[i][side] -
                                                   frames_.end()[end.body].centre));
            const Vector<Dim> in_frame = frames_.step(end.body).force_turn().transpose() * gradient;
            face_gradient_[end.face] += in_frame;
            cell_moment_[end.face] += in_frame * end.arm.transpose();
        }
    }
}

/// What springs of no length resist tiny displacements with does not depend on how the bodies stand.
template <int Dim>
FaceCorrections<Dim> BondSprings<Dim>::stiffness_of(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    if (!any()) return {};
    ccg_.evaluate_tilted_faces(region_, u, load, displacement_, tilt_);
    face_gradient_.assign(faces_.size(), Vector<Dim>::Zero());
    cell_moment_.assign(faces_.size(), Matrix<Dim>::Zero());
    for (const BondSpring& spring : springs_) {
        const auto at = [&](const End& end) -> Vector<Dim> { return displacement_[end.face] + tilt_[end.face] * end.arm; };
        const Vector<Dim> pull = share_[spring.place] * spring.stiffness * (at(spring.ends[1]) - at(spring.ends[0]));
        for (std::size_t side = 0; side < 2; ++side) {
            const End& end = spring.ends[side];
            const Vector<Dim> gradient = side == 0 ? Vector<Dim>(-pull) : pull;
            face_gradient_[end.face] += gradient;
            cell_moment_[end.face] += gradient * end.arm.transpose();
        }
    }
    return {faces_, {}, face_gradient_, cell_moment_};
}

template <int Dim>
FaceCorrections<Dim> BondSprings<Dim>::corrections(const FaceCorrections<Dim>& of_contact) {
    if (!any()) return of_contact;
    return merged_.of(of_contact, {faces_, {}, face_gradient_, cell_moment_});
}

template <int Dim>
std::span<const BodyPush<Dim>> BondSprings<Dim>::pushes(std::span<const BodyPush<Dim>> others) {
    if (!any()) return others;
    all_pushes_ = pushes_;
    for (std::size_t body = 0; body < others.size(); ++body) {
        all_pushes_[body].gradient += others[body].gradient;
        all_pushes_[body].moment += others[body].moment;
    }
    return all_pushes_;
}

template <int Dim>
double BondSprings<Dim>::energy() const {
    double energy = 0.0;
    for (std::size_t i = 0; i < springs_.size(); ++i)
        energy += 0.5 * share_[springs_[i].place] * springs_[i].stiffness * (x_1_[i][1] - x_1_[i][0]).squaredNorm();
    return energy;
}

template class BondSprings<2>;
template class BondSprings<3>;

}  // namespace abut::solid
