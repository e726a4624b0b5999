#pragma once
// Private to the layer.
#include <vector>

#include "abut/contact/pair_store.hpp"

namespace abut::contact {

/// Memory of a law beside its pairs and facets.
struct LawMemory {
    std::vector<FacetPair> seen;       ///< that lay inside of their body at rest and have come out, increasing
    std::vector<double> interference;  ///< InterferenceRamps::saved
};

}  // namespace abut::contact
