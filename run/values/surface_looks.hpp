#pragma once
#include <cstdint>
#include <string>
#include <tuple>

namespace abut::run {

/// Two bodies, or a body and an obstacle, by name, and what was measured of them.
struct Encounter {
    std::string body_1{};
    std::string body_2{};
    double distance = 0.0;  ///< [m]
    double ratio = 0.0;     ///< [-]
    double time = 0.0;      ///< when that was [s]

    static auto fields(auto& self) { return std::tie(self.body_1, self.body_2, self.distance, self.ratio, self.time); }
};

/// Findings about the surfaces of the bodies where they are, whatever contact knows of them: at the end, and before that at
/// records, as often as costs about a hundredth of the run.
struct SurfaceLooks {
    std::int64_t looks = 0;
    /// Two cells of different bodies that were deepest inside each other: the shortest way that parts these two, and
    /// that over the size of the smaller one. The depth of the bodies is at least as much.
    Encounter deepest{};
    /// Two faces that pushed each other from farthest away: their distance, and that over the size of the smaller one.
    Encounter remote{};
    /// Two bodies that slid along each other under the highest mean pressure: that over E of the softer one is `ratio`.
    Encounter pressed{};
    /// Surfaces nearest to each other at the end, where nothing has touched. Without names: nothing could touch, or
    /// some lie on each other without a force.
    Encounter nearest{};

    static auto fields(auto& self) { return std::tie(self.looks, self.deepest, self.remote, self.pressed, self.nearest); }
};

}  // namespace abut::run
