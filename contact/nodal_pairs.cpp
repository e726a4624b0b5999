#include "abut/contact/nodal_pairs.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "abut/base/sort_unique.hpp"

namespace abut::contact {
namespace {

double admission_depth(double stiffness, double depth) {
    return stiffness == std::numeric_limits<double>::infinity() ? 0.0 : depth;
}

template <int Dim>
NodalPair<Dim> make_pair(const Surface<Dim>& facets, const FacePair& of_facets, const geometry::FacingFade& facing) {
    const std::int32_t facet_1 = number_of(of_facets.face_1), facet_2 = number_of(of_facets.face_2);
    NodalPair<Dim> pair{.facet_1 = facet_1, .facet_2 = facet_2};
    for (int v = 0; v < Dim; ++v) {
        pair.node[v] = facets.face_vertices[Dim * facet_1 + v];
        pair.node[Dim + v] = facets.face_vertices[Dim * facet_2 + v];
    }
    const double k_1 = facets.stiffness[facet_1], k_2 = facets.stiffness[facet_2];
    pair.law.stiffness = series_stiffness(k_1, k_2);
    pair.law.facing = facing;
    if constexpr (Dim == 2) pair.law.length = {facets.area[facet_1], facets.area[facet_2]};
    pair.admission_depth =
        admission_depth(k_1, facets.cell_depth[facet_1]) + admission_depth(k_2, facets.cell_depth[facet_2]);
    return pair;
}

BodyPair in_order(std::int32_t body_1, std::int32_t body_2) { return {std::min(body_1, body_2), std::max(body_1, body_2)}; }

/// Index of a value in a sorted list that has it.
template <class T>
std::int32_t index_in(const std::vector<T>& sorted, const T& value) {
    return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

}  // namespace

template <int Dim>
void NodalPairs<Dim>::assign(const NodalSurface<Dim>& surface, std::vector<FacePair>& facets,
                             std::span<const FacePair> in_contact, PointsView<Dim> x_0, PointsView<Dim> x_1, double reach,
                             double compression) {
    pairs_.clear();
    std::erase_if(facets, [&](const FacePair& of_facets) {
        NodalPair<Dim> pair = make_pair(surface.facets(), of_facets, facing_);
        const geometry::PairCorners<Dim> start = pair.at(x_0), end = pair.at(x_1);
        double farthest = reach;
        for (std::size_t v = 0; v < start.size(); ++v) farthest = std::max(farthest, (end[v] - start[v]).norm());
        pair.outlook = geometry::pair_outlook<Dim>(start, pair.law, farthest, compression * pair.admission_depth);
        const bool stays = pair.outlook.may_act || std::ranges::binary_search(in_contact, of_facets);
        if (!pair.outlook.may_act) pair.outlook = {};  // it says nothing of pairs that are deeper
        if (stays) pairs_.push_back(pair);
        return !stays;
    });
    index(surface);
}

template <int Dim>
void NodalPairs<Dim>::assign(const NodalSurface<Dim>& surface, std::span<const FacePair> facets) {
    pairs_.clear();
    for (const FacePair& of_facets : facets) pairs_.push_back(make_pair(surface.facets(), of_facets, facing_));
    index(surface);
}

template <int Dim>
void NodalPairs<Dim>::index(const NodalSurface<Dim>& surface) {
    nodes_.clear();
    bodies_.clear();
    body_pairs_.clear();
    const std::vector<std::int32_t>& body = surface.facets().body;
    for (const NodalPair<Dim>& pair : pairs_) {
        nodes_.insert(nodes_.end(), pair.node.begin(), pair.node.end());
        const BodyPair of_bodies = in_order(body[pair.facet_1], body[pair.facet_2]);
        body_pairs_.push_back(of_bodies);
        bodies_.insert(bodies_.end(), {of_bodies.body_1, of_bodies.body_2});
    }
    sort_unique(nodes_);
    sort_unique(bodies_);
    sort_unique(body_pairs_);
    for (NodalPair<Dim>& pair : pairs_) {
        for (std::size_t v = 0; v < pair.node.size(); ++v) pair.listed[v] = index_in(nodes_, pair.node[v]);
        const std::int32_t body_1 = body[pair.facet_1], body_2 = body[pair.facet_2];
        pair.body_1 = index_in(bodies_, body_1);
        pair.body_2 = index_in(bodies_, body_2);
        pair.body_pair = index_in(body_pairs_, in_order(body_1, body_2));
    }
}

template class NodalPairs<2>;
template class NodalPairs<3>;

}  // namespace abut::contact
