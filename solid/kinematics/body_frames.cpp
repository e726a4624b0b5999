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
      any_turns_(std::ranges::find(turns_, true) != turns_.end()),
      rest_(turns_.size()),
      steps_(turns_.size()),
      lambda_(turns_.size(), AxialVector<Dim>::Zero()) {
    for (std::size_t body = 0; body < turns_.size(); ++body) {
        body_.resize(static_cast<std::size_t>(begin_[body + 1]), static_cast<std::int32_t>(body));
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
    start_ = end_ = state_ = rest_;
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
void BodyFrames<Dim>::place(std::span<const Vector<Dim>> q, std::vector<BodyFrame<Dim>>& frames) const {
    using Sums = Eigen::Matrix<double, Dim, Dim + 1, Eigen::DontAlign>;  // of m d X'^T and m d
    for (std::size_t body = 0; body < turns_.size(); ++body) {
        if (!turns_[body]) continue;
        const Vector<Dim> origin = q[begin_[body]];
        const Sums sums = sum(body, Sums(Sums::Zero()), [&](std::int32_t i) -> Sums {
            Sums term;
            const Vector<Dim> moved = masses_[i] * (q[i] - origin);
            term << moved * rest_arm(i, body).transpose(), moved;
            return term;
        });
        frames[body].centre = rest_[body].centre + origin + sums.template rightCols<1>() / mass_[body];
        frames[body].moment = rest_[body].moment + sums.template leftCols<Dim>();
        frames[body].turn = nearest_rotation<Dim>(frames[body].moment);
    }
}

template <int Dim>
void BodyFrames<Dim>::follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1) {
    is_standing_ = false;
    if (!any_turns_) return;
    if (std::exchange(has_stepped_, false))
        std::swap(start_, end_);
    else
        place(q_0, start_);
    place(q_1, end_);
    set_steps();
}

template <int Dim>
void BodyFrames<Dim>::stand_at(std::span<const Vector<Dim>> q) {
    is_standing_ = true;
    if (!any_turns_) return;
    place(q, state_);
    set_steps();
}

template <int Dim>
void BodyFrames<Dim>::stand_in(const std::vector<BodyFrame<Dim>>& frames) {
    is_standing_ = true;
    if (!any_turns_) return;
    state_ = frames;
    set_steps();
}

template <int Dim>
void BodyFrames<Dim>::set_steps() {
    for (std::size_t body = 0; body < turns_.size(); ++body)
        if (turns_[body]) steps_[body] = FrameStep<Dim>(start()[body], end()[body]);
}

template <int Dim>
void BodyFrames<Dim>::displacement(std::span<const std::int32_t> points, std::span<const Vector<Dim>> q,
                                   std::span<const BodyFrame<Dim>> frames, std::span<Vector<Dim>> u) const {
    parallel_each(static_cast<std::ptrdiff_t>(points.size()), [&](std::ptrdiff_t at) {
        const std::int32_t i = points[at];
        const std::int32_t body = body_[i];
        u[i] = in_frame(i, body, frames[body], q[i]);
    });
}

template <int Dim>
double BodyFrames<Dim>::take_midpoints(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                       std::span<Vector<Dim>> middle) const {
    return std::sqrt(largest(static_cast<std::ptrdiff_t>(q_0.size()), [&](std::ptrdiff_t at) {
        const auto i = static_cast<std::int32_t>(at);
        const std::int32_t body = body_[i];
        const Vector<Dim> u_0 = in_frame(i, body, start()[body], q_0[i]), u_1 = in_frame(i, body, end()[body], q_1[i]);
        middle[i] = 0.5 * (u_0 + u_1);
        return (u_1 - u_0).squaredNorm();
    }));
}

template <int Dim>
void BodyFrames<Dim>::to_space(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                               std::span<const BodyPush<Dim>> pushes, std::span<Vector<Dim>> gradient) {
    using Sums = Eigen::Matrix<double, Dim, Dim + 1, Eigen::DontAlign>;  // of f x'^T and f
    for (std::size_t body = 0; body < turns_.size(); ++body) {
        if (!turns_[body]) continue;
        const BodyPush<Dim> push = pushes.empty() ? BodyPush<Dim>{} : pushes[body];
        const Matrix<Dim>& turn = steps_[body].mean_turn();
        const Vector<Dim> centre = 0.5 * (start()[body].centre + end()[body].centre);
        const Sums sums = sum(body, Sums(Sums::Zero()), [&](std::int32_t i) -> Sums {
            Sums term;
            const Vector<Dim> arm = rest_position_[i] + (0.5 * (q_0[i] + q_1[i]) - centre);
            term << gradient[i] * arm.transpose(), gradient[i];
            return term;
        });
        const Vector<Dim> missing = (push.gradient - turn * sums.template rightCols<1>()) / mass_[body];
        lambda_[body] = steps_[body].carry(axial<Dim>(Matrix<Dim>(push.moment - turn * sums.template leftCols<Dim>())));
        const Matrix<Dim> turning = hat<Dim>(lambda_[body]);
        parallel_each(begin_[body + 1] - begin_[body], [&](std::ptrdiff_t at) {
            const std::int32_t i = begin_[body] + static_cast<std::int32_t>(at);
            gradient[i] = turn * (gradient[i] + masses_[i] * (turning * rest_arm(i, body))) + masses_[i] * missing;
        });
    }
}

template <int Dim>
Vector<Dim> BodyFrames<Dim>::point_to_space(std::int32_t i, const Vector<Dim>& gradient) const {
    const std::int32_t body = body_[i];
    if (!turns_[body]) return gradient;
    return end()[body].turn * (gradient + masses_[i] * (hat<Dim>(lambda_[body]) * rest_arm(i, body)));
}

template <int Dim>
Vector<Dim> BodyFrames<Dim>::in_frame(std::int32_t i, std::size_t body, const BodyFrame<Dim>& frame,
                                      const Vector<Dim>& q) const {
    if (!turns_[body]) return q;
    const Vector<Dim> arm = rest_arm(i, body);
    return frame.turn.transpose() * (arm + (q - (frame.centre - rest_[body].centre))) - arm;
}

template class BodyFrames<2>;
template class BodyFrames<3>;

}  // namespace abut::solid
