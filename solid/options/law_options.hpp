#pragma once
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// Throws BadInput naming each choice that has no effect under the law that acts, and what to do. Values that are the
/// defaults may be given. Nothing is refused without contact.
template <int Dim>
void refuse_choices_of_other_law(ContactLaw acting, const SolidOptions<Dim>& options);

/// Sets all choices that one law alone reads to their defaults, so that every law takes the options.
template <int Dim>
void take_back_choices_of_one_law(SolidOptions<Dim>& options);

}  // namespace abut::solid
