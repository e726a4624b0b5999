#include "abut/run/watch/friction_watch.hpp"
#include "abut/dynamics/ledger.hpp"

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

template <class Part, class Visit>
void visit_part(Part& part, const Visit& visit) {
    visit(part.work), visit(part.seconds), visit(part.found), visit(part.limit);
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
void FrictionWatch<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, std::span<const solid::BodyImpulse<Dim>> pairs,
                                double speed) {
    stretched_ = std::max(stretched_, entry.friction_energy);
    if (records_++ % records_per_window != 0) return;
    end_window(pairs, entry.time - std::exchange(began_, entry.time), speed);
    if ((records_ / records_per_window) % windows_per_part == 0) end_part(entry.losses.by_friction);
}

template <int Dim>
void FrictionWatch<Dim>::end_window(std::span<const solid::BodyImpulse<Dim>> pairs, double seconds, double speed) {
    for (const solid::BodyImpulse<Dim>& now : pairs) {
        if (now.rubbing_impulse == 0.0) continue;
        Pair& pair = pairs_[{now.body_1, now.body_2}];
        const Vector<Dim> friction = now.friction - std::exchange(pair.friction, now.friction);
        const Vector<Dim> slip = now.slip - std::exchange(pair.slip, now.slip);
        const double normal = now.rubbing_impulse - std::exchange(pair.rubbing, now.rubbing_impulse);
        if (!(normal > 0.0)) continue;
        const Vector<Dim> velocity = slip / normal;  // of the second past the first
        const double limit = coefficient({now.body_1, now.body_2}) * normal;
        work_ += std::max(limit * velocity.norm(), std::abs(friction.dot(velocity)));
        if (!(velocity.norm() > sliding_speed * speed)) continue;
        pair.part_slip += slip;
        pair.part.work += limit * velocity.norm();
        pair.part.seconds += seconds;
        pair.part.found -= friction.dot(velocity) / velocity.norm();
        pair.part.limit += limit;
    }
}

template <int Dim>
void FrictionWatch<Dim>::end_part(double dissipated) {
    const double loss = dissipated - std::exchange(dissipated_, dissipated), work = std::exchange(work_, 0.0);
    // Faces that stick move as far as their springs do, which give back what they take; those that slide to and fro, as
    // teeth of gears, lose more than on their way in all.
    const bool slides_one_way = loss >= least_loss * work && loss <= most_loss * work;
    for (auto& [bodies, pair] : pairs_) {
        Part part = std::exchange(pair.part, {});
        if (part.limit == 0.0) continue;  // it has not slid
        const Vector<Dim> slip = std::exchange(pair.part_slip, Vector<Dim>::Zero());
        if (!(slip.dot(std::exchange(pair.last_slip, slip)) < 0.0)) part.work += pair.work;
        pair.work = part.work;
        if (slides_one_way && part.found < enough_friction * part.limit) pair.weak.push_back(part);
    }
}

template <int Dim>
WeakFriction FrictionWatch<Dim>::weakest() const {
    WeakFriction weakest;
    for (const auto& [bodies, pair] : pairs_) {
        Part sum{};
        for (const Part& part : pair.weak)
            if (part.work > work_of_springs * stretched_)
                sum.seconds += part.seconds, sum.found += part.found, sum.limit += part.limit;
        if (sum.seconds > weakest.seconds)
            weakest = {quoted_name(scene_, bodies[0]), quoted_name(scene_, bodies[1]), sum.seconds, sum.found / sum.limit};
    }
    return weakest;
}

template <int Dim>
template <class Self, class Visit>
void FrictionWatch<Dim>::for_each(Self& pair, const Visit& visit) {
    for (auto* vector : {&pair.friction, &pair.slip, &pair.part_slip, &pair.last_slip})
        for (auto& component : *vector) visit(component);
    visit(pair.rubbing), visit(pair.work);
    visit_part(pair.part, visit);
}

template <int Dim>
void FrictionWatch<Dim>::save(StateWriter& state) const {
    state.put(records_);
    state.put(began_);
    state.put(dissipated_);
    state.put(work_);
    state.put(stretched_);
    std::vector<std::int32_t> bodies;
    for (const auto& [both, pair] : pairs_) bodies.insert(bodies.end(), both.begin(), both.end());
    state.put_all(std::span<const std::int32_t>(bodies));
    for (const auto& [both, pair] : pairs_) {
        for_each(pair, [&](double value) { state.put(value); });
        std::vector<double> weak;
        for (const Part& part : pair.weak) visit_part(part, [&](double value) { weak.push_back(value); });
        state.put_all(std::span<const double>(weak));
    }
}

template <int Dim>
void FrictionWatch<Dim>::restore(StateReader& state) {
    records_ = state.get<std::int64_t>();
    began_ = state.get<double>();
    dissipated_ = state.get<double>();
    work_ = state.get<double>();
    stretched_ = state.get<double>();
    const auto bodies = state.get_all<std::int32_t>();
    pairs_.clear();
    for (std::size_t i = 0; i + 1 < bodies.size(); i += 2) {
        Pair& pair = pairs_[{bodies[i], bodies[i + 1]}];
        for_each(pair, [&](double& value) { value = state.get<double>(); });
        const auto weak = state.get_all<double>();
        for (auto next = weak.begin(); next != weak.end();)
            visit_part(pair.weak.emplace_back(), [&](double& value) { value = next != weak.end() ? *next++ : 0.0; });
    }
}

template class FrictionWatch<2>;
template class FrictionWatch<3>;

}  // namespace abut::run
