#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/contact/law/law_memory.hpp"
#include "abut/contact/pair_store.hpp"
#include "abut/contact/report.hpp"
#include "abut/contact/surface/facet_store.hpp"

namespace abut::contact {

/// Key of a state: what it is of, and what it must fit.
struct StateKey {
    std::string kind;           ///< "contact 3D"
    std::uint64_t fingerprint;  ///< of the surface
    std::int32_t n_facets;
    std::int32_t facet_memory;  ///< numbers per facet that the law remembers
};

/// State on which the next steps depend, whatever the law.
struct SavedContact {
    bool has_searched = false;
    double next_skin = 0.0;  ///< [m]
    ContactReport report;
    PairStore pairs;
    FacetStore facets;
    std::vector<Facet> new_facets;      ///< that no search has seen yet, increasing
    std::vector<FacetPair> kept_apart;  ///< candidates that a host did not want, and in no list since then, increasing
    std::vector<Facet> covered;         ///< that the last search left out, increasing
    LawMemory law;
};

[[nodiscard]] std::vector<std::byte> saved(const StateKey& key, const SavedContact& contact);
/// Throws BadInput for bytes that are damaged, or of another kind, version or surface.
[[nodiscard]] SavedContact read_saved(const StateKey& key, std::span<const std::byte> bytes);

}  // namespace abut::contact
