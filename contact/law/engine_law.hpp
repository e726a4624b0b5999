#pragma once
// Private to the layer.
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/contact/law/law_memory.hpp"
#include "abut/contact/pair_store.hpp"
#include "abut/contact/pairs/admission.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/contact/surface/facet_store.hpp"

namespace abut::contact {

/// A law as the engine wants it: a value that knows the surface and the listed pairs. FaceLaw and NodeLaw are those of
/// Contact and NodalContact. A pair of the list is named by its index.
template <class L>
concept EngineLaw = requires(L& law, const L& known, const typename L::State& state, const typename L::Path& path,
                             typename L::Step& step, std::vector<FacetPair>& pairs, std::span<const FacetPair> in_contact,
                             std::span<PairMemory> memory, FacetStore& facets, CandidateSearch<L::dimension>& candidates,
                             FacetPair facet_pair, Face face, std::size_t pair, std::ptrdiff_t point, double number,
                             bool run_begins) {
    // The surface

    /// Its name in messages and saved states.
    { known.name() } -> std::convertible_to<std::string>;
    { known.facets() } -> std::convertible_to<SurfaceView<L::dimension>>;
    { known.face_name(face) } -> std::convertible_to<std::string>;
    /// Numbers that friction keeps per facet, and the energy that they hold [J].
    { known.facet_memory() } -> std::convertible_to<std::int32_t>;
    { known.stored_energy(facets) } -> std::convertible_to<double>;
    /// Points whose motion ends a list, and where they are in a state [m].
    { known.n_watched() } -> std::convertible_to<std::ptrdiff_t>;
    { known.position(state, point) } -> std::convertible_to<Vector<L::dimension>>;

    // The list

    /// Finds candidates for a step between two states.
    law.search(candidates, state, state);
    /// Whether a pair of facets may touch.
    { known.is_wanted(facet_pair) } -> std::same_as<bool>;
    /// Takes on the pairs of a new list. It may leave out those that cannot act while no point moves by more than a
    /// reach [m].
    law.list(pairs, in_contact, state, number);
    /// Takes on pairs to ask about, of a list that is not valid.
    law.list_remembered(in_contact);
    law.drop_list();
    { known.is_pressed_in(pair, state) } -> std::same_as<bool>;
    { known.decide_first(pair, state, run_begins) } -> std::same_as<FirstLook>;

    // A step

    /// Makes a result without a step.
    known.clear(step);
    /// Decides admission and finds the forces of a step of this length [s]. Returns the number of pairs that are pressed in
    /// without being contacts.
    { law.step(number, path, memory, facets, step) } -> std::convertible_to<std::int64_t>;
};

/// A law of bodies that touch themselves, overlap at the start or were bonded. It remembers more than pairs and facets
/// do, and may end a list by itself.
template <class L>
concept LawWithMemory = EngineLaw<L> &&
    requires(L& law, const L& known, const typename L::State& state, const typename L::Path& path, FacetPair pair,
             Facet facet, const LawMemory& memory, std::span<const PairMemory> of_pairs, double dt) {
    { known.memory() } -> std::same_as<LawMemory>;
    /// Throws BadInput for what `memory` cannot have given.
    law.set_memory(memory);
    /// Takes PairMemory::offset of all pairs of the list.
    law.set_born_offsets(of_pairs);
    /// Whether a pair of facets is no contact, since it lies inside of its body.
    { known.lies_inside(pair) } -> std::same_as<bool>;
    /// Whether the last search left a facet out, since nothing can touch it.
    { known.is_covered(facet) } -> std::same_as<bool>;
    /// Whether a facet has turned since the last search by more than lists allow for.
    { known.has_turned(state) } -> std::same_as<bool>;
    /// Looks for pairs that lay inside and have come out at the end of a step. The list does not have them: it ends.
    { law.sees_from_outside(path) } -> std::same_as<bool>;
    /// The last step of this length [s] has happened.
    law.end_step(dt);
};

}  // namespace abut::contact
