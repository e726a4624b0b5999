#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "abut/contact/step.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::solid {

/// Sums of what bodies do to each other, by pair.
template <int Dim>
class ContactImpulses {
public:
    /// Body 1 pushes body 2 with this impulse [N s].
    void add(std::int32_t body_1, std::int32_t body_2, const Vector<Dim>& impulse, double normal_impulse) {
        const double sign = body_1 > body_2 ? -1.0 : 1.0;
        BodyImpulse<Dim>& pair = between(body_1, body_2);
        pair.impulse += sign * impulse;
        pair.normal_impulse += normal_impulse;
    }
    /// A pair of faces of these bodies, in the order of the pair, rubs for `dt` [s]: the part of `add` that is friction.
    void add_friction(std::int32_t body_1, std::int32_t body_2, const contact::PairStep<Dim>& of_faces, double dt) {
        if (of_faces.friction == Vector<Dim>::Zero() && of_faces.slip == Vector<Dim>::Zero()) return;
        const double sign = body_1 > body_2 ? -1.0 : 1.0;
        BodyImpulse<Dim>& pair = between(body_1, body_2);
        pair.friction += (sign * dt) * of_faces.friction;
        pair.rubbing_impulse += dt * of_faces.normal_force;
        pair.slip += (sign * of_faces.normal_force) * of_faces.slip;
    }
    /// Pairs of faces of a step, some of which are pressed in by more than `warning` times D.
    template <class BodyOf>
    void add_compression(std::span<const contact::PairStep<Dim>> pairs, const BodyOf& body_of, double warning) {
        std::map<std::array<std::int32_t, 2>, std::vector<const contact::PairStep<Dim>*>> of_bodies;
        for (const contact::PairStep<Dim>& pair : pairs) {
            const auto [body_1, body_2] = std::minmax({body_of(pair.face_1), body_of(pair.face_2)});
            of_bodies[{body_1, body_2}].push_back(&pair);
        }
        for (auto& [bodies, of_both] : of_bodies) {
            const double compression = bearing_compression(of_both);
            if (!(compression > warning)) continue;
            BodyImpulse<Dim>& pair = between(bodies[0], bodies[1]);
            pair.compression = std::max(pair.compression, compression);
            ++pair.compressed_steps;
        }
    }
    [[nodiscard]] std::span<const BodyImpulse<Dim>> pairs() const { return pairs_; }
    void restore(std::vector<BodyImpulse<Dim>> pairs) { pairs_ = std::move(pairs); }

private:
    /// The |g|/D that pairs with `bearing_share` of the normal force reach. Sorts `pairs`.
    [[nodiscard]] static double bearing_compression(std::vector<const contact::PairStep<Dim>*>& pairs) {
        const auto pressed = [](const auto* pair) { return std::max(pair->normal_force, 0.0); };
        std::ranges::sort(pairs, std::ranges::greater{}, [](const auto* pair) { return pair->compression; });
        double left = 0.0;
        for (const auto* pair : pairs) left += bearing_share * pressed(pair);
        for (const auto* pair : pairs)
            if ((left -= pressed(pair)) < 0.0) return pair->compression;
        return 0.0;
    }
    [[nodiscard]] BodyImpulse<Dim>& between(std::int32_t body_1, std::int32_t body_2) {
        if (body_1 > body_2) std::swap(body_1, body_2);
        const std::array bodies{body_1, body_2};
        const auto bodies_of = [](const BodyImpulse<Dim>& pair) { return std::array{pair.body_1, pair.body_2}; };
        auto found = std::ranges::lower_bound(pairs_, bodies, {}, bodies_of);
        if (found == pairs_.end() || bodies_of(*found) != bodies)
            found = pairs_.insert(found, {body_1, body_2, Vector<Dim>::Zero(), 0.0});
        return *found;
    }

    std::vector<BodyImpulse<Dim>> pairs_;  // by (body_1, body_2)
};

}  // namespace abut::solid
