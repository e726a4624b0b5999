#pragma once
// Private to the layer.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/ids.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/law/friction_pass.hpp"
#include "abut/contact/surface/facet_store.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/geometry/tangents.hpp"

namespace abut::contact {

/// Sign with which one of the facets of a pair (0 or 1) sees its slip, that of facet 2 past facet 1.
constexpr double sign_of(std::size_t side) { return side == 0 ? -1.0 : 1.0; }

/// Normal force of a pair, mean over a step [N], its area in contact [m^(Dim-1)], and the part of the step in which it
/// is active.
struct Pressing {
    double normal_force;
    double area;
    double active_share;

    [[nodiscard]] bool acts() const { return normal_force > 0.0 && area > 0.0 && active_share > 0.0; }
};

/// Part of a pair in the friction of its two facets.
struct FrictionPair {
    std::array<Facet, 2> facet;
    std::array<std::int32_t, 2> half{-1, -1};  ///< index of the half of each facet; -1: it is rigid
    std::array<double, 2> weight{};            ///< FrictionHalf::weight of each; 0: it is rigid
};

/// Appends the halves of a pair that presses. `tangents_of(side)` gives the tangents of a facet in the plane of the
/// pair, `motion` is that of facet 2 past facet 1 [m].
template <int Dim, class Facets, class TangentsOf>
void append_halves(const Facets& facets, const Friction& law, const Pressing& pressing, const Vector<Dim>& motion,
                   const TangentsOf& tangents_of, FrictionPair& pair, std::vector<FrictionHalf<Dim - 1>>& halves) {
    const std::array<std::int32_t, 2> facet{number_of(pair.facet[0]), number_of(pair.facet[1])};
    const auto is_rigid = [&](std::size_t side) { return std::isinf(facets.stiffness[facet[side]]); };
    const double stiffness = series_stiffness(facets.shear_stiffness[facet[0]], facets.shear_stiffness[facet[1]]);
    for (std::size_t side = 0; side < 2; ++side) {
        if (is_rigid(side)) continue;
        const double share = is_rigid(1 - side) ? 1.0 : 0.5;
        pair.half[side] = static_cast<std::int32_t>(halves.size());
        halves.push_back({.facet = pair.facet[side],
                          .normal_force = share * pressing.normal_force,
                          .active_share = pressing.active_share,
                          .area = share * pressing.area,
                          .pair_area = pressing.area,
                          .facet_area = facets.area[facet[side]],
                          .stiffness = stiffness,
                          .law = &law,
                          .motion = geometry::components<Dim>(tangents_of(side), Vector<Dim>(sign_of(side) * motion))});
    }
}

template <int N>
void take_weights(std::span<const FrictionHalf<N>> halves, FrictionPair& pair) {
    for (std::size_t side = 0; side < 2; ++side)
        if (pair.half[side] >= 0) pair.weight[side] = halves[static_cast<std::size_t>(pair.half[side])].weight;
}

/// Friction on facet 2 of a pair, mean over the step [N], by the results of its halves.
template <int Dim, class TangentsOf>
[[nodiscard]] Vector<Dim> force_on_second(std::span<const FrictionHalf<Dim - 1>> halves, const TangentsOf& tangents_of,
                                          const FrictionPair& pair) {
    Vector<Dim> force = Vector<Dim>::Zero();
    for (std::size_t side = 0; side < 2; ++side) {
        if (pair.half[side] < 0) continue;
        const FrictionHalf<Dim - 1>& half = halves[static_cast<std::size_t>(pair.half[side])];
        force -= sign_of(side) * geometry::in_space<Dim>(tangents_of(side), half.force);
    }
    return force;
}

/// Force on facet 2 of the springs as they are [N].
template <int Dim, class TangentsOf>
[[nodiscard]] Vector<Dim> spring_force_on_second(const FacetStore& facets, const TangentsOf& tangents_of,
                                                 const FrictionPair& pair) {
    Vector<Dim> force = Vector<Dim>::Zero();
    for (std::size_t side = 0; side < 2; ++side) {
        if (pair.weight[side] == 0.0) continue;
        const StickState<Dim - 1> state = stick_state<Dim - 1>(facets[pair.facet[side]]);
        force -= (sign_of(side) * pair.weight[side]) *
                 geometry::in_space<Dim>(tangents_of(side), state.stiffness * state.stretch);
    }
    return force;
}

}  // namespace abut::contact
