#include "abut/contact/surface/side_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "abut/contact/surface/ridges.hpp"
#include "abut/contact/surface/sharp_edges.hpp"

namespace abut::contact {
namespace {

constexpr float all_around = std::numeric_limits<float>::infinity();
constexpr double endless = std::numeric_limits<double>::infinity();

/// Faces deform, and are seen from aside: directions this near to a side are on it, and the pair is admitted [rad].
constexpr double angle_tolerance = 0.1;

template <int Dim>
bool looks_elsewhere(const SurfaceView<Dim>& facets, std::int32_t facet_1, std::int32_t facet_2) {
    return facets.normal[facet_1].dot(facets.normal[facet_2]) < sharp_edge_cosine;
}

/// The corner of a facet at the position of a vertex.
template <int Dim>
int corner_at(const SurfaceView<Dim>& facets, std::int32_t facet, std::int32_t vertex) {
    for (int i = 0; i < Dim; ++i)
        if (facets.vertices[facets.face_vertices[Dim * facet + i]] == facets.vertices[vertex]) return i;
    return -1;
}

/// Facet beyond an edge of a triangle.
struct Beyond {
    std::int32_t facet = -1;  // -1: nothing
    int edge = -1;            // the same edge, of that facet
    bool is_convex = false;
};

int next(int corner) { return (corner + 1) % 3; }
int previous(int corner) { return (corner + 2) % 3; }

/// By three times the facet and the corner where the edge begins.
std::vector<Beyond> beyond_edges(const SurfaceView<3>& facets) {
    std::vector<Beyond> beyond(3 * static_cast<std::size_t>(facets.size()));
    const auto edge_of = [&](std::int32_t facet, const Ridge& ridge) {
        const int a = corner_at(facets, facet, ridge.vertex_1), b = corner_at(facets, facet, ridge.vertex_2);
        return next(a) == b ? a : b;
    };
    for (const Ridge& ridge : ridges(facets)) {
        const int edge_1 = edge_of(ridge.face_1, ridge), edge_2 = edge_of(ridge.face_2, ridge);
        const bool convex = is_convex(facets, ridge);
        beyond[3 * ridge.face_1 + edge_1] = {ridge.face_2, edge_2, convex};
        beyond[3 * ridge.face_2 + edge_2] = {ridge.face_1, edge_1, convex};
    }
    return beyond;
}

double angle_at(const SurfaceView<3>& facets, std::int32_t facet, int corner) {
    const auto vertex = [&](int i) { return facets.vertices[facets.face_vertices[3 * facet + i]]; };
    const Vector<3> a = vertex(next(corner)) - vertex(corner), b = vertex(previous(corner)) - vertex(corner);
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The angle by which the side of `facet` goes on around one of its corners, beyond the edge to the next corner or that
/// to the previous one: the sum of the angles of its facets there.
float reach(const SurfaceView<3>& facets, const std::vector<Beyond>& beyond, std::int32_t facet, int corner,
            bool past_next) {
    const std::int32_t vertex = facets.face_vertices[3 * facet + corner];
    double sum = 0.0;
    std::int32_t at = facet;
    for (int edge = past_next ? corner : previous(corner);;) {
        const Beyond& there = beyond[3 * at + edge];
        if (there.facet == facet) return all_around;
        if (there.facet < 0) return static_cast<float>(sum);
        if (looks_elsewhere(facets, facet, there.facet)) return there.is_convex ? static_cast<float>(sum) : all_around;
        at = there.facet;
        const int corner_there = corner_at(facets, at, vertex);
        sum += angle_at(facets, at, corner_there);
        edge = there.edge == corner_there ? previous(corner_there) : corner_there;
    }
}

/// Along both flanks of a sharp corner, as long as they look the way they do there: half the thickness, half the
/// distance from the corner times the sine of the angle between them. Places are twice the facet and the corner.
void bound_by_thickness(const SurfaceView<2>& facets, const std::vector<std::int32_t>& beyond, const Ridge& ridge,
                        std::vector<double>& deepest) {
    const double cosine = facets.normal[ridge.face_1].dot(facets.normal[ridge.face_2]);
    const double half_sine = 0.5 * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double enough = 2.0 * *std::ranges::max_element(facets.cell_depth);  // no contact is admitted deeper
    for (const std::int32_t first : {ridge.face_1, ridge.face_2}) {
        double distance = 0.0;
        std::int32_t place = 2 * first + corner_at(facets, first, ridge.vertex_1);
        while (distance * half_sine < enough) {
            distance += facets.area[place / 2];
            place ^= 1;  // the other end
            const std::int32_t next = beyond[place];
            if (next < 0 || looks_elsewhere(facets, first, next / 2)) break;
            for (const std::int32_t end : {place, next}) deepest[end] = std::min(deepest[end], distance * half_sine);
            place = next;
        }
    }
}

}  // namespace

SideOutlines<2>::SideOutlines(const SurfaceView<2>& facets) : deepest_(2 * static_cast<std::size_t>(facets.size()), 0.0) {
    const std::vector<Ridge> corners = ridges(facets);
    std::vector<std::int32_t> beyond(deepest_.size(), -1);  // place of the corner of the next facet, by place
    for (const Ridge& ridge : corners) {
        const std::int32_t place_1 = 2 * ridge.face_1 + corner_at(facets, ridge.face_1, ridge.vertex_1);
        const std::int32_t place_2 = 2 * ridge.face_2 + corner_at(facets, ridge.face_2, ridge.vertex_1);
        beyond[place_1] = place_2;
        beyond[place_2] = place_1;
        const bool ends = looks_elsewhere(facets, ridge.face_1, ridge.face_2) && is_convex(facets, ridge);
        deepest_[place_1] = deepest_[place_2] = ends ? 0.0 : endless;
    }
    for (const Ridge& ridge : corners)
        if (is_sharp_corner(facets, ridge)) bound_by_thickness(facets, beyond, ridge, deepest_);
}

SideOutlines<3>::SideOutlines(const SurfaceView<3>& facets)
    : reach_(3 * static_cast<std::size_t>(facets.size())), goes_on_(reach_.size(), 0) {
    const std::vector<Beyond> beyond = beyond_edges(facets);
    for (std::int32_t facet = 0; facet < facets.size(); ++facet)
        for (int corner = 0; corner < 3; ++corner) {
            const std::size_t i = 3 * static_cast<std::size_t>(facet) + corner;
            const Beyond& there = beyond[i];
            goes_on_[i] = there.facet >= 0 && !(there.is_convex && looks_elsewhere(facets, facet, there.facet)) ? 1 : 0;
            reach_[i] = {reach(facets, beyond, facet, corner, true), reach(facets, beyond, facet, corner, false)};
        }
}

double SideOutlines<3>::deepest_past(std::int32_t facet, const geometry::OutlinePart& part) const {
    return goes_on(facet, part) ? endless : 0.0;
}

bool SideOutlines<3>::goes_on(std::int32_t facet, const geometry::OutlinePart& part) const {
    const std::size_t first = 3 * static_cast<std::size_t>(facet);
    if (part.corner < 0) return goes_on_[first + part.edge] != 0;
    const Reach& reach = reach_[first + part.corner];
    return part.past_next <= reach.past_next + angle_tolerance ||
           part.past_previous <= reach.past_previous + angle_tolerance;
}

}  // namespace abut::contact
