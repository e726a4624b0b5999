#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/friction.hpp"
#include "abut/contact/law/friction_step.hpp"
#include "abut/contact/step.hpp"
#include "abut/contact/surface/facet_store.hpp"

namespace abut::contact {

/// One facet of a pair that presses, as the friction of this facet sees the pair. Both facets of a pair have one, unless one
/// of them is rigid.
template <int N>
struct FrictionHalf {
    Facet facet{};
    double normal_force;  ///< share of this facet in that of the pair, mean over the step [N], > 0
    double active_share;  ///< part of the step in which the pair is active [-], > 0
    double area;          ///< share of this facet in the area in contact, mean over the step [m^(Dim-1)]
    double pair_area;     ///< all of it
    double facet_area;    ///< |f| at rest
    double stiffness;     ///< kappa, shear of the half cells behind both in series [Pa/m]
    const Friction* law;
    Along<N> motion;  ///< of this facet past its partner, in its tangents [m]

    double weight = 0.0;                ///< result: share of the pair in the force of the facet, times `active_share`
    Along<N> force = Along<N>::Zero();  ///< result: against `motion`; what acts on this facet is minus this [N]
};

/// Numbers that a facet remembers.
template <int N>
inline constexpr std::int32_t friction_memory = 2 * N + 3;

template <int N>
[[nodiscard]] StickState<N> stick_state(std::span<const double> memory);

/// Friction of all facets in one step: each facet has one spring, whatever it touches. Motions of its pairs are joined with
/// the normal forces as weights, and the force of the spring is shared out likewise. docs/friction.md.
///
/// An instance keeps its work arrays; after a few steps it allocates nothing.
template <int N>
class FrictionPass {
public:
    /// Fills the results of the halves, the next memory of facets, `figures`, and `of_facets`, one per facet,
    /// increasing, with its index as face. Halves of one facet are joined in their order.
    void apply(double dt, TakenForce take, std::span<FrictionHalf<N>> halves, FacetStore& facets, FrictionFigures& figures,
               std::vector<FaceFriction>& of_facets);

    /// Fills the weights of the halves alone.
    void weigh(std::span<FrictionHalf<N>> halves);

private:
    /// Calls visit(indices) with those of the halves of each facet, by facet.
    template <class Visit>
    void for_each_facet(std::span<const FrictionHalf<N>> halves, const Visit& visit);
    FaceFriction advance(double dt, TakenForce take, std::span<FrictionHalf<N>> halves,
                         std::span<const std::size_t> of_facet, StickState<N>& state);

    std::vector<std::size_t> order_;  // halves by facet
};

/// The facets that had friction in the last step, increasing, with their index as face and their slip.
template <int N>
void list_friction(const FacetStore& facets, std::vector<FaceFriction>& of_facets);

/// Energy of all springs [J].
template <int N>
[[nodiscard]] double stick_energy(const FacetStore& facets);

}  // namespace abut::contact
