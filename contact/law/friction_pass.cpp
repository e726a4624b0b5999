#include "abut/contact/law/friction_pass.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "abut/base/ids.hpp"

namespace abut::contact {
namespace {

template <int N>
using Memory = std::array<double, friction_memory<N>>;

template <int N>
Memory<N> memory_of(const StickState<N>& state) {
    Memory<N> memory;
    for (int i = 0; i < N; ++i) {
        memory[i] = state.stretch[i];
        memory[N + i] = state.direction[i];
    }
    memory[2 * N] = state.stiffness;
    memory[2 * N + 1] = state.slid;
    memory[2 * N + 2] = state.last_slip;
    return memory;
}

/// Nothing presses on the facet any more: what its spring holds is lost. The direction is kept, and the path: faces
/// that vibrate open for a step or two.
template <int N>
double let_go(StickState<N>& state) {
    const double lost = state.energy();
    state = {.direction = state.direction, .slid = state.slid};
    return lost;
}

/// Sets the weights of the halves of a facet; returns its normal force [N].
template <int N>
double set_weights(std::span<FrictionHalf<N>> halves, std::span<const std::size_t> of_facet) {
    double normal_force = 0.0;
    for (const std::size_t i : of_facet) normal_force += halves[i].normal_force;
    for (const std::size_t i : of_facet) halves[i].weight = halves[i].normal_force / normal_force * halves[i].active_share;
    return normal_force;
}

}  // namespace

template <int N>
StickState<N> stick_state(std::span<const double> memory) {
    StickState<N> state;
    for (int i = 0; i < N; ++i) {
        state.stretch[i] = memory[i];
        state.direction[i] = memory[N + i];
    }
    state.stiffness = memory[2 * N];
    state.slid = memory[2 * N + 1];
    state.last_slip = memory[2 * N + 2];
    return state;
}

template <int N>
double stick_energy(const FacetStore& facets) {
    double energy = 0.0;
    for (const Facet facet : facets.used()) energy += stick_state<N>(facets[facet]).energy();
    return energy;
}

template <int N>
void list_friction(const FacetStore& facets, std::vector<FaceFriction>& of_facets) {
    of_facets.clear();
    for (const Facet facet : facets.used())
        if (const StickState<N> state = stick_state<N>(facets[facet]); state.stiffness != 0.0)
            of_facets.push_back({.face = Face{number_of(facet)}, .slip = state.last_slip});
}

template <int N>
void FrictionPass<N>::apply(double dt, TakenForce take, std::span<FrictionHalf<N>> halves, FacetStore& facets,
                            FrictionFigures& figures, std::vector<FaceFriction>& of_facets) {
    figures = {};
    of_facets.clear();
    const auto book = [&](double dissipated) {
        figures.dissipated += dissipated;
        figures.least_dissipated = std::min(figures.least_dissipated, dissipated);
    };
    const auto release = [&](Facet facet) {
        StickState<N> state = stick_state<N>(facets[facet]);
        if (state.stiffness == 0.0) return;
        book(let_go(state));
        facets.set_next(facet, memory_of(state));
    };
    auto used = facets.used().begin();
    const auto end_of_used = facets.used().end();
    for_each_facet(halves, [&](std::span<const std::size_t> of_facet) {
        const Facet facet = halves[of_facet[0]].facet;
        for (; used != end_of_used && *used < facet; ++used) release(*used);
        if (used != end_of_used && *used == facet) ++used;

        StickState<N> state = stick_state<N>(facets[facet]);
        const FaceFriction found = advance(dt, take, halves, of_facet, state);
        state.last_slip = found.slip;
        facets.set_next(facet, memory_of(state));
        of_facets.push_back(found);
        book(found.dissipated);
        figures.energy += state.energy();
        if (found.limit > 0.0) figures.largest_ratio = std::max(figures.largest_ratio, found.force / found.limit);
        if (found.slip > 0.0) {
            ++figures.sliding;
            figures.sliding_force += found.force;
            figures.sliding_limit += found.limit;
        } else {
            ++figures.sticking;
        }
    });
    for (; used != end_of_used; ++used) release(*used);
}

template <int N>
void FrictionPass<N>::weigh(std::span<FrictionHalf<N>> halves) {
    for_each_facet(halves, [&](std::span<const std::size_t> of_facet) { set_weights(halves, of_facet); });
}

template <int N>
template <class Visit>
void FrictionPass<N>::for_each_facet(std::span<const FrictionHalf<N>> halves, const Visit& visit) {
    const auto key = [&](std::size_t i) {
        return std::size_t{static_cast<std::uint32_t>(number_of(halves[i].facet))} << 32U | i;
    };
    // Most steps have the halves of the step before, and so their order.
    if (order_.size() != halves.size() || !std::ranges::is_sorted(order_, {}, key)) {
        order_.resize(halves.size());
        for (std::size_t i = 0; i < halves.size(); ++i) order_[i] = key(i);  // plain numbers are sorted faster than halves
        std::ranges::sort(order_);
        for (std::size_t& i : order_) i &= 0xffffffffU;
    }
    for (std::size_t begin = 0, end = 0; begin < order_.size(); begin = end) {
        const Facet facet = halves[order_[begin]].facet;
        while (end < order_.size() && halves[order_[end]].facet == facet) ++end;
        visit(std::span<const std::size_t>(order_).subspan(begin, end - begin));
    }
}

template <int N>
FaceFriction FrictionPass<N>::advance(double dt, TakenForce take, std::span<FrictionHalf<N>> halves,
                                      std::span<const std::size_t> of_facet, StickState<N>& state) {
    const auto sum = [&](const auto& term) {
        double result = 0.0;
        for (const std::size_t i : of_facet) result += term(halves[i]);
        return result;
    };
    const double normal_force = set_weights(halves, of_facet);
    const double active = sum([](const auto& half) { return half.weight; });
    const double area = sum([](const auto& half) { return half.area; });
    Along<N> motion = Along<N>::Zero();
    for (const std::size_t i : of_facet) motion += halves[i].weight * halves[i].motion;
    if (state.stiffness == 0.0) {  // fixed from here on, as long as something presses
        const double pair_area = sum([](const auto& half) { return half.pair_area; });
        state.stiffness =
            halves[of_facet[0]].facet_area * sum([](const auto& half) { return half.area * half.stiffness; }) / pair_area;
    }

    const Sliding sliding{motion.norm() / (active * dt), state.slid, area > 0.0 ? normal_force / area : 0.0};
    const double limit = sum([&](const auto& half) {
                             return coefficient_of(*half.law, sliding) * half.normal_force + half.law->strength * half.area;
                         }) /
                         active;
    const double creep = 0.5 * active * dt *
                         sum([&](const auto& half) { return half.normal_force / normal_force / half.law->relaxation_time; });
    const FrictionStep<N> step = take == TakenForce::mean ? take_mean_step<N>(state, motion, limit, creep)
                                                          : take_end_step<N>(state, motion, limit, creep);
    for (const std::size_t i : of_facet) halves[i].force = halves[i].weight * step.force;
    return {.face = Face{number_of(halves[of_facet[0]].facet)},
            .normal_force = normal_force,
            .force = active * step.force.norm(),
            .limit = active * limit,
            .slip = step.slip,
            .dissipated = step.dissipated};
}

#define ABUT_INSTANTIATE(N)                                                        \
    template StickState<N> stick_state<N>(std::span<const double>);                \
    template double stick_energy<N>(const FacetStore&);                            \
    template void list_friction<N>(const FacetStore&, std::vector<FaceFriction>&); \
    template class FrictionPass<N>;
ABUT_INSTANTIATE(1)
ABUT_INSTANTIATE(2)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
