#include "studies/scenes/two_cylinders.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/result.hpp"

namespace abut::studies {
namespace {

constexpr double body_radius = 1.0;             // [m]
constexpr double crossings_after_touch = 10.0;  // after the first touch, of R / sqrt(E / rho): impact, slip and release

/// From the left centre to the right one, at the start and where they touch.
Vector<2> normal(const TwoCylinders& options) {
    const auto centre = centres(options);
    return (centre[1] - centre[0]).normalized();
}

/// Smaller cells about the point of a body that is nearest to the other one.
template <int Dim>
std::optional<mesh::Refinement<Dim>> refinement(const TwoCylinders& options, std::size_t body) {
    if (options.refine == 1.0) return {};
    const auto centre = centres(options);
    Vector<Dim> nearest = Vector<Dim>::Zero();
    const Vector<2> in_plane = centre[body] + body_radius * (centre[1 - body] - centre[body]).normalized();
    std::ranges::copy(in_plane, nearest.begin());
    return mesh::Refinement<Dim>{nearest, options.size / options.refine, options.refine_over};
}

template <int Dim>
mesh::Mesh<Dim> cylinder(const TwoCylinders& options, std::size_t body) {
    static constexpr std::array<const char*, 2> names{"left", "right"};
    const Vector<2> centre = centres(options)[body];
    const int variant = static_cast<int>(body);  // two meshes that never match by accident
    if constexpr (Dim == 2)
        return mesh::disc({.centre = centre,
                           .radius = body_radius,
                           .size = options.size,
                           .refinement = refinement<2>(options, body),
                           .variant = variant,
                           .name = names[body]});
    else
        return mesh::cylinder({.centre = {centre.x(), centre.y(), 0.0},
                               .radius = body_radius,
                               .length = 1.0,
                               .size = options.size,
                               .refinement = refinement<3>(options, body),
                               .variant = variant,
                               .name = names[body]});
}

template <int Dim>
double restitution(const TwoCylinders& options, const run::RunResult<Dim>& result) {
    const auto separation = [&](const std::vector<solid::BodyMotion<Dim>>& bodies) {
        return (bodies[1].velocity - bodies[0].velocity).template head<2>().dot(normal(options));
    };
    return -separation(result.bodies.end) / separation(result.bodies.start);
}

}  // namespace

std::array<Vector<2>, 2> centres(const TwoCylinders& options) {
    const double distance = 2.0 * body_radius + options.gap;
    const double along_x = std::sqrt(std::max(0.0, distance * distance - options.offset * options.offset));
    const Vector<2> half(0.5 * along_x, 0.5 * options.offset);
    return {Vector<2>(-half), half};
}

template <int Dim>
run::Scene<Dim> two_cylinders(const TwoCylinders& options) {
    const std::array<mesh::Mesh<Dim>, 2> bodies{cylinder<Dim>(options, 0), cylinder<Dim>(options, 1)};
    run::Scene<Dim> scene{.mesh = mesh::combine<Dim>(bodies)};
    scene.mesh.name = "scene";
    scene.solid.law = solid::ContactLaw::reconstruction;  // that of the talk
    scene.solid.materials.assign(2, {1.0, 0.3, 1.0, 1.0});
    for (const double direction : {1.0, -1.0}) scene.velocity.push_back(direction * options.speed * Vector<Dim>::UnitX());
    const double approach = options.gap / (2.0 * options.speed * std::max(normal(options).x(), 0.01));
    scene.time = approach + crossings_after_touch * body_radius;
    scene.findings = [options](const run::RunResult<Dim>& result) -> std::vector<run::Finding> {
        return {{"restitution", "restitution along the line of centres", restitution<Dim>(options, result)}};
    };
    scene.remedy_if_overlapping = "Raise the gap.";
    return scene;
}

template run::Scene<2> two_cylinders<2>(const TwoCylinders&);
template run::Scene<3> two_cylinders<3>(const TwoCylinders&);

}  // namespace abut::studies
