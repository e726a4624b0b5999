#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/solid/kinematics/body_frame.hpp"

namespace abut::solid {

/// Gradients p = dV/dx of some points of a body that do not belong to its system, as corners of faces, summed up.
template <int Dim>
struct BodyPush {
    Vector<Dim> gradient = Vector<Dim>::Zero();  ///< sum of p [N]
    Matrix<Dim> moment = Matrix<Dim>::Zero();    ///< sum of p (x - centre)^T, the arms being means of both ends [N m]
};

/// The frames of all bodies of a system of points, and the way of displacements into them and of gradients out of them.
/// Bodies whose frame does not move keep the displacements and gradients that they have. Every sum runs in a fixed order.
///
///     x' = x - centre,  X' = X - mean of X,  u = Q^T x' - X'
template <int Dim>
class BodyFrames {
public:
    using Frames = std::vector<BodyFrame<Dim>>;  ///< by body

    /// Points of body b are [begin[b], begin[b + 1]); `turns`: whether its frame moves. Arrays of points must outlive this.
    /// Throws BadInput for a body that turns in space while its points lie on a line, or in a point.
    BodyFrames(std::span<const Vector<Dim>> rest, std::span<const double> masses, std::vector<std::int32_t> begin,
               std::vector<bool> turns, std::span<const std::string> names);

    [[nodiscard]] std::size_t n_bodies() const { return turns_.size(); }
    [[nodiscard]] bool turns(std::size_t body) const { return turns_[body]; }
    /// Mass mean of X [m].
    [[nodiscard]] const Vector<Dim>& rest_centre(std::size_t body) const { return rest_[body].centre; }

    /// For displacements q (n_points) [m].
    void place(std::span<const Vector<Dim>> q, Frames& frames) const;
    /// u (n_points) [m].
    void displacement(std::span<const Vector<Dim>> q, const Frames& frames, std::span<Vector<Dim>> u) const;
    /// The mean of u at both ends of a step. No point moves farther in its frame than what is returned [m]; NaN if one does
    /// not move by a number.
    double take_midpoints(std::span<const Vector<Dim>> q_0, const Frames& frames_0, std::span<const Vector<Dim>> q_1,
                          const Frames& frames_1, std::span<Vector<Dim>> middle) const;

    /// dV/dx of the step, from dV/du (both n_points, in one array) and the pushes on each body [N]. Remembers what makes up
    /// for missing moments.
    void to_space(std::span<const Vector<Dim>> q_0, const Frames& frames_0, std::span<const Vector<Dim>> q_1,
                  const Frames& frames_1, std::span<const BodyPush<Dim>> pushes, std::span<Vector<Dim>> gradient);
    /// The same of one point, in one state, with what the last `to_space` remembers: but for terms of the order of a step.
    [[nodiscard]] Vector<Dim> point_to_space(std::int32_t point, const Frames& frames, const Vector<Dim>& gradient) const;

private:
    [[nodiscard]] Vector<Dim> rest_arm(std::int32_t point, std::size_t body) const {
        return rest_position_[static_cast<std::size_t>(point)] - rest_[body].centre;
    }
    /// u of a point that has moved by q.
    [[nodiscard]] Vector<Dim> in_frame(std::int32_t point, const BodyFrame<Dim>& frame, std::size_t body,
                                       const Vector<Dim>& q) const;
    /// Of the points of one body.
    template <class Value, class Term>
    Value sum(std::size_t body, const Value& zero, const Term& term) const;

    std::span<const Vector<Dim>> rest_position_;
    std::span<const double> masses_;
    std::vector<std::int32_t> begin_;
    std::vector<bool> turns_;
    std::vector<BodyFrame<Dim>> rest_;      // centre and moment at rest
    std::vector<double> mass_;              // of each body [kg]
    std::vector<std::size_t> body_;         // of each point
    std::vector<AxialVector<Dim>> lambda_;  // of each body, of the last step
};

}  // namespace abut::solid
