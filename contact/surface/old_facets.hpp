#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/surface/nodal_surface.hpp"

namespace abut::contact {

/// Old number of each facet of a surface that replaces another, -1 for a facet that was not there. `old_face_of`: of
/// each face of the new surface its old number, or -1. Throws BadInput for numbers out of range or given twice, and for
/// a face whose number of facets has changed.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> old_facets(const NodalSurface<Dim>& before, const NodalSurface<Dim>& after,
                                                   std::span<const std::int32_t> old_face_of);

}  // namespace abut::contact
