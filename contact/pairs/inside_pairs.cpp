#include "abut/contact/pairs/inside_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/pairs/pair.hpp"

namespace abut::contact {
namespace {

constexpr double rounding = 1e-9;  // of the size of a pair
/// Depth, of D, from which on faces of two bodies are far sides. Along a crack most lie behind each other by less, and bear
/// as they slide.
constexpr double inside_depth_of_bodies = 0.25;

/// Middle of a facet from its first corner on, and its normal, of any length.
template <int Dim>
struct Plane {
    Vector<Dim> middle, normal;
};
Plane<2> plane_of(const geometry::PairCorners<2>& x, int first) {
    const Vector<2> along = x[first + 1] - x[first];
    return {0.5 * (x[first] + x[first + 1]), Vector<2>(along[1], -along[0])};
}
Plane<3> plane_of(const geometry::PairCorners<3>& x, int first) {
    return {(x[first] + x[first + 1] + x[first + 2]) / 3.0, moment<3>(x[first + 1] - x[first], x[first + 2] - x[first])};
}

/// How deep a facet may be pressed in [m].
template <int Dim>
double depth_of(const SurfaceView<Dim>& facets, std::int32_t facet) {
    return facets.is_rigid(facet) ? 0.0 : facets.cell_depth[facet];
}

template <int Dim>
std::array<Vector<Dim>, Dim> sorted_corners(const SurfaceView<Dim>& facets, std::int32_t facet) {
    std::array<Vector<Dim>, Dim> corners;
    for (int v = 0; v < Dim; ++v) corners[v] = facets.vertices[facets.face_vertices[Dim * facet + v]];
    std::ranges::sort(corners, [](const auto& a, const auto& b) { return std::ranges::lexicographical_compare(a, b); });
    return corners;
}

/// The other body on a facet of which each facet lies, corner on corner: a crack parts the piece there; -1: none.
template <int Dim>
std::vector<std::int32_t> bodies_across(const SurfaceView<Dim>& facets) {
    std::vector<std::array<Vector<Dim>, Dim>> corners;
    for (std::int32_t facet = 0; facet < facets.size(); ++facet) corners.push_back(sorted_corners(facets, facet));
    std::vector<std::int32_t> order(corners.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&](std::int32_t a, std::int32_t b) {
        return std::ranges::lexicographical_compare(
            corners[a], corners[b], [](const auto& x, const auto& y) { return std::ranges::lexicographical_compare(x, y); });
    });
    std::vector<std::int32_t> across(corners.size(), -1);
    for (std::size_t i = 1; i < order.size(); ++i) {
        const std::int32_t facet_1 = order[i - 1], facet_2 = order[i];
        if (corners[facet_1] != corners[facet_2] || facets.body[facet_1] == facets.body[facet_2]) continue;
        across[facet_1] = facets.body[facet_2];
        across[facet_2] = facets.body[facet_1];
    }
    return across;
}

template <int Dim>
geometry::PairCorners<Dim> corners_at_rest(const SurfaceView<Dim>& facets, std::int32_t facet_1, std::int32_t facet_2) {
    geometry::PairCorners<Dim> corners;
    for (int v = 0; v < Dim; ++v) {
        corners[v] = facets.vertices[facets.face_vertices[Dim * facet_1 + v]];
        corners[Dim + v] = facets.vertices[facets.face_vertices[Dim * facet_2 + v]];
    }
    return corners;
}

template <int Dim>
double gap_at_rest(const SurfaceView<Dim>& facets, std::int32_t facet_1, std::int32_t facet_2) {
    const auto corners = corners_at_rest(facets, facet_1, facet_2);
    geometry::PairLaw<Dim> law{.stiffness = 1.0};
    if constexpr (Dim == 2) law.length = {facets.area[facet_1], facets.area[facet_2]};
    return inside_gap<Dim>(corners, geometry::pair_state<Dim>(corners, law));
}

/// Largest height of a corner of two facets over the plane of the other one [m].
template <int Dim>
double highest_corner(const geometry::PairCorners<Dim>& corners) {
    double highest = -std::numeric_limits<double>::infinity();
    for (const int facet : {0, Dim}) {
        const auto [middle, normal] = plane_of(corners, facet);
        for (int v = 0; v < Dim; ++v)
            highest = std::max(highest, (corners[Dim - facet + v] - middle).dot(normal) / normal.norm());
    }
    return highest;
}

}  // namespace

template <int Dim>
double inside_gap(const geometry::PairCorners<Dim>& corners, const geometry::PairState<Dim>& state) {
    if (state.overlap > 0.0 || !std::isfinite(state.gap)) return state.gap;
    const auto plane_1 = plane_of(corners, 0), plane_2 = plane_of(corners, Dim);
    const Vector<Dim> half = 0.5 * (plane_2.middle - plane_1.middle);  // from each middle to halfway
    const double height_1 = -half.dot(plane_1.normal) / state.normal.dot(plane_1.normal);
    const double height_2 = half.dot(plane_2.normal) / state.normal.dot(plane_2.normal);
    return std::min(state.gap, height_2 - height_1);
}

template <int Dim>
double outside_gap(const SurfaceView<Dim>& facets, FacetPair pair) {
    return -rounding * (circumradius(facets, number_of(pair.facet_1)) + circumradius(facets, number_of(pair.facet_2)));
}

template <int Dim>
InsidePairs<Dim>::InsidePairs(const SurfaceView<Dim>& facets, std::vector<std::int32_t> piece) {
    if (std::ranges::none_of(piece, [](std::int32_t number) { return number >= 0; })) return;
    facets_ = facets;
    piece_ = std::move(piece);
    across_ = bodies_across(facets);
    for (std::int32_t facet = 0; facet < facets.size(); ++facet)
        reach_.push_back(circumradius(facets, facet) + 2.0 * std::sqrt(static_cast<double>(Dim)) * depth_of(facets, facet));
}

template <int Dim>
bool InsidePairs<Dim>::lies_inside_at_rest(FacetPair pair) const {
    const std::int32_t facet_1 = number_of(pair.facet_1), facet_2 = number_of(pair.facet_2);
    const auto piece_of = [&](std::int32_t facet) { return piece_[static_cast<std::size_t>(facets_.body[facet])]; };
    if (piece_of(facet_1) < 0 || piece_of(facet_1) != piece_of(facet_2)) return false;
    const double near = reach_[static_cast<std::size_t>(facet_1)] + reach_[static_cast<std::size_t>(facet_2)];
    if ((facets_.centroid[facet_2] - facets_.centroid[facet_1]).squaredNorm() >= near * near) return false;
    const double highest = highest_gap_inside(pair), gap = gap_at_rest(facets_, facet_1, facet_2);
    if (!std::isfinite(gap) || gap >= highest) return false;
    return !lie_along_crack(facet_1, facet_2) || highest_corner<Dim>(corners_at_rest(facets_, facet_1, facet_2)) < highest;
}

/// Facets of a crack between two bodies. Where it has a bend, planes of facets beside it are behind each other halfway,
/// though the bodies are on their own sides of it: all corners are to lie inside there.
template <int Dim>
bool InsidePairs<Dim>::lie_along_crack(std::int32_t facet_1, std::int32_t facet_2) const {
    return across_[static_cast<std::size_t>(facet_1)] == facets_.body[facet_2] &&
           across_[static_cast<std::size_t>(facet_2)] == facets_.body[facet_1];
}

template <int Dim>
double InsidePairs<Dim>::highest_gap_inside(FacetPair pair) const {
    const std::int32_t facet_1 = number_of(pair.facet_1), facet_2 = number_of(pair.facet_2);
    const double outside = outside_gap(facets_, pair);
    if (facets_.body[facet_1] == facets_.body[facet_2]) return outside;
    return std::min(outside, -inside_depth_of_bodies * (depth_of(facets_, facet_1) + depth_of(facets_, facet_2)));
}

template <int Dim>
bool InsidePairs<Dim>::has(FacetPair pair) const {
    return !empty() && lies_inside_at_rest(pair) && !std::ranges::binary_search(seen_, pair);
}

template <int Dim>
std::vector<char> InsidePairs<Dim>::marks_of(std::span<const FacetPair> pairs) {
    std::vector<char> answers(pairs.size()), marks(pairs.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        while (at < asked_.size() && asked_[at] < pairs[i]) ++at;
        const bool is_known = at < asked_.size() && asked_[at] == pairs[i];
        answers[i] = is_known ? answers_[at] : static_cast<char>(lies_inside_at_rest(pairs[i]));
        marks[i] = static_cast<char>(answers[i] != 0 && !std::ranges::binary_search(seen_, pairs[i]));
    }
    asked_.assign(pairs.begin(), pairs.end());
    answers_ = std::move(answers);
    return marks;
}

template <int Dim>
void InsidePairs<Dim>::take_away(FacetPair pair) {
    seen_.insert(std::ranges::lower_bound(seen_, pair), pair);
}

template <int Dim>
void InsidePairs<Dim>::restore(std::span<const FacetPair> seen) {
    for (const FacetPair& pair : seen)
        if (empty() || !lies_inside_at_rest(pair))
            throw BadInput("contact: a saved state says that facets " + std::to_string(number_of(pair.facet_1)) + " and " +
                               std::to_string(number_of(pair.facet_2)) +
                               " have been seen from outside, but at rest they do not lie inside of each other. It is of "
                               "other options, or damaged.",
                           {.face_1 = number_of(pair.facet_1), .face_2 = number_of(pair.facet_2)});
    seen_.assign(seen.begin(), seen.end());
    sort_unique(seen_);
}

template double inside_gap(const geometry::PairCorners<2>&, const geometry::PairState<2>&);
template double inside_gap(const geometry::PairCorners<3>&, const geometry::PairState<3>&);
template double outside_gap(const SurfaceView<2>&, FacetPair);
template double outside_gap(const SurfaceView<3>&, FacetPair);
template class InsidePairs<2>;
template class InsidePairs<3>;

}  // namespace abut::contact
