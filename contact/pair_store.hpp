#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "abut/base/state_bytes.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// Memory of a pair of facets from step to step. What facets remember by themselves is in FacetStore.
struct PairMemory {
    /// Whether A > 0 and g < 0 means contact; decided only where A min(g, 0) = 0. docs/method.md, Contact.
    bool admitted = false;
    /// Overlap that does not act, since the pair was in it when it became one [m] >= 0; 0 once it has been apart.
    double offset = 0.0;

    friend bool operator==(const PairMemory&, const PairMemory&) = default;
};

/// Two facets of a surface, facet_1 < facet_2.
struct FacetPair {
    Facet facet_1;
    Facet facet_2;

    friend auto operator<=>(const FacetPair&, const FacetPair&) = default;
};

/// Memory of the pairs of a surface, by (facet_1, facet_2). It outlives candidate lists: a pair that stays in the list from
/// one search to the next keeps its memory, one that leaves the list loses it (else it would come back active from the
/// side). It can be saved and restored.
class PairStore {
public:
    [[nodiscard]] std::span<const FacetPair> pairs() const { return pairs_; }  ///< increasing, each once
    [[nodiscard]] std::span<PairMemory> memory() { return memory_; }           ///< in the order of `pairs`
    [[nodiscard]] std::span<const PairMemory> memory() const { return memory_; }
    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(pairs_.size()); }
    /// The memory of a pair; null if it has none.
    [[nodiscard]] const PairMemory* find(FacetPair pair) const;

    /// Replaces the pairs of the store by these, increasing and each once: known ones keep their memory, new ones get
    /// `of_new(i)`. After an exception the store is as it was.
    void follow(std::span<const FacetPair> pairs, const std::function<PairMemory(std::size_t i)>& of_new);

    /// Memory of pairs whose facets have got other numbers. `old_of_new`: the old number of each facet, each once, -1 for a
    /// facet that was not there. Pairs for which `is_kept` is false are left out.
    [[nodiscard]] PairStore carried_over(std::span<const std::int32_t> old_of_new,
                                         const std::function<bool(FacetPair)>& is_kept) const;

    /// Appends the store to a state, and reads it from there; `n_facets` is the size of the surface. Throws BadInput
    /// for pairs out of order or range.
    void save(StateWriter& state) const;
    [[nodiscard]] static PairStore restored(StateReader& state, std::int32_t n_facets);

    friend bool operator==(const PairStore&, const PairStore&) = default;

private:
    std::vector<FacetPair> pairs_;
    std::vector<PairMemory> memory_;
};

}  // namespace abut::contact
