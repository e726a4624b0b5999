#include "abut/contact/engine/nodal_stable_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::contact {
namespace {

constexpr double margin = 0.85;

/// Increase of omega^2 by contact at worst, at a node of a body.
struct Raise {
    double omega_squared = 0.0;
    std::int32_t node = -1;
};

/// k of a body in series with its stiffest partner; 0 without any, or where it is rigid itself.
template <int Dim>
double worst_stiffness(const NodalSurface<Dim>& surface, std::int32_t body) {
    if (surface.is_rigid(body)) return 0.0;
    double partner = 0.0;
    for (std::int32_t other = 0; other < surface.n_bodies(); ++other)
        if (other != body) partner = std::max(partner, surface.stiffness(other));
    return partner == 0.0 ? 0.0 : series_stiffness(surface.stiffness(body), partner);
}

template <int Dim>
std::vector<Raise> raises(const NodalSurface<Dim>& surface, std::span<const double> mass) {
    std::vector<double> area(static_cast<std::size_t>(surface.n_nodes()), 0.0);  // of the faces at a node, its share
    const Surface<Dim>& facets = surface.facets();
    for (std::size_t i = 0; i < facets.face_vertices.size(); ++i)
        area[static_cast<std::size_t>(facets.face_vertices[i])] += facets.area[i / Dim] / Dim;
    std::vector<double> stiffness(static_cast<std::size_t>(surface.n_bodies()));
    for (std::int32_t body = 0; body < surface.n_bodies(); ++body) stiffness[body] = worst_stiffness(surface, body);

    std::vector<Raise> of_body(stiffness.size());
    for (std::size_t i = 0; i < facets.face_vertices.size(); ++i) {
        const std::int32_t body = facets.body[i / Dim], node = facets.face_vertices[i];
        if (surface.is_rigid(body)) continue;
        if (!(mass[node] > 0.0))
            throw BadInput("nodal contact: node " + std::to_string(node) + " of body " + std::to_string(body) +
                               " has the mass " + number(mass[node]) + " kg; it must be > 0 where a face is deformable.",
                           {.value = mass[node]});
        const double raise = stiffness[body] * area[node] / mass[node];
        if (raise > of_body[body].omega_squared) of_body[body] = {raise, node};
    }
    return of_body;
}

}  // namespace

template <int Dim>
NodalStableStep estimate_stable_step(const NodalSurface<Dim>& surface, std::span<const double> mass, double omega_free) {
    if (mass.size() != static_cast<std::size_t>(surface.n_nodes()))
        throw BadInput("nodal contact: masses of " + std::to_string(mass.size()) + " nodes are given, the surface has " +
                       std::to_string(surface.n_nodes()) + "; give one each.");
    if (!(omega_free >= 0.0) || !std::isfinite(omega_free))
        throw BadInput("nodal contact: the highest frequency without contact is " + number(omega_free) +
                           " rad/s; it must be finite and >= 0. dynamics::highest_mode finds it.",
                       {.value = omega_free});
    std::vector<Raise> of_body = raises(surface, mass);
    std::ranges::stable_sort(of_body, std::greater<>{}, &Raise::omega_squared);
    of_body.resize(std::min<std::size_t>(of_body.size(), 2));  // two bodies touch at worst
    NodalStableStep step{.omega_free = omega_free, .node = -1};
    double omega_squared = omega_free * omega_free;
    for (const Raise& raise : of_body) omega_squared += raise.omega_squared;
    step.omega = std::sqrt(omega_squared);
    step.dt = step.omega > 0.0 ? margin * 2.0 / step.omega : std::numeric_limits<double>::infinity();
    if (!of_body.empty()) step.node = of_body.front().node;
    step.reason = step.node < 0
                      ? "nothing can touch: the step is that of the host alone, with a margin of 0.85."
                      : "contact at node " + std::to_string(step.node) + " raises omega from " + number(omega_free) +
                            " to " + number(step.omega) + " rad/s, by estimate; the margin is 0.85.";
    return step;
}

template NodalStableStep estimate_stable_step(const NodalSurface<2>&, std::span<const double>, double);
template NodalStableStep estimate_stable_step(const NodalSurface<3>&, std::span<const double>, double);

}  // namespace abut::contact
