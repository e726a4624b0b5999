#include "abut/run/friction_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "abut/run/body_names.hpp"

namespace abut::run {
namespace {

/// The least mu that a law gives; 0 where bodies creep, or where a user's own function gives it.
double least_coefficient(const contact::Friction& law) {
    if (!law.acts() || law.own_coefficient || std::isfinite(law.relaxation_time)) return 0.0;
    return std::isnan(law.sliding_coefficient) ? law.coefficient : std::min(law.coefficient, law.sliding_coefficient);
}

}  // namespace

template <int Dim>
double FrictionWatch<Dim>::coefficient(Bodies bodies) const {
    const auto n_sides = scene_.mesh.n_bodies() + static_cast<std::int32_t>(scene_.solid.obstacles.size());
    double least = least_coefficient(options_.friction), of_groups = std::numeric_limits<double>::infinity();
    for (const auto& [sides, law] : scene_.solid.body_friction) {
        if (std::ranges::any_of(sides, [&](std::int32_t side) { return side >= n_sides; }))
            of_groups = std::min(of_groups, least_coefficient(law));  // on some of the faces of some body
        else if (std::ranges::is_permutation(sides, bodies))
            least = least_coefficient(law);
    }
    return std::min(least, of_groups);
}

template <int Dim>
void FrictionWatch<Dim>::record(double time, std::span<const solid::BodyImpulse<Dim>> pairs, double dissipated,
                                double speed) {
    if (records_++ % records_per_part != 0) return;
    struct Part {
        Pair* pair;
        double seconds, found, limit;
    };
    std::vector<Part> weak;
    double work = 0.0;
    for (const solid::BodyImpulse<Dim>& now : pairs) {
        if (now.rubbing_impulse == 0.0) continue;
        Pair& pair = pairs_[{now.body_1, now.body_2}];
        const Vector<Dim> friction = now.friction - pair.friction, slip = now.slip - pair.slip;
        const double normal = now.rubbing_impulse - pair.rubbing;
        pair.friction = now.friction, pair.slip = now.slip, pair.rubbing = now.rubbing_impulse;
        if (!(normal > 0.0)) continue;
        const Vector<Dim> velocity = slip / normal;  // of the second past the first
        work += std::abs(friction.dot(velocity));
        const double limit = coefficient({now.body_1, now.body_2}) * normal;
        const double found = -friction.dot(velocity) / velocity.norm();
        if (velocity.norm() > sliding_speed * speed && limit > 0.0 && found < enough_friction * limit)
            weak.push_back({&pair, time - began_, found, limit});
    }
    // Springs of faces that stick give back what they take.
    if (dissipated - dissipated_ >= 0.5 * work)
        for (const auto& [pair, seconds, found, limit] : weak)
            pair->seconds += seconds, pair->found += found, pair->limit += limit;
    began_ = time;
    dissipated_ = dissipated;
}

template <int Dim>
WeakFriction FrictionWatch<Dim>::weakest() const {
    WeakFriction weakest;
    for (const auto& [bodies, pair] : pairs_)
        if (pair.seconds > weakest.seconds)
            weakest = {quoted_name(scene_, bodies[0]), quoted_name(scene_, bodies[1]), pair.seconds,
                       pair.found / pair.limit};
    return weakest;
}

template <int Dim>
template <class Self, class Visit>
void FrictionWatch<Dim>::for_each(Self& pair, const Visit& visit) {
    for (auto& component : pair.friction) visit(component);
    for (auto& component : pair.slip) visit(component);
    visit(pair.rubbing), visit(pair.seconds), visit(pair.found), visit(pair.limit);
}

template <int Dim>
void FrictionWatch<Dim>::save(StateWriter& state) const {
    state.put(records_);
    state.put(began_);
    state.put(dissipated_);
    std::vector<std::int32_t> bodies;
    for (const auto& [both, pair] : pairs_) bodies.insert(bodies.end(), both.begin(), both.end());
    state.put_all(std::span<const std::int32_t>(bodies));
    for (const auto& [both, pair] : pairs_) for_each(pair, [&](double value) { state.put(value); });
}

template <int Dim>
void FrictionWatch<Dim>::restore(StateReader& state) {
    records_ = state.get<std::int64_t>();
    began_ = state.get<double>();
    dissipated_ = state.get<double>();
    const auto bodies = state.get_all<std::int32_t>();
    pairs_.clear();
    for (std::size_t i = 0; i + 1 < bodies.size(); i += 2)
        for_each(pairs_[{bodies[i], bodies[i + 1]}], [&](double& value) { value = state.get<double>(); });
}

template class FrictionWatch<2>;
template class FrictionWatch<3>;

}  // namespace abut::run
