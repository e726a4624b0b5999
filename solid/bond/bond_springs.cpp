#include "abut/solid/bond/bond_springs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abut::solid {
namespace {

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();
// Of the spring over that of a half cell, where faces are affine and do not give way to what pulls at them: as stiff as
// it may be without a shorter step.
constexpr double affine_stiffness = 2.0;

}  // namespace

template <int Dim>
BondSprings<Dim>::BondSprings(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames,
                              const RankPart<Dim>& part, std::span<const BondPlace<Dim>> places,
                              std::span<const std::size_t> of_springs, const std::vector<double>& share,
                              std::span<const double> stiffness, std::span<const double> normal_stiffness)
    : ccg_(ccg),
      frames_(frames),
      places_(places),
      share_(share),
      faces_(bodies.deformable(), part, places, of_springs),
      here_(faces_.size(), nowhere) {
    if (of_springs.empty()) return;
    const std::vector<double> of_half_cells =
        faces_.of_owners(1, [&](std::size_t face) { return std::array{ccg.normal_stiffness(faces_[face])}; });
    const std::vector<double> centroids =
        faces_.of_owners(Dim, [&](std::size_t face) { return ccg.centroid(faces_[face]); });
    const auto centroid = as_vectors<Dim>(std::span<const double>(centroids));
    for (const std::size_t place : of_springs) {
        BondSpring spring{};
        spring.place = place;
        spring.keeps_pressure = bodies.options().bonds[places[place].bond].fracture_energy > 0.0;
        double compliance = 0.0;
        for (std::size_t side = 0; side < 2; ++side) {
            const std::size_t face = faces_.position_of(places[place], side);
            const bool is_affine = bodies.is_finite(places[place].bodies[side]);
            compliance += 1.0 / ((is_affine ? affine_stiffness : 1.0) * of_half_cells[face]);
            spring.ends[side] = {face, places[place].position - centroid[face], places[place].position,
                                 static_cast<std::size_t>(bodies.deformable_body(places[place].bodies[side]))};
        }
        const auto given = [&](double value) { return places[place].area * (value > 0.0 ? value : 1.0 / compliance); };
        spring.stiffness = given(stiffness[place]);
        spring.normal_stiffness = given(normal_stiffness[place]);
        springs_.push_back(spring);
    }
    for (std::size_t i = 0; i < faces_.here().size(); ++i) here_[faces_.here()[i]] = i;
    region_ = ccg.region_of_tilted_faces(faces_.own_faces());
    u_.resize(static_cast<std::size_t>(bodies.n_cells()));
    own_displacement_.resize(faces_.own().size());
    own_tilt_.resize(faces_.own().size());
    for (Tilted* state : {&start_, &end_}) {
        state->displacement.resize(faces_.size());
        state->tilt.resize(faces_.size());
    }
    x_0_.resize(springs_.size());
    x_1_.resize(springs_.size());
}

// Where the points are -----------------------------------------------------------------------------------------------

template <int Dim>
void BondSprings<Dim>::evaluate_own(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, StepState state,
                                    Tilted& faces) {
    ccg_.evaluate_tilted_faces(region_, u, load, own_displacement_, own_tilt_, state);
    for (std::size_t i = 0; i < faces_.own().size(); ++i) {
        faces.displacement[faces_.own()[i]] = own_displacement_[i];
        faces.tilt[faces_.own()[i]] = own_tilt_[i];
    }
}

template <int Dim>
void BondSprings<Dim>::bring(std::initializer_list<Tilted*> states) {
    for (Tilted* state : states)
        faces_.items().bring({{as_values<Dim>(state->displacement), Dim},
                              {{state->tilt.front().data(), state->tilt.size() * Dim * Dim}, Dim * Dim}});
}

template <int Dim>
void BondSprings<Dim>::place(std::span<const BodyFrame<Dim>> frames, const Tilted& faces, Positions& x) const {
    for (std::size_t i = 0; i < springs_.size(); ++i)
        for (std::size_t side = 0; side < 2; ++side) {
            const End& end = springs_[i].ends[side];
            x[i][side] = frames[end.body](end.rest - frames_.rest_centre(end.body) + faces.displacement[end.face] +
                                          faces.tilt[end.face] * end.arm);
        }
}

template <int Dim>
void BondSprings<Dim>::stand_at(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load) {
    if (!any()) return;
    see_end(q, load, StepState::given);
    x_0_ = x_1_;
    collect();
}

template <int Dim>
void BondSprings<Dim>::see_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1, StepState state) {
    if (!any()) return;
    frames_.displacement(region_.input_cells, q_1, frames_.end(), u_);
    evaluate_own(u_, load_1, state, end_);
    bring({&end_});
    place(frames_.end(), end_, x_1_);
}

template <int Dim>
void BondSprings<Dim>::follow(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0,
                              std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1) {
    if (!any()) return;
    frames_.displacement(region_.input_cells, q_0, frames_.start(), u_);
    evaluate_own(u_, load_0, StepState::given, start_);
    frames_.displacement(region_.input_cells, q_1, frames_.end(), u_);
    evaluate_own(u_, load_1, StepState::end, end_);
    bring({&start_, &end_});
    place(frames_.start(), start_, x_0_);
    place(frames_.end(), end_, x_1_);
    collect();
}

// What they pull with ------------------------------------------------------------------------------------------------

template <int Dim>
void BondSprings<Dim>::begin_collecting() {
    face_gradient_.assign(faces_.here().size(), Vector<Dim>::Zero());
    cell_moment_.assign(faces_.here().size(), Matrix<Dim>::Zero());
}

template <int Dim>
void BondSprings<Dim>::add(const End& end, const Vector<Dim>& in_frame) {
    const std::size_t here = here_[end.face];
    if (here == nowhere) return;
    face_gradient_[here] += in_frame;
    cell_moment_[here] += in_frame * end.arm.transpose();
}

/// Where the points are in the middle of a step, springs pull with the mean of both ends.
template <int Dim>
void BondSprings<Dim>::collect() {
    begin_collecting();
    pushes_.assign(frames_.n_bodies(), {});
    for (std::size_t i = 0; i < springs_.size(); ++i) {
        Vector<Dim> pull = 0.5 * share_[springs_[i].place] * springs_[i].stiffness *
                           (x_0_[i][1] - x_0_[i][0] + x_1_[i][1] - x_1_[i][0]);  // dV/dx_2
        if (pressure_stiffness(springs_[i]) != 0.0) pull += pressure(i);
        push_sides(i, pull);
    }
}

template <int Dim>
void BondSprings<Dim>::push_sides(std::size_t spring, const Vector<Dim>& pull) {
    for (std::size_t side = 0; side < 2; ++side) {
        const End& end = springs_[spring].ends[side];
        const Vector<Dim> gradient = side == 0 ? Vector<Dim>(-pull) : pull;
        pushes_[end.body].add(gradient, 0.5 * (x_0_[spring][side] - frames_.start()[end.body].centre + x_1_[spring][side] -
                                               frames_.end()[end.body].centre));
        add(end, frames_.step(end.body).force_turn().transpose() * gradient);
    }
}

/// dV/dx_2 of pressure_stiffness. V depends on the normal, too, which turns with the first body: that is a moment on it, as
/// of a point at the end of the normal.
template <int Dim>
Vector<Dim> BondSprings<Dim>::pressure(std::size_t spring) {
    const Sides start = sides_at(spring, x_0_, frames_.start()), end = sides_at(spring, x_1_, frames_.end());
    const double push = pressure_stiffness(springs_[spring]) * pressed_along(start.distance(), end.distance()).gradient;
    const Vector<Dim> normal = 0.5 * (start.normal + end.normal), jump = 0.5 * (start.jump + end.jump);
    pushes_[springs_[spring].ends[0].body].moment += push * jump * normal.transpose();
    return push * normal;
}

/// Out of the first face as it is at the end of the step.
template <int Dim>
Vector<Dim> BondSprings<Dim>::tilted_normal(std::size_t spring) const {
    const End& end = springs_[spring].ends[0];
    const Vector<Dim> in_frame =
        (Matrix<Dim>::Identity() + end_.tilt[end.face]).inverse().transpose() * places_[springs_[spring].place].normal;
    return frames_.end()[end.body].turn * in_frame;
}

/// What springs of no length resist tiny displacements with does not depend on how the bodies stand.
template <int Dim>
FaceCorrections<Dim> BondSprings<Dim>::stiffness_of(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    if (!any()) return {};
    evaluate_own(u, load, StepState::given, end_);
    bring({&end_});
    begin_collecting();
    for (const BondSpring& spring : springs_) {
        const auto at = [&](const End& end) -> Vector<Dim> {
            return end_.displacement[end.face] + end_.tilt[end.face] * end.arm;
        };
        const Vector<Dim> jump = at(spring.ends[1]) - at(spring.ends[0]);
        Vector<Dim> pull = share_[spring.place] * spring.stiffness * jump;
        if (const double pressed = pressure_stiffness(spring); pressed != 0.0) {
            const Vector<Dim>& normal = places_[spring.place].normal;
            pull += pressed * jump.dot(normal) * normal;
        }
        add(spring.ends[0], -pull);
        add(spring.ends[1], pull);
    }
    return own_corrections();
}

template <int Dim>
FaceCorrections<Dim> BondSprings<Dim>::corrections(const FaceCorrections<Dim>& of_contact) {
    if (!any()) return of_contact;
    return merged_.of(of_contact, own_corrections());
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
    for (std::size_t i = 0; i < springs_.size(); ++i) {
        energy += 0.5 * share_[springs_[i].place] * springs_[i].stiffness * (x_1_[i][1] - x_1_[i][0]).squaredNorm();
        if (pressure_stiffness(springs_[i]) != 0.0) energy += pressure_energy(i);
    }
    return energy;
}

template <int Dim>
double BondSprings<Dim>::pressure_energy(std::size_t spring) const {
    const double pressed = std::min(sides_at(spring, x_1_, frames_.end()).distance(), 0.0);
    return 0.5 * pressure_stiffness(springs_[spring]) * pressed * pressed;
}

template class BondSprings<2>;
template class BondSprings<3>;

}  // namespace abut::solid
