#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/nodal_surface.hpp"
#include "abut/contact/pair_store.hpp"

namespace abut::contact {

/// What pairs of facets remember, where faces have got other numbers, gone or come. `old_face_of`: of each face of the new
/// surface its old number, or -1. Throws BadInput for numbers out of range or given twice, and for a face whose number of
/// facets has changed.
template <int Dim>
[[nodiscard]] PairStore carried_over(const PairStore& store, const NodalSurface<Dim>& before, const NodalSurface<Dim>& after,
                                     std::span<const std::int32_t> old_face_of);

/// Facets of the new surface that were not there before, or that were still `new_facets` there; both increasing.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> facets_that_come(std::span<const std::int32_t> new_facets,
                                                         const NodalSurface<Dim>& before, const NodalSurface<Dim>& after,
                                                         std::span<const std::int32_t> old_face_of);

}  // namespace abut::contact
