#pragma once
// Private to the sources of this layer.
#include "abut/solid/options.hpp"

namespace abut::solid {

/// Whether a choice was made that this law alone reads.
template <int Dim>
[[nodiscard]] bool asks_for(ContactLaw law, const SolidOptions<Dim>& options);

/// Throws BadInput naming each choice that has no effect under the law that acts, and what to do. Values that are the defaults
/// may be given. Nothing is refused without contact.
template <int Dim>
void refuse_choices_of_other_law(ContactLaw acting, const SolidOptions<Dim>& options);

}  // namespace abut::solid
