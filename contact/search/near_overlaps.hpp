#pragma once
#include <vector>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/report.hpp"
#include "abut/contact/surface/nodal_surface.hpp"

namespace abut::contact {

/// Overlaps within a distance, and how many pairs were looked at for them.
template <int Dim>
struct NearOverlaps {
    std::vector<Overlap<Dim>> found;  ///< by (face_1, face_2), in the numbers of the facets
    CandidateReport search;
};

/// Every pair of facets of two bodies at rest that look at each other, share an area, and have a gap between their centroids
/// of at most `distance` [m], apart or pressed in. Depths play no part: the candidates are those of the distance, the same
/// in every unit of length. Throws BadInput for a distance that is not finite and >= 0, and what CandidateSearch throws.
template <int Dim>
[[nodiscard]] NearOverlaps<Dim> find_near_overlaps(const NodalSurface<Dim>& surface, double distance);

}  // namespace abut::contact
