// How long the candidate list of bodies that may turn is valid: from bounds on the motion of each face, cheap ones first.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "abut/base/parallel.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/solid/contact/frame_motion.hpp"
#include "abut/solid/contact/near_faces.hpp"
#include "abut/solid/contact/pair_potential_driver.hpp"

namespace abut::solid {
namespace {

/// Skins that faces which are far from all other bodies may move before they must be placed again.
constexpr double far_skins = 4.0;
/// How far beyond what they must know of near and far faces look for others: skins, and what they may move. Those that are
/// farther from all others have the slack of these.
constexpr double near_looks = 4.0, far_looks = 4.0;

}  // namespace

template <int Dim>
FarthestMotion PairPotentialDriver<Dim>::near_allowed() const {
    return {0.5 * contact_.skin() / contact_.bevel_stretch(), std::numeric_limits<double>::infinity()};
}

/// Motion up to which what is far has not come near; and pairs of one body.
template <int Dim>
FarthestMotion PairPotentialDriver<Dim>::far_allowed() const {
    return {far_reach_, touches_itself_ ? near_allowed().in_space : std::numeric_limits<double>::infinity()};
}

/// Begins where the step of a search does, in q_0 and x_0, and goes on to its end.
template <int Dim>
void PairPotentialDriver<Dim>::begin(Watch& watch, const Listed& listed, std::span<const Vector<Dim>> q_0,
                                     double cell_motion, double time) {
    corners_.begin(watch.corners, listed, q_0, frames_.start(), x_0_);
    watch.corners.advance(frames_.end(), cell_motion);
    watch.from.clear();
    for (const std::vector<std::int32_t>* nodes : {&listed.rigid, &listed.obstacles})
        for (const std::int32_t n : *nodes) watch.from.push_back(x_0_[n]);
    watch.radius.assign(bodies_.rigid().size(), 0.0);
    for (const std::int32_t n : listed.rigid) {
        const std::size_t body = corners_.rigid_of(corners_.face_of(n));
        watch.radius[body] = larger(watch.radius[body], (x_1_[n] - corners_.rigid_places()[body].centre).norm());
    }
    place_given(watch, listed, time, x_1_);
}

/// Near faces are those that reach another body or obstacle when that grows by twice `far_reach_`, and by all that contact
/// itself looks ahead and reaches beyond faces.
template <int Dim>
void PairPotentialDriver<Dim>::begin_far(std::span<const Vector<Dim>> q_0, double cell_motion, double time) {
    far_reach_ = far_skins * contact_.skin();
    const contact::SurfaceView<Dim> facets = contact_.surface().facets().view();
    std::vector<std::int32_t> all(static_cast<std::size_t>(facets.size()));
    std::iota(all.begin(), all.end(), 0);
    const double motion = 2.0 * contact_.bevel_stretch() * far_reach_,
                 margin = motion + 2.0 * contact_.bevel_width() + contact_.skin() + 4.0 * deepest_;
    const std::vector<double> distances =
        distances_to_groups<Dim>(swept_boxes(all), facets.body, margin + far_looks * motion);
    near_facets_.clear();
    for (const std::int32_t facet : all)
        if (distances[static_cast<std::size_t>(facet)] <= margin) near_facets_.push_back(facet);
    near_ = corners_.list(nodes_of(near_facets_));
    begin(far_watch_, all_, q_0, cell_motion, time);
    far_watch_.corners.set_slack(slack_of(all_, all, distances, margin));
}

template <int Dim>
void PairPotentialDriver<Dim>::begin_near(std::span<const Vector<Dim>> q_0, double cell_motion, double time) {
    begin(near_watch_, near_, q_0, cell_motion, time);
    const double beyond = contact_.skin() + 2.0 * contact_.bevel_width();
    const std::vector<double> distances = distances_of_near(beyond + near_looks * contact_.skin());
    near_watch_.corners.set_slack(slack_of(near_, near_facets_, distances, beyond));
    find_placed();
}

/// How far each listed face may move beyond what all may, from the distances of facets: two faces may come nearer to each
/// other by their distance less `beyond`, and each of them has half of what it knows of that. Faces of one body have none.
template <int Dim>
std::vector<double> PairPotentialDriver<Dim>::slack_of(const Listed& listed, std::span<const std::int32_t> facets,
                                                       std::span<const double> distances, double beyond) const {
    std::vector<double> slack(listed.own.size(), 0.0);
    if (touches_itself_) return slack;
    std::ranges::fill(slack, std::numeric_limits<double>::infinity());
    std::size_t at = 0;  // facets and faces are in the same order
    for (std::size_t i = 0; i < facets.size(); ++i) {
        const auto face = static_cast<std::int32_t>(contact_.surface().face_of(contact::Facet{facets[i]}));
        while (at < slack.size() && listed.own[at] < face) ++at;
        if (at == slack.size()) break;
        if (listed.own[at] == face) slack[at] = std::min(slack[at], std::max(0.0, distances[i] - beyond));
    }
    for (double& of_face : slack) of_face /= 2.0 * contact_.bevel_stretch();
    return slack;
}

/// How much nearer each near facet may come to those of other bodies before they could meet, at most `most`.
template <int Dim>
std::vector<double> PairPotentialDriver<Dim>::distances_of_near(double most) const {
    const contact::SurfaceView<Dim> facets = contact_.surface().facets().view();
    const bool any_bevels = contact_.bevel_width() > 0.0;  // they have the depths of faces beside them
    std::vector<geometry::Box<Dim>> boxes = swept_boxes(near_facets_);
    std::vector<std::int32_t> bodies;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const std::int32_t facet = near_facets_[i];
        boxes[i] = boxes[i].grown(2.0 * (any_bevels ? deepest_ : facets.cell_depth[facet]));
        bodies.push_back(facets.body[facet]);
    }
    return distances_to_others<Dim>(boxes, bodies, most);
}

template <int Dim>
void PairPotentialDriver<Dim>::find_placed() {
    placed_.clear();
    auto at = near_.own.begin();
    for (const std::int32_t face : listed_.own) {
        at = std::lower_bound(at, near_.own.end(), face);
        if (at != near_.own.end() && *at == face)
            placed_.push_back({face, static_cast<std::int32_t>(at - near_.own.begin())});
    }
}

/// The listed faces are where the step ends.
template <int Dim>
void PairPotentialDriver<Dim>::set_placed_motion() {
    for (const auto& [face, near] : placed_)
        near_watch_.corners.set_in_space(near, corners_.motion(face, searched_at_, x_1_));
}

/// Nodes of rigid bodies and obstacles know where they are.
template <int Dim>
void PairPotentialDriver<Dim>::place_given(Watch& watch, const Listed& listed, double time, Points& x) const {
    watch.moved = given_distance(watch, listed, time, x);
    watch.places = corners_.rigid_places();
    watch.time = time;
}

template <int Dim>
double PairPotentialDriver<Dim>::given_distance(const Watch& watch, const Listed& listed, double time, Points& x) const {
    corners_.place_given(listed, time, x);
    double farthest = 0.0;
    const Vector<Dim>* from = watch.from.data();
    for (const std::vector<std::int32_t>* nodes : {&listed.rigid, &listed.obstacles})
        for (const std::int32_t n : *nodes) farthest = larger(farthest, (x[n] - *from++).norm());
    return farthest;
}

/// Motion of these by their loads, at most.
template <int Dim>
double PairPotentialDriver<Dim>::given_motion(const Watch& watch, double time) const {
    double of_rigid = 0.0;
    for (std::size_t i = 0; i < watch.places.size(); ++i) {
        const RigidPlace<Dim>&from = watch.places[i], to = corners_.rigid_places()[i];
        of_rigid = larger(of_rigid, (to.centre - from.centre).norm() + turned_by<Dim>(to.map - from.map) * watch.radius[i]);
    }
    return watch.moved + larger(of_rigid, obstacles_.motion(watch.time, time));
}

template <int Dim>
bool PairPotentialDriver<Dim>::is_within(Watch& watch, const FarthestMotion& allowed, double time) const {
    return watch.corners.is_within(allowed) && given_motion(watch, time) <= allowed.in_space;
}

template <int Dim>
bool PairPotentialDriver<Dim>::is_valid_until(std::span<const Vector<Dim>> q_1, double cell_motion, double time) {
    if (is_surely_valid(cell_motion, time)) return true;
    const Stopwatch watch(times_.search);
    return is_valid_by_cells(q_1, time);
}

/// By what no cell and no frame exceeds in the step.
template <int Dim>
bool PairPotentialDriver<Dim>::is_surely_valid(double cell_motion, double time) {
    if (faces_leave_cells()) return false;
    near_watch_.corners.advance(frames_.end(), cell_motion);
    far_watch_.corners.advance(frames_.end(), cell_motion);
    return has_stepped_ && contact_.is_valid_for(0.0) &&
           agree(is_within(near_watch_, near_allowed(), time) && is_within(far_watch_, far_allowed(), time));
}

/// By where the cells are at the end of the step, of the faces for which that was not enough.
template <int Dim>
bool PairPotentialDriver<Dim>::is_valid_by_cells(std::span<const Vector<Dim>> q_1, double time) {
    far_holds_ = false;
    if (!has_stepped_ || faces_leave_cells() || !contact_.is_valid_for(0.0)) return false;
    look(far_watch_, all_, far_allowed(), q_1, time);
    far_holds_ = agree(is_within(far_watch_, far_allowed(), time));
    if (!far_holds_) return false;
    look(near_watch_, near_, near_allowed(), q_1, time);
    place_beyond(q_1);
    return agree(is_within(near_watch_, near_allowed(), time));
}

template <int Dim>
void PairPotentialDriver<Dim>::look(Watch& watch, const Listed& listed, const FarthestMotion& allowed,
                                    std::span<const Vector<Dim>> q_1, double time) {
    if (!watch.corners.is_within(allowed)) watch.corners.look(watch.corners.beyond(allowed), q_1, frames_.end());
    if (!(given_motion(watch, time) <= allowed.in_space)) place_given(watch, listed, time, x_1_);
}

/// Places the near faces whose bounds say nothing, at the end of the step.
template <int Dim>
void PairPotentialDriver<Dim>::place_beyond(std::span<const Vector<Dim>> q_1) {
    if (near_watch_.corners.is_within(near_allowed())) return;
    const std::vector<std::int32_t> beyond = near_watch_.corners.beyond(near_allowed());
    std::vector<std::int32_t> faces;
    for (const std::int32_t i : beyond) faces.push_back(near_.own[i]);
    corners_.place_own(faces, q_1, frames_.end(), loads_.end(), x_1_, StepState::end);
    for (std::size_t i = 0; i < beyond.size(); ++i)
        near_watch_.corners.set_in_space(beyond[i], corners_.motion(faces[i], searched_at_, x_1_));
}

/// Places all nodes at the end of the step, where they move without their cells.
template <int Dim>
bool PairPotentialDriver<Dim>::is_valid_at_all_nodes(std::span<const Vector<Dim>> q_1, double time) {
    if (!has_stepped_ || !faces_leave_cells() || !contact_.is_valid_for(0.0)) return false;
    corners_.place(all_, q_1, frames_.end(), loads_.end(), time, x_1_, StepState::end);
    return contact_.is_valid_for(
        std::sqrt(largest(std::ssize(x_1_), [&](std::ptrdiff_t n) { return (x_1_[n] - searched_at_[n]).squaredNorm(); })));
}

/// Whether the faces that were near at the last search of all of them are all that can touch others until the end of the
/// step, and as long as the next list may live.
template <int Dim>
bool PairPotentialDriver<Dim>::may_search_near() const {
    return far_holds_ && !touches_itself_ && far_reach_ >= 2.0 * contact_.skin();
}

// States between steps -----------------------------------------------------------------------------------------------

/// Remembers where a step ends: all that the faces depend on there.
template <int Dim>
void PairPotentialDriver<Dim>::keep_end(std::span<const Vector<Dim>> q_1) {
    end_.clear();
    for (const std::int32_t cell : all_.region.input_cells) end_.push_back(q_1[cell]);
    const auto rigid_points = q_1.subspan(static_cast<std::size_t>(bodies_.n_cells()));
    end_.insert(end_.end(), rigid_points.begin(), rigid_points.end());
    end_frames_.assign(frames_.end().begin(), frames_.end().end());
}

/// Whether the faces are where the last step ended, to the bit.
template <int Dim>
bool PairPotentialDriver<Dim>::is_last_end(std::span<const Vector<Dim>> q, double time) const {
    if (!has_stepped_ || faces_leave_cells() || !contact_.is_valid_for(0.0) || time != end_time_) return false;
    const auto is_same_frame = [](const BodyFrame<Dim>& a, const BodyFrame<Dim>& b) {
        return a.centre == b.centre && a.turn == b.turn;
    };
    bool is_same = std::ranges::equal(frames_.end(), end_frames_, is_same_frame);
    const auto& cells = all_.region.input_cells;
    for (std::size_t i = 0; is_same && i < cells.size(); ++i) is_same = q[cells[i]] == end_[i];
    is_same = is_same && std::ranges::equal(q.subspan(static_cast<std::size_t>(bodies_.n_cells())),
                                            std::span(end_).subspan(cells.size()));
    return agree(is_same);
}

/// Whether the list is valid in any other state.
template <int Dim>
bool PairPotentialDriver<Dim>::is_valid_in(std::span<const Vector<Dim>> q, double time) {
    if (!has_stepped_ || faces_leave_cells() || !contact_.is_valid_for(0.0)) return false;
    const auto is_within = [&](Watch& watch, const Listed& listed, const FarthestMotion& allowed) {
        return watch.corners.until(q, frames_.end()).is_within(allowed) &&
               given_distance(watch, listed, time, x_state_) <= allowed.in_space;
    };
    return agree(is_within(near_watch_, near_, near_allowed()) && is_within(far_watch_, all_, far_allowed()));
}

#define ABUT_INSTANTIATE(Dim)                                                                                           \
    template void PairPotentialDriver<Dim>::begin(Watch&, const Listed&, std::span<const Vector<Dim>>, double, double); \
    template void PairPotentialDriver<Dim>::begin_far(std::span<const Vector<Dim>>, double, double);                    \
    template void PairPotentialDriver<Dim>::begin_near(std::span<const Vector<Dim>>, double, double);                   \
    template void PairPotentialDriver<Dim>::set_placed_motion();                                                        \
    template bool PairPotentialDriver<Dim>::is_valid_until(std::span<const Vector<Dim>>, double, double);               \
    template bool PairPotentialDriver<Dim>::is_valid_by_cells(std::span<const Vector<Dim>>, double);                    \
    template bool PairPotentialDriver<Dim>::is_valid_at_all_nodes(std::span<const Vector<Dim>>, double);                \
    template bool PairPotentialDriver<Dim>::may_search_near() const;                                                    \
    template void PairPotentialDriver<Dim>::keep_end(std::span<const Vector<Dim>>);                                     \
    template bool PairPotentialDriver<Dim>::is_last_end(std::span<const Vector<Dim>>, double) const;                    \
    template bool PairPotentialDriver<Dim>::is_valid_in(std::span<const Vector<Dim>>, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
