#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/contact/friction.hpp"
#include "abut/contact/law/friction_pair.hpp"
#include "abut/contact/law/friction_pass.hpp"
#include "abut/contact/path/pieces.hpp"
#include "abut/contact/step.hpp"
#include "abut/contact/surface/facet_store.hpp"
#include "abut/geometry/tangents.hpp"

namespace abut::contact {

/// Friction beside the modified reconstruction, on faces that translate: a force between each two faces that press,
/// across the normal of the pair, on their displacements without corrections. It is added to a step whose normal forces
/// are there. docs/friction.md.
template <int Dim>
class FaceFrictionLaw {
public:
    explicit FaceFrictionLaw(FrictionOptions options) : options_(std::move(options)) {}

    [[nodiscard]] bool any() const { return options_.any(); }
    [[nodiscard]] std::int32_t memory() const { return any() ? friction_memory<Dim - 1> : 0; }
    /// E of all springs [J].
    [[nodiscard]] double stored_energy(const FacetStore& facets) const {
        return any() ? stick_energy<Dim - 1>(facets) : 0.0;
    }
    [[nodiscard]] std::int32_t law_between(Face face_1, Face face_2) const { return options_.law_between(face_1, face_2); }

    /// `active`: the pairs of `step`. Displacements are those of the listed faces at both ends of the step of `dt` [s].
    void apply(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active, double dt,
               std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1, TakenForce take, FacetStore& facets,
               ContactStep<Dim>& step);

    /// The forces of the springs as they are, shared out as the `active` pairs of `step`, an evaluation of one state, press.
    void evaluate(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
                  const FacetStore& facets, ContactStep<Dim>& step);

private:
    static constexpr int n_tangents = Dim - 1;
    using Half = FrictionHalf<n_tangents>;

    struct Pair {
        FrictionPair facets;
        Vector<Dim> normal;
        std::int32_t in_step;                // its index in the pairs of the step
        std::array<std::int32_t, 2> listed;  // of its faces in those of the step
    };

    /// Finds the pairs that press, and their halves. `slip_of(pair, of_step)`: of a pair with friction, across its normal.
    template <class SlipOf>
    void take_pairs(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
                    const SlipOf& slip_of, ContactStep<Dim>& step);
    [[nodiscard]] static geometry::Tangents<Dim> tangents(const SurfaceView<Dim>& surface, const Pair& pair,
                                                          std::size_t side);
    /// `force`: on face 2.
    static void add_force(const Pair& pair, const Vector<Dim>& force, ContactStep<Dim>& step);

    FrictionOptions options_;
    FrictionPass<n_tangents> pass_;
    std::vector<Half> halves_;
    std::vector<Pair> pairs_;  // with friction
};

}  // namespace abut::contact
