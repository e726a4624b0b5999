#include "abut/solid/kinematics/body_frames.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"

namespace abut::solid {
namespace {

constexpr double on_a_line = 1e-10;  // second moment across, over that along

/// Points that lie on a line have no rotation about it.
template <int Dim>
void require_width(const Matrix<Dim>& second_moment, const std::string& name) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Dim, Dim>> eigen(
        Eigen::Matrix<double, Dim, Dim>(second_moment), Eigen::EigenvaluesOnly);
    const double along = eigen.eigenvalues()[Dim - 1], across = eigen.eigenvalues()[Dim == 2 ? 1 : Dim - 2];
    if (along > 0.0 && across > on_a_line * along) return;
    throw BadInput("the centres of the cells of body '" + name +
                   "' lie on a line or in a point, so that how far it turns about that is not known. Refine its mesh, or "
                   "choose Kinematics::small or Kinematics::rigid for it.");
}

}  // namespace

template <int Dim>
BodyFrames<Dim>::BodyFrames(std::span<const Vector<Dim>> rest, std::span<const double> masses,
                            std::vector<std::int32_t> begin, std::vector<bool> turns, std::span<const std::string> names)
    : rest_position_(rest),
      masses_(masses),
      begin_(std::move(begin)),
      turns_(std::move(turns)),
      rest_(turns_.size()),
      lambda_(turns_.size(), AxialVector<Dim>::Zero()) {
    for (std::size_t body = 0; body < turns_.size(); ++body) {
        body_.resize(static_cast<std::size_t>(begin_[body + 1]), body);
        mass_.push_back(sum(body, 0.0, [&](std::int32_t i) { return masses_[i]; }));
        const Vector<Dim> origin = rest[begin_[body]];
        const Vector<Dim> moment = sum(body, Vector<Dim>(Vector<Dim>::Zero()), [&](std::int32_t i) -> Vector<Dim> {
            return masses_[i] * (rest_position_[i] - origin);
        });
        rest_[body].centre = origin + moment / mass_[body];
        rest_[body].moment = sum(body, Matrix<Dim>(Matrix<Dim>::Zero()), [&](std::int32_t i) -> Matrix<Dim> {
            return masses_[i] * rest_arm(i, body) * rest_arm(i, body).transpose();
        });
        if (turns_[body]) require_width<Dim>(rest_[body].moment, names[body]);
    }
}

template <int Dim>
template <class Value, class Term>
Value BodyFrames<Dim>::sum(std::size_t body, const Value& zero, const Term& term) const {
    const std::int32_t begin = begin_[body];
    return ordered_sum(begin_[body + 1] - begin, zero,
                       [&](std::ptrdiff_t i) -> Value { return term(begin + static_cast<std::int32_t>(i)); });
}

/// Displacements enter by their differences to that of the first point: a body far from where it began loses no digits.
template <int Dim>
void BodyFrames<Dim>::place(std::span<const Vector<Dim>> q, Frames& frames) const {
    frames = rest_;
    for (std::size_t body = 0; body < turns_.size(); ++body) {
        if (!turns_[body]) continue;
        using Sums = Eigen::Matrix<double, Dim, Dim + 1, Eigen::DontAlign>;  // of m d X'^T and m d
        const Vector<Dim> origin = q[begin_[body]];
        const Sums sums = sum(body, Sums(Sums::Zero()), [&](std::int32_t i) -> Sums {
            Sums term;
            term.template rightCols<1>() = masses_[i] * (q[i] - origin);
            term.template leftCols<Dim>() = term.template rightCols<1>() * rest_arm(i, body).transpose();
            return term;
        });
        frames[body].centre += origin + sums.template rightCols<1>() / mass_[body];
        frames[body].moment += sums.template leftCols<Dim>();
        frames[body].turn = nearest_rotation<Dim>(frames[body].moment);
    }
}

template <int Dim>
void BodyFrames<Dim>::displacement(std::span<const Vector<Dim>> q, const Frames& frames, std::span<Vector<Dim>> u) const {
    parallel_each(static_cast<std::ptrdiff_t>(q.size()), [&](std::ptrdiff_t at) {
        const auto i = static_cast<std::int32_t>(at);
        const std::size_t body = body_[i];
        u[i] = turns_[body] ? in_frame(i, frames[body], body, q[i]) : q[i];
    });
}

template <int Dim>
double BodyFrames<Dim>::take_midpoints(std::span<const Vector<Dim>> q_0, const Frames& frames_0,
                                       std::span<const Vector<Dim>> q_1, const Frames& frames_1,
                                       std::span<Vector<Dim>> middle) const {
    return std::sqrt(largest(static_cast<std::ptrdiff_t>(q_0.size()), [&](std::ptrdiff_t at) {
        const auto i = static_cast<std::int32_t>(at);
        const std::size_t body = body_[i];
        const Vector<Dim> u_0 = turns_[body] ? in_frame(i, frames_0[body], body, q_0[i]) : q_0[i];
        const Vector<Dim> u_1 = turns_[body] ? in_frame(i, frames_1[body], body, q_1[i]) : q_1[i];
        middle[i] = 0.5 * (u_0 + u_1);
        return (u_1 - u_0).squaredNorm();
    }));
}

template <int Dim>
void BodyFrames<Dim>::to_space(std::span<const Vector<Dim>> q_0, const Frames& frames_0, std::span<const Vector<Dim>> q_1,
                               const Frames& frames_1, std::span<const BodyPush<Dim>> pushes,
                               std::span<Vector<Dim>> gradient) {
    using Sums = Eigen::Matrix<double, Dim, Dim + 1, Eigen::DontAlign>;  // of f x'^T and f
    for (std::size_t body = 0; body < turns_.size(); ++body) {
        if (!turns_[body]) continue;
        const FrameStep<Dim> step(frames_0[body], frames_1[body]);
        const Matrix<Dim>& turn = step.mean_turn();
        const Vector<Dim> centre = 0.5 * (frames_0[body].centre + frames_1[body].centre);
        const Sums sums = sum(body, Sums(Sums::Zero()), [&](std::int32_t i) -> Sums {
            Sums term;
            term.template rightCols<1>() = gradient[i];
            term.template leftCols<Dim>() =
                gradient[i] * (rest_position_[i] + (0.5 * (q_0[i] + q_1[i]) - centre)).transpose();
            return term;
        });
        const Vector<Dim> missing = (pushes[body].gradient - turn * sums.template rightCols<1>()) / mass_[body];
        lambda_[body] = step.carry(axial<Dim>(pushes[body].moment - turn * sums.template leftCols<Dim>()));
        const Matrix<Dim> turning = hat<Dim>(lambda_[body]);
        parallel_each(begin_[body + 1] - begin_[body], [&](std::ptrdiff_t at) {
            const std::int32_t i = begin_[body] + static_cast<std::int32_t>(at);
            gradient[i] = turn * (gradient[i] + masses_[i] * (turning * rest_arm(i, body))) + masses_[i] * missing;
        });
    }
}

template <int Dim>
Vector<Dim> BodyFrames<Dim>::point_to_space(std::int32_t i, const Frames& frames, const Vector<Dim>& gradient) const {
    const std::size_t body = body_[i];
    if (!turns_[body]) return gradient;
    return frames[body].turn * (gradient + masses_[i] * (hat<Dim>(lambda_[body]) * rest_arm(i, body)));
}

template <int Dim>
Vector<Dim> BodyFrames<Dim>::in_frame(std::int32_t i, const BodyFrame<Dim>& frame, std::size_t body,
                                      const Vector<Dim>& q) const {
    const Vector<Dim> arm = rest_arm(i, body);
    return frame.turn.transpose() * (arm + (q - (frame.centre - rest_[body].centre))) - arm;
}

template class BodyFrames<2>;
template class BodyFrames<3>;

}  // namespace abut::solid
