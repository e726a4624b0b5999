#include "abut/contact/search/near_overlaps.hpp"

#include <cmath>
#include <limits>

#include "abut/contact/search/candidate_search.hpp"
#include "abut/contact/search/face_boxes.hpp"

namespace abut::contact {
namespace {

constexpr double no_skin = 1e-6;  // mean face sizes: for rounding, where a list is used once

}  // namespace

template <int Dim>
NearOverlaps<Dim> find_near_overlaps(const NodalSurface<Dim>& surface, double distance) {
    Surface<Dim> facets = surface.facets();
    facets.cell_depth.assign(facets.cell_depth.size(), std::numeric_limits<double>::min());  // lost in any sum
    CandidateOptions options;
    options.distance = distance;
    options.skin = no_skin * mean_face_size(facets.view());
    CandidateSearch<Dim> search(facets.view(), options);
    const PointsView<Dim> positions(facets.vertices);
    search.search_moved(positions, positions, GapOf::centroids);
    NearOverlaps<Dim> near{.found = {}, .search = search.report()};
    for (const Overlap<Dim>& overlap : find_overlaps_moved<Dim>(facets.view(), positions, search.candidates()).found)
        if (std::abs(overlap.gap) <= distance) near.found.push_back(overlap);
    return near;
}

template NearOverlaps<2> find_near_overlaps(const NodalSurface<2>&, double);
template NearOverlaps<3> find_near_overlaps(const NodalSurface<3>&, double);

}  // namespace abut::contact
