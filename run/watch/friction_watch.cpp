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

template class FrictionWatch<2>;
template class FrictionWatch<3>;

}  // namespace abut::run
