#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/solid/body/body_frame.hpp"
#include "abut/solid/operator/lanes.hpp"

namespace abut::solid {

template <int Dim>
class RankPart;

/// Gradients p = dV/dx of points of a body that move with the points of its system, as corners of faces do, summed up.
template <int Dim>
struct BodyPush {
    Vector<Dim> gradient = Vector<Dim>::Zero();  ///< sum of p [N]
    Matrix<Dim> moment = Matrix<Dim>::Zero();    ///< sum of p (x - centre)^T, the arms being means of both ends [N m]

    void add(const Vector<Dim>& p, const Vector<Dim>& mean_arm) {
        gradient += p;
        moment += p * mean_arm.transpose();
    }
};

/// The frames of all bodies of a system of points along a step or in one state, and the way of displacements into them
/// and of gradients out of them. Bodies whose frame does not move keep the displacements and gradients that they have.
/// Every sum runs in a fixed order.
///
///     x' = x - centre,  X' = X - mean of X,  u = Q^T x' - X'
template <int Dim>
class BodyFrames {
public:
    /// Points of body b are [begin[b], begin[b + 1]); `turns`: whether its frame moves. Throws BadInput for a body
    /// that turns in space while its points lie on a line, or in a point. `part`: of whose cells these points are. It,
    /// `rest` and `masses` must outlive this. All that places frames, `take_midpoints` and `to_force` are calls of all
    /// ranks, and only the gradients of own cells become forces.
    BodyFrames(std::span<const Vector<Dim>> rest, std::span<const double> masses, std::vector<std::int32_t> begin,
               std::vector<bool> turns, std::span<const std::string> names, const RankPart<Dim>& part);

    /// From now on bodies with the same number in `first`, that of the first of them, have one frame (n_bodies): all of them
    /// turn or none does. The values of each are those of all. Bodies are at rest until they are placed.
    void unite(std::vector<std::int32_t> first);
    /// Number of the first body with the same frame, of each.
    [[nodiscard]] const std::vector<std::int32_t>& united() const { return first_; }

    [[nodiscard]] std::size_t n_bodies() const { return turns_.size(); }
    [[nodiscard]] bool any() const { return any_turns_; }  ///< whether a body has a frame that turns
    /// Mass mean of X [m].
    [[nodiscard]] const Vector<Dim>& rest_centre(std::size_t body) const { return rest_[body].centre; }

    // Where the bodies are: each replaces what the other has set.

    /// Along a step from q_0 to q_1 (n_points) [m]; where one has ended before, it is taken that this one begins there.
    void follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1);
    /// The next step begins where this one ends.
    void end_step() { has_stepped_ = true; }
    /// A step has ended at q.
    void end_at(std::span<const Vector<Dim>> q);
    /// In one state, which is both ends.
    void stand_at(std::span<const Vector<Dim>> q);
    /// In that at an end of the last `follow`.
    void stand_at_start() { stand_in(start_); }
    void stand_at_end() { stand_in(end_); }
    [[nodiscard]] std::span<const BodyFrame<Dim>> start() const { return is_standing_ ? state_ : start_; }
    [[nodiscard]] std::span<const BodyFrame<Dim>> end() const { return is_standing_ ? state_ : end_; }
    [[nodiscard]] const FrameStep<Dim>& step(std::size_t body) const { return steps_[body]; }

    /// The rotation of some bodies by themselves: the nearest one of their own points at q (n_points) [m]; that of the frame
    /// where one is alone in it, and of all others (n_bodies). A call of all ranks.
    [[nodiscard]] std::vector<Matrix<Dim>> own_turns(std::span<const Vector<Dim>> q,
                                                     std::span<const std::size_t> bodies) const;

    // There

    /// u in some frames, as `start` or `end`, of some points; `u` has place for all (n_points) [m].
    void displacement(std::span<const std::int32_t> points, std::span<const Vector<Dim>> q,
                      std::span<const BodyFrame<Dim>> frames, std::span<Vector<Dim>> u) const;
    /// The mean of u at both ends, packed: lane_width numbers per point [m]. No point moves farther in its frame than
    /// what is returned [m]; NaN if one does not move by a number.
    double take_midpoints(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                          LargeArray<double>& packed) const;
    /// `force` less dV/dx, from dV/du (all n_points) and the pushes on each body [N]; without pushes or force: none. The
    /// result takes the place of the gradient. Remembers what makes up for missing moments.
    void to_force(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, std::span<const BodyPush<Dim>> pushes,
                  std::span<const Vector<Dim>> force, std::span<Vector<Dim>> gradient);
    /// dV/dx of one point in one state, with what the last `to_force` remembers, except for terms of the order of a step.
    [[nodiscard]] Vector<Dim> point_to_space(std::int32_t point, const Vector<Dim>& gradient) const;

private:
    void place(std::span<const Vector<Dim>> q, std::vector<BodyFrame<Dim>>& frames) const;
    void stand_in(const std::vector<BodyFrame<Dim>>& frames);
    void set_steps();
    void set_rest();
    template <class Value, class Term>
    [[nodiscard]] Value sum_of(std::size_t body, const Value& zero, const Term& term) const;
    template <class Add>
    [[nodiscard]] auto moments(std::span<const std::size_t> group, const Add& add) const;
    [[nodiscard]] Lanes<Dim> rest_arm(std::ptrdiff_t point) const { return load_packed<Dim>(arm_, point); }
    class IntoFrame;

    LargeArray<double> arm_;           // X', packed, by point
    LargeArray<double> weighted_arm_;  // (m X', m), four numbers per point
    std::span<const Vector<Dim>> rest_points_;
    std::span<const double> masses_;
    const RankPart<Dim>& part_;
    std::vector<std::int32_t> begin_;
    std::vector<bool> turns_;
    bool any_turns_ = false;
    std::vector<std::int32_t> first_;               // body with the same frame, of each
    std::vector<std::vector<std::size_t>> groups_;  // bodies with one frame, in the order of the first ones
    std::vector<BodyFrame<Dim>> rest_;
    LargeArray<double> mass_;              // of all with the frame of each body [kg]
    std::vector<double> own_mass_;         // of each body alone [kg]
    std::vector<Vector<Dim>> own_moment_;  // sum of m X' over the points of each body [kg m]
    std::vector<std::int32_t> body_;       // of each point
    std::vector<BodyFrame<Dim>> start_, end_, state_;
    std::vector<FrameStep<Dim>> steps_;
    std::vector<AxialVector<Dim>> lambda_;  // of each body, in the last `to_force`
    bool has_stepped_ = false;
    bool is_standing_ = false;
};

}  // namespace abut::solid
