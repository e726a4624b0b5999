#pragma once
// Private to the layer.
#include <algorithm>
#include <cstdint>
#include <map>

#include "abut/contact/surface/bevels.hpp"

namespace abut::contact {

// `half_sine`: of half the inner angle of a corner (2D) or edge (3D).

/// By which part of the shorter flank the corners of a bevel lie to both sides of the corner or edge, along the flanks.
[[nodiscard]] inline double part_of_edge(double half_sine) {
    constexpr double narrowest = 1.0 / 4.0, widest = 1.0 / 8.0;  // half the width over L, at most
    return std::min(narrowest, 0.5 * widest / half_sine);
}

/// A flank that lies on a flat face sees the bevel at n_1 . n_2 = -half_sine, where it must not act.
[[nodiscard]] inline geometry::FacingFade bevel_facing(double half_sine) {
    constexpr double margin = 0.013, least = 0.5, narrowest = 0.1, full = 0.8;
    const double none = std::max(least, half_sine + margin);
    return {.full = -std::max(full, none + narrowest), .none = -none};
}

/// Whether an edge of a body in space has a bevel: below 60 degrees, as corners in the plane, or where it is below 95
/// and may cross an edge of another body that its flanks do not face enough. `crossing`: the product with the half_sine
/// of that edge.
[[nodiscard]] inline bool has_bevel_across(double half_sine, double crossing) {
    constexpr double sharpest = 1e-9, blunt_for_faces = 0.5 - 1e-9, bluntest = 0.737, enough_for_edges = 0.32;
    return half_sine > sharpest && half_sine < bluntest && (half_sine < blunt_for_faces || crossing < enough_for_edges);
}

/// F of a bevel of this width between flanks of this length: its width times k is what the end of a flank has.
[[nodiscard]] inline double stiffening(double length, double width) { return std::max(1.0, length / width); }

/// A fixed combination of nodes.
class Combination {
public:
    void add(std::int32_t node, double weight) { weights_[node] += weight; }
    /// Adds `times` another one.
    void add(const Combination& other, double times) {
        for (const auto& [node, weight] : other.weights_) add(node, times * weight);
    }
    /// As a corner of bevels; returns its number among these.
    template <int Dim>
    std::int32_t append_to(Bevels<Dim>& bevels) const {
        for (const auto& [node, weight] : weights_) {
            bevels.node.push_back(node);
            bevels.weight.push_back(weight);
        }
        bevels.offsets.push_back(static_cast<std::int32_t>(bevels.node.size()));
        return bevels.n_nodes() - 1;
    }

private:
    std::map<std::int32_t, double> weights_;
};

}  // namespace abut::contact
