#pragma once
// Private to the layer.
#include <span>

#include "abut/contact/nodal_contact.hpp"

namespace abut::contact {

/// omega^2 = omega_free^2 + sum over the two bodies, that touch at worst, of max over nodes of sum_f k_12 |f|/(Dim m), k_12
/// with the stiffest partner there is. docs/method.md, The potential of a pair.
template <int Dim>
[[nodiscard]] NodalStableStep estimate_stable_step(const NodalSurface<Dim>& surface, std::span<const double> mass,
                                                   double omega_free);

}  // namespace abut::contact
