#include "abut/contact/surface/bevels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "abut/contact/surface/bevel_shape.hpp"
#include "abut/contact/surface/old_facets.hpp"
#include "abut/contact/surface/ridges.hpp"

namespace abut::contact {
namespace {

/// A sharp corner in the plane: facets a -> v and v -> b, the outside on the right.
struct Tip {
    std::int32_t in, out;  // facets
    double sine;           // of half the inner angle
};

std::optional<Tip> tip_at(const SurfaceView<2>& facets, const Ridge& ridge) {
    if (!is_sharp_corner(facets, ridge)) return std::nullopt;
    const double cosine = facets.normal[ridge.face_1].dot(facets.normal[ridge.face_2]);
    const auto ends_there = [&](std::int32_t facet) {
        return facets.vertices[facets.vertices_of(facet)[1]] == facets.vertices[ridge.vertex_1];
    };
    const bool first_ends = ends_there(ridge.face_1);
    if (first_ends == ends_there(ridge.face_2)) return std::nullopt;
    Tip tip{ridge.face_1, ridge.face_2, std::sqrt(std::max(0.0, 0.5 * (1.0 + cosine)))};
    if (!first_ends) std::swap(tip.in, tip.out);
    return tip.sine > cosine_rounding ? std::optional(tip) : std::nullopt;
}

void append_tip(const SurfaceView<2>& facets, const Tip& tip, Bevels<2>& bevels) {
    const std::int32_t a = facets.vertices_of(tip.in)[0], v_in = facets.vertices_of(tip.in)[1];
    const std::int32_t v_out = facets.vertices_of(tip.out)[0], b = facets.vertices_of(tip.out)[1];
    const double length = std::min(facets.area[tip.in], facets.area[tip.out]), gamma = part_of_edge(tip.sine);
    const double of_a = gamma * length / facets.area[tip.in], of_b = gamma * length / facets.area[tip.out];
    const auto corner = [&](double side) {
        Combination y;
        y.add(a, side * of_a);
        y.add(b, -side * of_b);
        y.add(v_in, 0.5 - side * of_a);
        y.add(v_out, 0.5 + side * of_b);
        return y.append_to(bevels);
    };
    const std::int32_t first = corner(1.0), second = corner(-1.0);
    bevels.corners.push_back({first, second});
    bevels.beside.push_back({std::min(tip.in, tip.out), std::max(tip.in, tip.out)});
    const double width = 4.0 * tip.sine * gamma * length;
    bevels.stiffening.push_back(stiffening(length, width));
    bevels.facing.push_back(bevel_facing(tip.sine));
    bevels.tips.push_back(facets.vertices[v_in]);
    bevels.width = std::max(bevels.width, 0.5 * width);
}

}  // namespace

template <>
Bevels<2> bevels_of(const SurfaceView<2>& facets) {
    Bevels<2> bevels;
    for (const Ridge& ridge : ridges(facets))
        if (const auto tip = tip_at(facets, ridge)) append_tip(facets, *tip, bevels);
    return bevels;
}

template <int Dim>
BevelledSurface<Dim>::BevelledSurface(NodalSurface<Dim> host)
    : host_(std::move(host)), bevels_(bevels_of<Dim>(host_.facets().view())) {
    if (bevels_.size() == 0) return;
    acting_ = host_.with(bevels_);
    for (std::int32_t i = 0; i < bevels_.n_nodes(); ++i) {
        double sum = 0.0;
        for (std::int32_t j = bevels_.offsets[i]; j < bevels_.offsets[i + 1]; ++j) sum += std::abs(bevels_.weight[j]);
        stretch_ = std::max(stretch_, sum);
    }
}

template <int Dim>
bool BevelledSurface<Dim>::may_meet(std::int32_t facet_1, std::int32_t facet_2) const {
    if (!has_bevel(facet_1, facet_2)) return true;
    const std::vector<std::int32_t>& body = acting().facets().body;
    return body[facet_1] != body[facet_2] && !(Dim == 2 && is_bevel(facet_1) && is_bevel(facet_2));
}

template <int Dim>
geometry::PairLaw<Dim> BevelledSurface<Dim>::law_with_bevel(std::int32_t facet_1, std::int32_t facet_2,
                                                            geometry::PairLaw<Dim> law) const {
    for (const std::int32_t facet : {facet_1, facet_2}) {
        if (!is_bevel(facet)) continue;
        const std::size_t bevel = facet - host_.facets().size();
        law.stiffness *= bevels_.stiffening[bevel];
        if (bevels_.facing[bevel].none < law.facing.none) law.facing = bevels_.facing[bevel];
    }
    return law;
}

template <int Dim>
void BevelledSurface<Dim>::append_host_nodes(std::vector<std::int32_t>& nodes) const {
    const std::size_t n = nodes.size();
    for (std::size_t i = 0; i < n; ++i)
        if (const std::int32_t of_bevel = nodes[i] - host_.n_nodes(); of_bevel >= 0)
            nodes.insert(nodes.end(), bevels_.node.begin() + bevels_.offsets[of_bevel],
                         bevels_.node.begin() + bevels_.offsets[of_bevel + 1]);
}

template <int Dim>
Vector<Dim> BevelledSurface<Dim>::corner(PointsView<Dim> x, std::int32_t bevel_node) const {
    Vector<Dim> y = Vector<Dim>::Zero();
    for (std::int32_t j = bevels_.offsets[bevel_node]; j < bevels_.offsets[bevel_node + 1]; ++j)
        y += bevels_.weight[j] * x[bevels_.node[j]];
    return y;
}

template <int Dim>
PointsView<Dim> BevelledSurface<Dim>::place(PointsView<Dim> x, std::vector<Vector<Dim>>& y) const {
    if (!acting_) return x;
    y.resize(static_cast<std::size_t>(acting_->n_nodes()));
    for (std::int32_t i = 0; i < host_.n_nodes(); ++i) y[i] = x[i];
    for (std::int32_t i = 0; i < bevels_.n_nodes(); ++i) y[host_.n_nodes() + i] = corner(x, i);
    return y;
}

template <int Dim>
PointsView<Dim> BevelledSurface<Dim>::place(PointsView<Dim> x, std::span<const std::int32_t> listed,
                                            std::vector<Vector<Dim>>& y) const {
    if (!acting_) return x;
    y.resize(static_cast<std::size_t>(acting_->n_nodes()));
    for (const std::int32_t i : listed) y[i] = i < host_.n_nodes() ? x[i] : corner(x, i - host_.n_nodes());
    return y;
}

template <int Dim>
void BevelledSurface<Dim>::fold(std::vector<std::int32_t>& nodes, std::vector<Vector<Dim>>& gradient) const {
    const auto end = std::ranges::lower_bound(nodes, host_.n_nodes());
    const auto n = static_cast<std::size_t>(end - nodes.begin());
    for (std::size_t i = n; i < nodes.size(); ++i) {
        const std::int32_t of_bevel = nodes[i] - host_.n_nodes();
        for (std::int32_t j = bevels_.offsets[of_bevel]; j < bevels_.offsets[of_bevel + 1]; ++j)
            gradient[static_cast<std::size_t>(std::lower_bound(nodes.begin(), end, bevels_.node[j]) - nodes.begin())] +=
                bevels_.weight[j] * gradient[i];
    }
    nodes.resize(n);
    gradient.resize(n);
}

template <int Dim>
std::vector<std::int32_t> old_acting_facets(const BevelledSurface<Dim>& before, const BevelledSurface<Dim>& after,
                                            std::span<const std::int32_t> old_face_of) {
    std::vector<std::int32_t> old_of_new = old_facets(before.host(), after.host(), old_face_of);
    // By the facets beside it and its number among those between them
    using Place = std::array<std::int32_t, 3>;
    const auto places = [](const Bevels<Dim>& bevels, const auto& old_of) {
        std::map<std::array<std::int32_t, 2>, std::int32_t> count;
        std::vector<Place> all;
        for (const auto& [facet_1, facet_2] : bevels.beside) {
            const auto [lower, upper] = std::minmax({old_of(facet_1), old_of(facet_2)});
            all.push_back({lower, upper, count[{lower, upper}]++});
        }
        return all;
    };
    std::map<Place, std::int32_t> old;
    std::int32_t next = before.host().facets().size();
    for (const Place& place : places(before.bevels(), [](std::int32_t facet) { return facet; })) old[place] = next++;
    for (const Place& place : places(after.bevels(), [&](std::int32_t facet) { return old_of_new[facet]; })) {
        const auto found = place[0] < 0 ? old.end() : old.find(place);
        old_of_new.push_back(found == old.end() ? -1 : found->second);
    }
    return old_of_new;
}

#define ABUT_INSTANTIATE(Dim)                                                                                      \
    template class BevelledSurface<Dim>;                                                                           \
    template std::vector<std::int32_t> old_acting_facets(const BevelledSurface<Dim>&, const BevelledSurface<Dim>&, \
                                                         std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
