#include "abut/dynamics/neutral_restart.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/dynamics/angular_velocity.hpp"
#include "abut/dynamics/sum_over.hpp"

namespace abut::dynamics {
namespace {

constexpr double rounding = 1e-12;  // |e| over the momenta that it is a difference of: there is nothing to take
constexpr int most_halvings = 20;
constexpr double least_scale = 0.25, largest_scale = 1.21;  // of sigma^2
constexpr double lost_moment = 1e-13;  // of angular momentum, that a body without inertia about an axis cannot carry

template <int Dim>
Inertia<Dim> inertia_of(double mass, const Vector<Dim>& arm) {
    if constexpr (Dim == 3)
        return mass * (arm.squaredNorm() * Inertia<3>::Identity() - arm * arm.transpose());
    else
        return Inertia<Dim>::Constant(mass * arm.squaredNorm());
}

/// Momenta of one body at the node. Products are those of M^-1.
template <int Dim>
class BodyAtNode {
public:
    BodyAtNode(const detail::BodyPoints& body, const detail::NodeView<Dim>& node)
        : points_(body.points), among_all_(body.among_all), node_(node) {
        mass_ = sum(0.0, [&](std::int32_t i) { return node_.mass[i]; });
        momentum_ = sum(zero_vector, [&](std::int32_t i) { return p(i); });
        f_e_ = product([&](std::int32_t i) { return f(i); }, [&](std::int32_t i) { return e(i); });
        e_e_ = square([&](std::int32_t i) { return e(i); });
        p_p_ = square([&](std::int32_t i) { return p(i); });
        if (node_.arms == MomentArms::mid_step)
            e_moment_ = sum(zero_moment, [&](std::int32_t i) -> AngularMomentum<Dim> {
                return 0.25 * node_.dt / node_.mass[i] * moment<Dim>(e(i), p(i));
            });
    }

    [[nodiscard]] bool has_e() const {
        const double size = p_p_ + square([&](std::int32_t i) { return f(i); }) + e_e_;
        return e_e_ > rounding * rounding * size;
    }

    /// Splits p for a part theta of e to be taken out; whether that can be paid.
    bool split(double theta) {
        theta_ = theta;
        centre_ = sum(zero_vector, [&](std::int32_t i) -> Vector<Dim> { return node_.mass[i] * arm(i); }) / mass_;
        const Inertia<Dim> inertia = sum(Inertia<Dim>(Inertia<Dim>::Zero()), [&](std::int32_t i) -> Inertia<Dim> {
            return inertia_of<Dim>(node_.mass[i], arm(i) - centre_);
        });
        const AngularMomentum<Dim> own =
            sum(zero_moment, [&](std::int32_t i) { return moment<Dim>(arm(i) - centre_, p(i)); });
        // J~ was about the arms with all of e in them.
        const AngularMomentum<Dim> carried = own + theta * e_moment_;
        own_ = angular_velocity<Dim>(inertia, own);
        carried_ = angular_velocity<Dim>(inertia, carried);
        if ((inertia * carried_ - carried).norm() > lost_moment * std::sqrt(inertia.trace() * p_p_)) return false;
        vibration_ = 0.5 * square([&](std::int32_t i) { return k(i); });
        const double gained =
            0.5 * (own_.dot(own) - carried_.dot(carried)) - theta * (f_e_ + e_e_) / 4.0 + theta * theta * e_e_ / 8.0;
        scale_ = 1.0 + gained / vibration_;
        return scale_ >= least_scale && scale_ <= largest_scale;  // no vibration: not a number, or infinite
    }

    void write() const {
        const double sigma = std::sqrt(scale_);
        parallel_each(std::ssize(points_), [&](std::ptrdiff_t at) {
            const std::int32_t i = points_[at];
            const Vector<Dim> mean = rigid(i, carried_) + sigma * k(i), half = 0.5 * (f(i) + (1.0 - theta_) * e(i));
            node_.p_before[i] = mean - half;
            node_.p_after[i] = mean + half;
        });
    }
    [[nodiscard]] double paid() const { return (1.0 - scale_) * vibration_; }

private:
    static inline const Vector<Dim> zero_vector = Vector<Dim>::Zero();
    static inline const AngularMomentum<Dim> zero_moment = AngularMomentum<Dim>::Zero();

    template <class Value, class Term>
    Value sum(const Value& zero, const Term& term) const {
        const auto of_point = [&](std::ptrdiff_t at) -> Value { return term(points_[at]); };
        return sum_over(node_.ranks, among_all_, std::ssize(points_), zero, of_point);
    }
    template <class A, class B>
    double product(const A& a, const B& b) const {
        return sum(0.0, [&](std::int32_t i) { return a(i).dot(b(i)) / node_.mass[i]; });
    }
    template <class A>
    double square(const A& a) const {
        return sum(0.0, [&](std::int32_t i) { return a(i).squaredNorm() / node_.mass[i]; });
    }

    Vector<Dim> p(std::int32_t i) const { return 0.5 * (node_.p_before[i] + node_.p_after[i]); }
    Vector<Dim> f(std::int32_t i) const { return node_.dt * node_.force[i]; }
    Vector<Dim> e(std::int32_t i) const { return node_.p_after[i] - node_.p_before[i] - f(i); }
    Vector<Dim> arm(std::int32_t i) const {
        if (node_.arms == MomentArms::rest) return node_.rest_position[i];
        const Vector<Dim> difference = f(i) + (1.0 - theta_) * e(i);
        return node_.rest_position[i] + node_.q[i] + (0.25 * node_.dt / node_.mass[i]) * difference;
    }
    Vector<Dim> rigid(std::int32_t i, const AngularMomentum<Dim>& omega) const {
        return node_.mass[i] * (momentum_ / mass_ + turning_velocity<Dim>(omega, arm(i) - centre_));
    }
    Vector<Dim> k(std::int32_t i) const { return p(i) - rigid(i, own_); }

    std::span<const std::int32_t> points_;
    Summands among_all_;
    const detail::NodeView<Dim>& node_;
    double mass_, f_e_, e_e_, p_p_;
    Vector<Dim> momentum_;
    AngularMomentum<Dim> e_moment_ = AngularMomentum<Dim>::Zero();  // that e adds to J~ through the arms
    double theta_ = 1.0;
    Vector<Dim> centre_;                    // mass mean of the arms
    AngularMomentum<Dim> own_, carried_;    // angular velocities of the rigid part of p, and of that after the restart
    double vibration_ = 0.0, scale_ = 1.0;  // E_k, sigma^2
};

}  // namespace

detail::PointsOfBodies::PointsOfBodies(std::span<const std::int32_t> body_of_points, std::size_t n, const Ranks& ranks) {
    double last = -1.0;  // body that has points here
    agreed(ranks, [&] {
        const auto [lowest, highest] = std::ranges::minmax_element(body_of_points);
        if (body_of_points.size() != n || (n > 0 && *lowest < 0))
            throw BadInput("restart: " + std::to_string(body_of_points.size()) +
                           " points have a body, the lowest of which is " +
                           std::to_string(n > 0 && !body_of_points.empty() ? *lowest : 0) + ", the system has " +
                           std::to_string(n) + " points. Give the body of each, counted from 0.");
        if (n > 0) last = *highest;
    });
    const auto n_bodies = static_cast<std::size_t>(ranks.largest(last) + 1.0);
    const auto body_of = [&](std::int32_t i) {
        return static_cast<std::size_t>(body_of_points[static_cast<std::size_t>(i)]);
    };
    points_.resize(n);
    std::iota(points_.begin(), points_.end(), 0);
    std::ranges::stable_sort(points_, {}, body_of);
    for (std::size_t body = 0; body <= n_bodies; ++body)
        offset_.push_back(static_cast<std::size_t>(std::ranges::lower_bound(points_, body, {}, body_of) - points_.begin()));
    if (!ranks.is_one()) find_among_all(ranks);
}

void detail::PointsOfBodies::find_among_all(const Ranks& ranks) {
    std::vector<double> here;  // of each body its points and the least of their numbers
    for (std::size_t body = 0; body < n_bodies(); ++body) {
        const auto points = (*this)[body].points;
        here.push_back(static_cast<double>(points.size()));
        here.push_back(points.empty() ? 0.0 : ranks.numbers()[static_cast<std::size_t>(points.front())]);
    }
    const std::vector<double> of_ranks = ranks.gather(here);
    among_all_.assign(n_bodies(), Summands{.first = 0, .last = 0});
    for (std::size_t i = 0; i < of_ranks.size(); i += 2) {
        if (of_ranks[i] == 0.0) continue;
        Summands& of_body = among_all_[i / 2 % n_bodies()];
        const auto count = static_cast<std::int32_t>(of_ranks[i]), least = static_cast<std::int32_t>(of_ranks[i + 1]);
        const std::int32_t before = of_body.last - of_body.first;
        of_body.first = before == 0 ? least : std::min(of_body.first, least);
        of_body.last = of_body.first + before + count;
    }
    agreed(ranks, [&] {
        for (std::size_t body = 0; body < n_bodies(); ++body)
            for (const std::int32_t point : (*this)[body].points) {
                const std::int32_t number = ranks.numbers()[static_cast<std::size_t>(point)];
                if (number < among_all_[body].first || number >= among_all_[body].last)
                    throw BadInput("restart: point " + std::to_string(number) + " of body " + std::to_string(body) +
                                       " does not follow the others of its body. On several ranks, number the points body "
                                       "by body.",
                                   {.value = static_cast<double>(number)});
            }
    });
}

void detail::check_restart(const RestartOptions& options) {
    if (options.period < 1)
        throw BadInput("restart: every " + std::to_string(options.period) + " steps; give 1 or more, 50 is the default.",
                       {.value = static_cast<double>(options.period), .allowed = 1.0});
    if (options.steps_before < 0)
        throw BadInput("restart: " + std::to_string(options.steps_before) +
                           " steps were taken before; give the steps of the saved run, 0 for a new one.",
                       {.value = static_cast<double>(options.steps_before), .allowed = 0.0});
}

template <int Dim>
void detail::restart_body(const BodyPoints& points, const NodeView<Dim>& node, RestartReport& report) {
    BodyAtNode<Dim> body(points, node);
    if (!body.has_e()) return;
    double theta = 1.0;
    int halvings = 0;
    for (; !body.split(theta); theta *= 0.5)
        if (++halvings == most_halvings) {
            ++report.skipped;
            return;
        }
    if (halvings > 0) ++report.shortened;
    body.write();
    report.paid += body.paid();
}

template void detail::restart_body<1>(const BodyPoints&, const NodeView<1>&, RestartReport&);
template void detail::restart_body<2>(const BodyPoints&, const NodeView<2>&, RestartReport&);
template void detail::restart_body<3>(const BodyPoints&, const NodeView<3>&, RestartReport&);

}  // namespace abut::dynamics
