#pragma once
#include <cstdint>
#include <string>
#include <tuple>

namespace abut::run {

/// The body that has turned farthest of those that may not turn.
struct TurnedBody {
    std::string name{};  ///< as in messages; empty: none has turned
    double angle = 0.0;  ///< [rad]

    static auto fields(auto& self) { return std::tie(self.name, self.angle); }
};

/// Two bodies, or a body and an obstacle, that slid past each other with less friction than belongs to their normal force.
struct WeakFriction {
    std::string body_1{};
    std::string body_2{};  ///< as in messages; empty: there were none
    double seconds = 0.0;  ///< in which they did so [s]
    double share = 1.0;    ///< impulse of their friction along the sliding over mu times the normal one then [-]
};

/// The two bodies, or a body and an obstacle, that were pressed into each other deepest where they bear.
struct Compressed {
    std::string body_1{};
    std::string body_2{};      ///< as in messages; empty: none were, beyond the warning
    double compression = 0.0;  ///< solid::BodyImpulse::compression [-]
    std::int64_t steps = 0;    ///< in which it was more than the warning
};

}  // namespace abut::run
