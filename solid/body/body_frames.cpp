#include "abut/solid/body/body_frames.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/rotation.hpp"
#include "abut/solid/part/rank_part.hpp"

#pragma GCC diagnostic ignored "-Wpsabi"  // registers are passed between functions of this file alone

namespace abut::solid {
namespace {

constexpr double on_a_line = 1e-10;  // second moment across, over that along

/// Points that lie on a line have no rotation about it.
template <int Dim>
void require_width(const Matrix<Dim>& second_moment, const std::string& name) {
    const Vector<Dim> moments = symmetric_eigenvalues(second_moment);
    const double along = moments[Dim - 1], across = moments[Dim == 2 ? 1 : Dim - 2];
    if (along > 0.0 && across > on_a_line * along) return;
    throw BadInput("the centres of the cells of body '" + name +
                   "' lie on a line or in a point, so that how far it turns about that is not known. Refine its mesh, or "
                   "choose Kinematics::small or Kinematics::rigid for it.");
}

Register4 load_four(const LargeArray<double>& values, std::ptrdiff_t i) {
    Register4 four;
    std::memcpy(&four, values.data() + 4 * i, sizeof four);
    return four;
}

/// Sums of a (x) (b, 1) over points: a row of four per component of a.
template <int Dim>
struct Moments {
    using Sums = SmallMatrix<Dim, Dim + 1>;
    std::array<Register4, Dim> row{};

    [[gnu::always_inline]] void add(const Lanes<Dim>& a, const Register4& b) {
        for (int k = 0; k < Dim; ++k) row[k] += a[k] * b;
    }
    Moments& operator+=(const Moments& other) {
        for (int k = 0; k < Dim; ++k) row[k] += other.row[k];
        return *this;
    }
    [[nodiscard]] Sums all() const {
        Sums sums;
        for (int k = 0; k < Dim; ++k)
            for (int j = 0; j <= Dim; ++j) sums(k, j) = row[k][j];
        return sums;
    }
};

/// Over points [begin, end), in blocks of fixed size: add(sum, point) adds what a point has.
template <int Dim, class Add>
typename Moments<Dim>::Sums sum_moments(std::int32_t begin, std::int32_t end, const Add& add) {
    const std::ptrdiff_t n_blocks = (end - begin + parallel_grain - 1) / parallel_grain;
    const auto sum_of_block = [&](std::ptrdiff_t block) {
        Moments<Dim> sum;
        const std::ptrdiff_t first = begin + block * parallel_grain;
        for (std::ptrdiff_t i = first; i < std::min<std::ptrdiff_t>(end, first + parallel_grain); ++i) add(sum, i);
        return sum;
    };
    if (n_blocks == 1) return sum_of_block(0).all();
    std::vector<Moments<Dim>> sums(static_cast<std::size_t>(n_blocks));
    parallel_each(
        n_blocks, [&](std::ptrdiff_t block) { sums[static_cast<std::size_t>(block)] = sum_of_block(block); }, 4);
    Moments<Dim> total;
    for (const Moments<Dim>& sum : sums) total += sum;
    return total.all();
}

/// Sums over the points of a body that ranks share out.
template <int Dim, class Add>
typename Moments<Dim>::Sums sum_moments(const RankPart<Dim>& part, std::size_t body, const Add& add) {
    using Sums = typename Moments<Dim>::Sums;
    return part.sum_of_body(body, Sums::Zero(), [&](std::int32_t i) {
        Moments<Dim> term;
        add(term, i);
        return term.all();
    });
}

/// (a, 1)
template <int Dim>
Register4 with_one(Lanes<Dim> a) {
    if constexpr (Dim == 2)
        return Register4{a[0], a[1], 1.0, 0.0};
    else
        return Register4{a[0], a[1], a[2], 1.0};
}

/// The larger of two values >= 0 by their bits, which keep the order of numbers with NaN above infinity: no branch.
double largest_bits(double a, double b) {
    return std::bit_cast<double>(std::max(std::bit_cast<std::int64_t>(a), std::bit_cast<std::int64_t>(b)));
}

}  // namespace

template <int Dim>
BodyFrames<Dim>::BodyFrames(std::span<const Vector<Dim>> rest, std::span<const double> masses,
                            std::vector<std::int32_t> begin, std::vector<bool> turns, std::span<const std::string> names,
                            const RankPart<Dim>& part)
    : rest_points_(rest),
      masses_(masses),
      part_(part),
      begin_(std::move(begin)),
      turns_(std::move(turns)),
      any_turns_(std::ranges::find(turns_, true) != turns_.end()),
      rest_(turns_.size()),
      steps_(turns_.size()),
      lambda_(turns_.size(), AxialVector<Dim>::Zero()) {
    arm_.resize(lane_width<Dim> * rest.size());
    weighted_arm_.resize(4 * rest.size());
    mass_.resize(turns_.size());
    own_mass_.resize(turns_.size());
    own_moment_.resize(turns_.size());
    for (std::size_t body = 0; body < turns_.size(); ++body)
        body_.resize(static_cast<std::size_t>(begin_[body + 1]), static_cast<std::int32_t>(body));
    std::vector<std::int32_t> alone(turns_.size());
    std::iota(alone.begin(), alone.end(), 0);
    unite(std::move(alone));
    for (std::size_t body = 0; body < turns_.size(); ++body)
        if (turns_[body]) require_width<Dim>(rest_[body].moment, names[body]);
}

template <int Dim>
void BodyFrames<Dim>::unite(std::vector<std::int32_t> first) {
    first_ = std::move(first);
    groups_.clear();
    std::vector<std::size_t> group_of(first_.size());
    for (std::size_t body = 0; body < first_.size(); ++body) {
        const auto leader = static_cast<std::size_t>(first_[body]);
        if (leader == body) {
            group_of[body] = groups_.size();
            groups_.emplace_back();
        }
        groups_[group_of[leader]].push_back(body);
    }
    set_rest();
    start_ = end_ = state_ = rest_;
    has_stepped_ = false;
}

template <int Dim>
void BodyFrames<Dim>::set_rest() {
    const std::vector<Vector<Dim>> origins = part_.of_first_cells(rest_points_);
    for (const std::vector<std::size_t>& group : groups_) {
        const Vector<Dim>& origin = origins[group.front()];
        double mass = 0.0;
        Vector<Dim> moment = Vector<Dim>::Zero();
        for (const std::size_t body : group) {
            own_mass_[body] = sum_of(body, 0.0, [&](std::ptrdiff_t i) { return masses_[i]; });
            own_moment_[body] = sum_of(body, Vector<Dim>::Zero(), [&](std::ptrdiff_t i) -> Vector<Dim> {
                return masses_[i] * (rest_points_[i] - origin);
            });
            mass += own_mass_[body];
            moment += own_moment_[body];
        }
        BodyFrame<Dim> frame;
        frame.centre = origin + moment / mass;
        frame.moment.setZero();
        for (const std::size_t body : group) {
            for (std::int32_t i = begin_[body]; i < begin_[body + 1]; ++i) {
                const Vector<Dim> arm = rest_points_[i] - frame.centre;
                store(load_packed<Dim>(arm), arm_, i);
                for (int k = 0; k < Dim; ++k) weighted_arm_[4 * i + k] = masses_[i] * arm[k];
                weighted_arm_[4 * i + Dim] = masses_[i];
            }
            frame.moment += sum_of(body, Matrix<Dim>::Zero(), [&](std::ptrdiff_t i) -> Matrix<Dim> {
                const Vector<Dim> arm = rest_points_[i] - frame.centre;
                return masses_[i] * arm * arm.transpose();
            });
        }
        for (const std::size_t body : group) {
            rest_[body] = frame;
            mass_[body] = mass;
            own_moment_[body] -= own_mass_[body] * (frame.centre - origin);
        }
    }
}

// Sums and loops over the points of a body ---------------------------------------------------------------------------

/// Sum of term(point) in blocks of fixed size, whatever ranks they are on.
template <int Dim>
template <class Value, class Term>
Value BodyFrames<Dim>::sum_of(std::size_t body, const Value& zero, const Term& term) const {
    return part_.sum_of_body(body, zero, term);
}

/// add(sum, point) adds what a point of these bodies has.
template <int Dim>
template <class Add>
auto BodyFrames<Dim>::moments(std::span<const std::size_t> group, const Add& add) const {
    const auto of_body = [&](std::size_t body) {
        return part_.is_whole() ? sum_moments<Dim>(begin_[body], begin_[body + 1], add) : sum_moments<Dim>(part_, body, add);
    };
    auto sums = of_body(group.front());
    for (const std::size_t body : group.subspan(1)) sums += of_body(body);
    return sums;
}

// Places of the frames -----------------------------------------------------------------------------------------------

/// Displacements enter by their differences to that of the first point: a body far from where it began loses no digits.
template <int Dim>
void BodyFrames<Dim>::place(std::span<const Vector<Dim>> q, std::vector<BodyFrame<Dim>>& frames) const {
    const std::vector<Vector<Dim>> origins = part_.of_first_cells(q);
    for (const std::vector<std::size_t>& group : groups_) {
        const std::size_t first = group.front();
        if (!turns_[first]) continue;
        const Lanes<Dim> origin = load_packed<Dim>(origins[first]);
        const auto sums = moments(group, [&](Moments<Dim>& sum, std::ptrdiff_t i) {
            sum.add(load_packed<Dim>(q[i]) - origin, load_four(weighted_arm_, i));
        });
        frames[first].centre = rest_[first].centre + origins[first] + sums.col(Dim) / mass_[first];
        frames[first].moment = rest_[first].moment + sums.template leftCols<Dim>();
        frames[first].turn = nearest_rotation(frames[first].moment);
        for (const std::size_t body : group) frames[body] = frames[first];
    }
}

template <int Dim>
std::vector<Matrix<Dim>> BodyFrames<Dim>::own_turns(std::span<const Vector<Dim>> q,
                                                    std::span<const std::size_t> bodies) const {
    std::vector<Matrix<Dim>> turns;
    for (const BodyFrame<Dim>& frame : end()) turns.push_back(frame.turn);
    const std::vector<Vector<Dim>> origins = part_.of_first_cells(q);
    for (const std::size_t body : bodies) {
        if (mass_[body] == own_mass_[body] || !turns_[body]) continue;
        const Lanes<Dim> origin = load_packed<Dim>(origins[body]);
        const auto sums = moments(std::span(&body, 1), [&](Moments<Dim>& sum, std::ptrdiff_t i) {
            sum.add(rest_arm(i) + load_packed<Dim>(q[i]) - origin, load_four(weighted_arm_, i));
        });
        const Matrix<Dim> about_own_centre =
            sums.template leftCols<Dim>() - sums.col(Dim) * own_moment_[body].transpose() / own_mass_[body];
        turns[body] = nearest_rotation(about_own_centre);
    }
    return turns;
}

template <int Dim>
void BodyFrames<Dim>::end_at(std::span<const Vector<Dim>> q) {
    is_standing_ = false;
    if (!any_turns_) return;
    place(q, end_);
    start_ = end_;
    set_steps();
    has_stepped_ = true;
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

/// u of points of one body, from how far they have moved.
template <int Dim>
class BodyFrames<Dim>::IntoFrame {
public:
    IntoFrame(const BodyFrames& frames, std::size_t body, const BodyFrame<Dim>& frame)
        : turns_(frames.turns_[body]),
          shift_(load_packed<Dim>(Vector<Dim>(frame.centre - frames.rest_[body].centre))),
          back_(load_packed<Dim>(Matrix<Dim>(frame.turn.transpose()))) {}

    [[nodiscard]] Lanes<Dim> operator()(const Vector<Dim>& q, Lanes<Dim> arm) const {
        const Lanes<Dim> moved = load_packed<Dim>(q);
        return turns_ ? back_ * (arm + (moved - shift_)) - arm : moved;
    }

private:
    bool turns_;
    Lanes<Dim> shift_;
    LaneTensor<Dim> back_;
};

template <int Dim>
void BodyFrames<Dim>::displacement(std::span<const std::int32_t> points, std::span<const Vector<Dim>> q,
                                   std::span<const BodyFrame<Dim>> frames, std::span<Vector<Dim>> u) const {
    std::vector<IntoFrame> into;
    for (std::size_t body = 0; body < turns_.size(); ++body) into.emplace_back(*this, body, frames[body]);
    parallel_each(static_cast<std::ptrdiff_t>(points.size()), [&](std::ptrdiff_t at) {
        const std::int32_t i = points[at];
        u[i] = unload<Dim>(into[body_[i]](q[i], rest_arm(i)));
    });
}

template <int Dim>
double BodyFrames<Dim>::take_midpoints(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                       LargeArray<double>& packed) const {
    double farthest = 0.0;
    for (std::size_t body = 0; body < turns_.size(); ++body) {
        const IntoFrame from(*this, body, start()[body]), to(*this, body, end()[body]);
        const std::int32_t begin = begin_[body], n = begin_[body + 1] - begin;
        const auto take_block = [&](std::ptrdiff_t block) {
            double square = 0.0;
            const std::ptrdiff_t first = begin + block * parallel_grain;
            for (std::ptrdiff_t i = first; i < std::min<std::ptrdiff_t>(begin + n, first + parallel_grain); ++i) {
                const Lanes<Dim> arm = rest_arm(i), u_0 = from(q_0[i], arm), u_1 = to(q_1[i], arm);
                store(0.5 * (u_0 + u_1), packed, i);
                square = largest_bits(square, dot(u_1 - u_0, u_1 - u_0));
            }
            return square;
        };
        farthest = larger(farthest, largest((n + parallel_grain - 1) / parallel_grain, take_block, 4));
    }
    return std::sqrt(part_.ranks().largest(farthest));
}

template <int Dim>
void BodyFrames<Dim>::to_force(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                               std::span<const BodyPush<Dim>> pushes, std::span<const Vector<Dim>> force,
                               std::span<Vector<Dim>> gradient) {
    for (const std::vector<std::size_t>& group : groups_) {
        const std::size_t first = group.front();
        if (!turns_[first]) {
            for (const std::size_t body : group)
                part_.each_cell_of_body(body, [&](std::ptrdiff_t i) {
                    gradient[i] = force.empty() ? Vector<Dim>(-gradient[i]) : Vector<Dim>(force[i] - gradient[i]);
                });
            continue;
        }
        BodyPush<Dim> push;
        for (const std::size_t body : group) {
            if (pushes.empty()) break;
            push.gradient += pushes[body].gradient;
            push.moment += pushes[body].moment;
        }
        const Matrix<Dim>& turn = steps_[first].mean_turn();
        const Vector<Dim> mean_centre = 0.5 * (start()[first].centre + this->end()[first].centre);
        const Lanes<Dim> shift = load_packed<Dim>(Vector<Dim>(mean_centre - rest_[first].centre));
        const auto sums = moments(group, [&](Moments<Dim>& sum, std::ptrdiff_t i) {
            const Lanes<Dim> moved = 0.5 * (load_packed<Dim>(q_0[i]) + load_packed<Dim>(q_1[i])) - shift;
            sum.add(load_packed<Dim>(gradient[i]), with_one(rest_arm(i) + moved));
        });
        const AxialVector<Dim> lambda =
            steps_[first].carry(axial<Dim>(Matrix<Dim>(push.moment - turn * sums.template leftCols<Dim>())));
        // dV/dx = turn f + (turn hat(lambda)) m X' + m missing
        const LaneTensor<Dim> turning = load_packed<Dim>(turn);
        const LaneTensor<Dim> carrying = load_packed<Dim>(Matrix<Dim>(turn * hat<Dim>(lambda)));
        const Lanes<Dim> missing = load_packed<Dim>(Vector<Dim>((push.gradient - turn * sums.col(Dim)) / mass_[first]));
        for (const std::size_t body : group) {
            lambda_[body] = lambda;
            part_.each_cell_of_body(body, [&](std::ptrdiff_t i) {
                const Register4 weighted = load_four(weighted_arm_, i);
                Lanes<Dim> sum = turning * load_packed<Dim>(gradient[i]) + weighted[Dim] * missing;
                for (int k = 0; k < Dim; ++k) sum += weighted[k] * carrying.col[k];
                gradient[i] = unload<Dim>(force.empty() ? -sum : load_packed<Dim>(force[i]) - sum);
            });
        }
    }
}

template <int Dim>
Vector<Dim> BodyFrames<Dim>::point_to_space(std::int32_t i, const Vector<Dim>& gradient) const {
    const std::int32_t body = body_[i];
    if (!turns_[body]) return gradient;
    const double mass = weighted_arm_[4 * static_cast<std::size_t>(i) + Dim];
    return end()[body].turn * (gradient + mass * (hat<Dim>(lambda_[body]) * unload<Dim>(rest_arm(i))));
}

template class BodyFrames<2>;
template class BodyFrames<3>;

}  // namespace abut::solid
