// How long the candidate list of bodies that may turn is valid: from bounds on the motion, cheap ones first.
#include <cmath>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/solid/contact/pair_potential_driver.hpp"

namespace abut::solid {
namespace {

/// The largest stretch of a difference of two rotations over its Frobenius norm: sqrt(1/2), and what rounding adds.
constexpr double difference_stretch = 0.70710679;

}  // namespace

/// At most, at the end of the step, when no cell is farther than `in_frame` from where it was in its frame [m].
template <int Dim>
double PairPotentialDriver<Dim>::motion_since(const Watch& watch, double in_frame, double time) const {
    const auto motion = [](const Vector<Dim>& shift, const Matrix<Dim>& turned, double radius) {
        return shift.norm() + difference_stretch * turned.norm() * radius;
    };
    double of_frames = 0.0, of_rigid = 0.0;
    const std::size_t n = frames_.n_bodies();
    for (std::size_t body = 0; body < n; ++body) {
        const BodyFrame<Dim>&from = watch.frames[body], to = frames_.end()[body];
        of_frames = larger(of_frames, motion(to.centre - from.centre, to.turn - from.turn, watch.radius[body]));
    }
    for (std::size_t i = 0; i < watch.places.size(); ++i) {
        const RigidPlace<Dim>&from = watch.places[i], to = corners_.rigid_places()[i];
        of_rigid = larger(of_rigid, motion(to.centre - from.centre, to.map - from.map, watch.radius[n + i]));
    }
    of_frames += watch.amplification * in_frame;
    return watch.moved + larger(larger(of_frames, of_rigid), obstacles_.motion(watch.time, time));
}

template <int Dim>
bool PairPotentialDriver<Dim>::is_valid(double near_in_frame, double far_in_frame, double time) const {
    return contact_.is_valid_for(motion_since(near_watch_, near_in_frame, time)) &&
           motion_since(far_watch_, far_in_frame, time) <= far_reach_ && is_valid_within(far_in_frame);
}

/// For pairs of one body.
template <int Dim>
bool PairPotentialDriver<Dim>::is_valid_within(double far_in_frame) const {
    return !touches_itself_ || contact_.is_valid_for(far_watch_.moved_in_frame + far_watch_.amplification * far_in_frame);
}

/// In the step from x_0 to x_1, of the node of a body that deforms which moves farthest, seen from the frame of its
/// body [m].
template <int Dim>
double PairPotentialDriver<Dim>::moved_in_frame() const {
    return std::sqrt(largest(std::ssize(all_.nodes), [&](std::ptrdiff_t i) {
        const std::int32_t n = all_.nodes[i];
        if (corners_.is_of_obstacle(n) || !corners_.is_deformable(corners_.face_of(n))) return 0.0;
        const std::size_t body = corners_.body_of(corners_.face_of(n));
        const BodyFrame<Dim>&start = frames_.start()[body], &end = frames_.end()[body];
        const Vector<Dim> from = start.turn.transpose() * (x_0_[n] - start.centre),
                          to = end.turn.transpose() * (x_1_[n] - end.centre);
        return (to - from).squaredNorm();
    }));
}

/// By what no cell and no frame exceeds in the step: nothing is computed but a few sums.
template <int Dim>
bool PairPotentialDriver<Dim>::is_surely_valid(double cell_motion, double time) {
    near_watch_.travelled += cell_motion;
    far_watch_.travelled += cell_motion;
    if (!has_stepped_ || faces_leave_cells()) return false;
    return is_valid(near_watch_.travelled, far_watch_.travelled, time);
}

/// By how far cells are in their frames from where they were, instead of the way that they have gone.
template <int Dim>
bool PairPotentialDriver<Dim>::is_valid_by_cells(std::span<const Vector<Dim>> q_1, double time) {
    if (!has_stepped_ || faces_leave_cells() || !contact_.is_valid_for(0.0)) return false;
    near_watch_.travelled = distance_in_frame(near_, q_1, near_watch_);
    if (!(motion_since(far_watch_, far_watch_.travelled, time) <= far_reach_) || !is_valid_within(far_watch_.travelled))
        far_watch_.travelled = distance_in_frame(all_, q_1, far_watch_);
    return is_valid(near_watch_.travelled, far_watch_.travelled, time);
}

/// From the state of the watch, of the cell behind these faces that is farthest [m].
template <int Dim>
double PairPotentialDriver<Dim>::distance_in_frame(const Listed& listed, std::span<const Vector<Dim>> q,
                                                   const Watch& watch) {
    const std::vector<std::int32_t>& cells = listed.region.input_cells;
    frames_.displacement(cells, q, frames_.end(), u_);
    const double here =
        largest(std::ssize(cells), [&](std::ptrdiff_t i) { return (u_[cells[i]] - watch.u[i]).squaredNorm(); });
    return std::sqrt(ranks_.largest(here));
}

/// Places the nodes near other bodies at the end of the step; what is far must not have come near. Where faces move without
/// their cells all nodes are looked at.
template <int Dim>
bool PairPotentialDriver<Dim>::is_valid_at_near_nodes(std::span<const Vector<Dim>> q_1, double time) {
    if (!has_stepped_ || !contact_.is_valid_for(0.0)) return false;
    if (!faces_leave_cells() && !(motion_since(far_watch_, far_watch_.travelled, time) <= far_reach_)) return false;
    if (!faces_leave_cells() && !is_valid_within(far_watch_.travelled)) return false;
    const Listed& looked_at = faces_leave_cells() ? all_ : near_;
    corners_.place(looked_at, q_1, frames_.end(), loads_.end(), time, x_1_, StepState::end);
    near_watch_ = watch_from(looked_at, q_1, x_1_, time);
    return contact_.is_valid_for(near_watch_.moved);
}

/// From here, where the nodes listed are placed: at the end of the step.
template <int Dim>
typename PairPotentialDriver<Dim>::Watch PairPotentialDriver<Dim>::watch_from(const Listed& listed,
                                                                              std::span<const Vector<Dim>> q_1,
                                                                              const Points& x, double time) {
    Watch watch{.frames = {frames_.end().begin(), frames_.end().end()},
                .places = corners_.rigid_places(),
                .radius = {},
                .time = time,
                .u = {},
                .amplification = corners_.amplification(listed)};
    frames_.displacement(listed.region.input_cells, q_1, frames_.end(), u_);
    for (const std::int32_t cell : listed.region.input_cells) watch.u.push_back(u_[cell]);
    watch.radius.assign(frames_.n_bodies() + watch.places.size(), 0.0);
    for (const std::int32_t n : listed.nodes) {
        if (corners_.is_of_obstacle(n)) break;
        const std::size_t face = corners_.face_of(n);
        const bool deforms = corners_.is_deformable(face);
        const std::size_t body = deforms ? corners_.body_of(face) : frames_.n_bodies() + corners_.rigid_of(face);
        const Vector<Dim>& centre = deforms ? watch.frames[body].centre : watch.places[corners_.rigid_of(face)].centre;
        watch.radius[body] = larger(watch.radius[body], (x[n] - centre).squaredNorm());
    }
    for (double& radius : watch.radius) radius = std::sqrt(radius);
    watch.moved = std::sqrt(largest(std::ssize(listed.nodes), [&](std::ptrdiff_t i) {
        return (x[listed.nodes[i]] - searched_at_[listed.nodes[i]]).squaredNorm();
    }));
    return watch;
}

#define ABUT_INSTANTIATE(Dim)                                                                                               \
    template double PairPotentialDriver<Dim>::motion_since(const Watch&, double, double) const;                             \
    template bool PairPotentialDriver<Dim>::is_valid(double, double, double) const;                                         \
    template bool PairPotentialDriver<Dim>::is_valid_within(double) const;                                                  \
    template double PairPotentialDriver<Dim>::moved_in_frame() const;                                                       \
    template bool PairPotentialDriver<Dim>::is_surely_valid(double, double);                                                \
    template bool PairPotentialDriver<Dim>::is_valid_by_cells(std::span<const Vector<Dim>>, double);                        \
    template double PairPotentialDriver<Dim>::distance_in_frame(const Listed&, std::span<const Vector<Dim>>, const Watch&); \
    template bool PairPotentialDriver<Dim>::is_valid_at_near_nodes(std::span<const Vector<Dim>>, double);                   \
    template typename PairPotentialDriver<Dim>::Watch PairPotentialDriver<Dim>::watch_from(                                 \
        const Listed&, std::span<const Vector<Dim>>, const Points&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
