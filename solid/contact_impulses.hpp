#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/solid/contact_results.hpp"

namespace abut::solid {

/// Sums of what bodies do to each other, by pair.
template <int Dim>
class ContactImpulses {
public:
    /// Body 1 pushes body 2 with this impulse [N s].
    void add(std::int32_t body_1, std::int32_t body_2, const Vector<Dim>& impulse, double normal_impulse) {
        if (body_1 > body_2) return add(body_2, body_1, -impulse, normal_impulse);
        const std::array bodies{body_1, body_2};
        const auto bodies_of = [](const BodyImpulse<Dim>& pair) { return std::array{pair.body_1, pair.body_2}; };
        auto found = std::ranges::lower_bound(pairs_, bodies, {}, bodies_of);
        if (found == pairs_.end() || bodies_of(*found) != bodies)
            found = pairs_.insert(found, {body_1, body_2, Vector<Dim>::Zero(), 0.0});
        found->impulse += impulse;
        found->normal_impulse += normal_impulse;
    }
    [[nodiscard]] std::span<const BodyImpulse<Dim>> pairs() const { return pairs_; }
    void restore(std::vector<BodyImpulse<Dim>> pairs) { pairs_ = std::move(pairs); }

private:
    std::vector<BodyImpulse<Dim>> pairs_;  // by (body_1, body_2)
};

}  // namespace abut::solid
