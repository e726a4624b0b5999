#include "abut/contact/pairs/inside_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/contact/pairs/pair.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"

namespace abut::contact {
namespace {

constexpr double rounding = 1e-9;  // of the size of a pair

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

template <int Dim>
double gap_at_rest(const SurfaceView<Dim>& facets, std::int32_t facet_1, std::int32_t facet_2) {
    geometry::PairCorners<Dim> corners;
    for (int v = 0; v < Dim; ++v) {
        corners[v] = facets.vertices[facets.face_vertices[Dim * facet_1 + v]];
        corners[Dim + v] = facets.vertices[facets.face_vertices[Dim * facet_2 + v]];
    }
    geometry::PairLaw<Dim> law{.stiffness = 1.0};
    if constexpr (Dim == 2) law.length = {facets.area[facet_1], facets.area[facet_2]};
    return inside_gap<Dim>(corners, geometry::pair_state<Dim>(corners, law));
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
InsidePairs<Dim>::InsidePairs(const SurfaceView<Dim>& facets, const std::vector<std::int32_t>& piece) {
    if (std::ranges::none_of(piece, [](std::int32_t number) { return number >= 0; })) return;
    const auto piece_of = [&](std::int32_t facet) { return piece[static_cast<std::size_t>(facets.body[facet])]; };
    const auto n = static_cast<std::size_t>(facets.size());
    std::vector<double> reach(n);
    std::vector<geometry::Box<Dim>> boxes(n);
    for (std::int32_t facet = 0; facet < facets.size(); ++facet) {
        if (piece_of(facet) < 0) continue;
        const double depth = facets.is_rigid(facet) ? 0.0 : facets.cell_depth[facet];
        reach[facet] = circumradius(facets, facet) + 2.0 * std::sqrt(static_cast<double>(Dim)) * depth;
        boxes[facet].extend(facets.centroid[facet]);
        boxes[facet] = boxes[facet].grown(reach[facet]);
    }
    const auto is_inside = [&](std::int32_t facet_1, std::int32_t facet_2) {
        if (piece_of(facet_1) != piece_of(facet_2)) return false;
        const double near = reach[facet_1] + reach[facet_2];
        if ((facets.centroid[facet_2] - facets.centroid[facet_1]).squaredNorm() >= near * near) return false;
        const double gap = gap_at_rest(facets, facet_1, facet_2);
        return std::isfinite(gap) && gap < outside_gap(facets, FacetPair{Facet{facet_1}, Facet{facet_2}});
    };
    offsets_.assign(n + 1, 0);
    for (const auto& [facet_1, facet_2] : geometry::overlapping_pairs<Dim>({}, boxes, is_inside)) {
        ++offsets_[static_cast<std::size_t>(facet_1) + 1];
        partners_.push_back(facet_2);
    }
    for (std::size_t facet = 0; facet < n; ++facet) offsets_[facet + 1] += offsets_[facet];
    is_seen_.assign(partners_.size(), 0);
}

template <int Dim>
std::ptrdiff_t InsidePairs<Dim>::index_of(FacetPair pair) const {
    if (partners_.empty()) return -1;
    const auto facet = static_cast<std::size_t>(pair.facet_1);
    const auto begin = partners_.begin() + static_cast<std::ptrdiff_t>(offsets_[facet]);
    const auto end = partners_.begin() + static_cast<std::ptrdiff_t>(offsets_[facet + 1]);
    const auto at = std::lower_bound(begin, end, number_of(pair.facet_2));
    return at != end && *at == number_of(pair.facet_2) ? at - partners_.begin() : -1;
}

template <int Dim>
bool InsidePairs<Dim>::has(FacetPair pair) const {
    const std::ptrdiff_t at = index_of(pair);
    return at >= 0 && is_seen_[static_cast<std::size_t>(at)] == 0;
}

template <int Dim>
void InsidePairs<Dim>::take_away(FacetPair pair) {
    is_seen_[static_cast<std::size_t>(index_of(pair))] = 1;
}

template <int Dim>
std::vector<FacetPair> InsidePairs<Dim>::seen() const {
    std::vector<FacetPair> seen;
    for (std::size_t facet = 0; facet + 1 < offsets_.size(); ++facet)
        for (std::size_t i = offsets_[facet]; i < offsets_[facet + 1]; ++i)
            if (is_seen_[i] != 0) seen.push_back({Facet(facet), Facet{partners_[i]}});
    return seen;
}

template <int Dim>
void InsidePairs<Dim>::restore(std::span<const FacetPair> seen) {
    std::vector<char> is_seen(partners_.size(), 0);
    for (const FacetPair& pair : seen) {
        const std::ptrdiff_t at = index_of(pair);
        if (at < 0)
            throw BadInput("contact: a saved state says that facets " + std::to_string(number_of(pair.facet_1)) + " and " +
                               std::to_string(number_of(pair.facet_2)) +
                               " have been seen from outside, but at rest they do not lie inside of each other. It is of "
                               "other options, or damaged.",
                           {.face_1 = number_of(pair.facet_1), .face_2 = number_of(pair.facet_2)});
        is_seen[static_cast<std::size_t>(at)] = 1;
    }
    is_seen_ = std::move(is_seen);
}

template double inside_gap(const geometry::PairCorners<2>&, const geometry::PairState<2>&);
template double inside_gap(const geometry::PairCorners<3>&, const geometry::PairState<3>&);
template double outside_gap(const SurfaceView<2>&, FacetPair);
template double outside_gap(const SurfaceView<3>&, FacetPair);
template class InsidePairs<2>;
template class InsidePairs<3>;

}  // namespace abut::contact
