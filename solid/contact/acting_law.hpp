#pragma once
// Private to the sources of this layer.
#include "abut/solid/body/bodies.hpp"

namespace abut::solid {

/// The law of contact of the options, `automatic` resolved. Throws BadInput for one that does not know bodies or obstacles that turn.
template <int Dim>
[[nodiscard]] ContactLaw acting_law(const Bodies<Dim>& bodies);

}  // namespace abut::solid
