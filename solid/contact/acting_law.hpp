#pragma once
// Private to the sources of this layer.
#include "abut/solid/body/bodies.hpp"

namespace abut::solid {

/// The law of contact of the options, `automatic` resolved. Throws BadInput where the modified reconstruction is asked
/// for and a body or an obstacle turns, a bond has a strength, or bodies interfere.
template <int Dim>
[[nodiscard]] ContactLaw acting_law(const Bodies<Dim>& bodies);

}  // namespace abut::solid
