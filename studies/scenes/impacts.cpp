#include "studies/scenes/impacts.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <numbers>

#include "abut/base/stopwatch.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/contact_view.hpp"
#include "apps/support/log.hpp"
#include "apps/support/progress.hpp"

namespace abut::studies {
namespace {

constexpr double crossings = 6.0;            // of a disc by a wave, that a collision of discs is given
constexpr double duration_factor = 2.94392;  // 2 times the integral of (1 - x^(5/2))^(-1/2) over [0, 1]

/// Centres of mass and total momenta of the first bodies.
template <int Dim>
struct Bodies {
    std::array<double, 2> mass{};
    std::array<Vector<Dim>, 2> displacement{Vector<Dim>::Zero(), Vector<Dim>::Zero()};
    std::array<Vector<Dim>, 2> momentum{Vector<Dim>::Zero(), Vector<Dim>::Zero()};
    Vector<Dim> impulse = Vector<Dim>::Zero();  // on body 0, p^{n+1/2} - p^{n-1/2}
};

template <int Dim>
Bodies<Dim> add_up(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
    Bodies<Dim> bodies;
    const auto u = as_vectors<Dim>(run.q);
    const auto before = as_vectors<Dim>(run.p_before), after = as_vectors<Dim>(run.p_after);
    for (std::size_t i = 0; i < u.size(); ++i) {
        const auto body = static_cast<std::size_t>(solid.body_of_points()[i]);
        const double mass = solid.masses()[i];
        bodies.mass[body] += mass;
        bodies.displacement[body] += mass * u[i];
        bodies.momentum[body] += run.momentum(static_cast<std::ptrdiff_t>(i));
        if (body == 0) bodies.impulse += after[i] - before[i];
    }
    for (std::size_t body = 0; body < 2; ++body)
        if (bodies.mass[body] > 0.0) bodies.displacement[body] /= bodies.mass[body];
    return bodies;
}

/// Angular momentum of body 0 about its centre of mass, over its moment of inertia at rest [rad/s].
double spin(const dynamics::RunView<2>& run, const solid::Solid<2>& solid) {
    const mesh::Mesh<2>& mesh = solid.mesh();
    Vector<2> centre = Vector<2>::Zero();
    double mass = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells() && mesh.cell_body[c] == 0; ++c) {
        mass += solid.masses()[c];
        centre += solid.masses()[c] * solid.rest_positions()[c];
    }
    centre /= mass;
    double momentum = 0.0, inertia = 0.0;
    for (std::int32_t c = 0; c < mesh.n_cells() && mesh.cell_body[c] == 0; ++c) {
        const Vector<2> r = solid.rest_positions()[c] - centre, p = run.momentum(c);
        momentum += r.x() * p.y() - r.y() * p.x();
        inertia += solid.masses()[c] * r.squaredNorm();
    }
    return momentum / inertia;
}

}  // namespace

run::Scene<2> dropped_disc(const DroppedDisc& options) {
    run::Scene<2> scene;
    scene.mesh =
        mesh::disc({.centre = {0.0, options.radius + options.height}, .radius = options.radius, .size = options.size});
    scene.solid.law = solid::ContactLaw::reconstruction;  // figures of docs/validation.md
    scene.solid.materials = {{.young = options.young, .poisson = options.poisson, .density = options.density}};
    scene.solid.acceleration = {Vector<2>(0.0, -options.gravity)};
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 4.0 * options.radius)};
    scene.velocity = {Vector<2>::Zero()};
    const double weight = options.density * std::numbers::pi * options.radius * options.radius * options.gravity;
    scene.energy_scale = {"H0", weight * options.height};
    scene.time = 4.0 * std::sqrt(2.0 * options.height / options.gravity);
    scene.remedy_if_overlapping = "The disc is one body.";
    return scene;
}

run::Scene<2> two_discs(const TwoDiscs& options) {
    const double distance = 2.0 * options.radius;
    const double along = std::sqrt(distance * distance - options.offset * options.offset) + options.gap;
    const Vector<2> half(0.5 * along, 0.5 * options.offset);
    const auto disc = [&](const Vector<2>& centre, int variant, const char* name) {
        return mesh::disc(
            {.centre = centre, .radius = options.radius, .size = options.size, .variant = variant, .name = name});
    };
    run::Scene<2> scene;
    scene.mesh = mesh::combine<2>(std::vector{disc(-half, 0, "left"), disc(half, 1, "right")});
    scene.solid.law = solid::ContactLaw::reconstruction;  // figures of docs/validation.md
    scene.solid.materials.assign(2, {.young = options.young, .poisson = options.poisson, .density = options.density});
    scene.velocity = {options.speed * Vector<2>::UnitX(), -options.speed * Vector<2>::UnitX()};
    scene.time =
        options.gap / (2.0 * options.speed) + crossings * 2.0 * options.radius * std::sqrt(options.density / options.young);
    scene.remedy_if_overlapping = "Raise the gap.";
    return scene;
}

HertzImpact hertz_impact(const TwoSpheres& options) {
    const double radius = 0.5 * options.radius;
    const double modulus = 0.5 * options.young / (1.0 - options.poisson * options.poisson);
    const double mass = 0.5 * options.density * 4.0 / 3.0 * std::numbers::pi * std::pow(options.radius, 3);
    const double v = options.speed;
    const double approach = std::pow(15.0 * mass * v * v / (16.0 * modulus * std::sqrt(radius)), 0.4);
    return {.approach = approach,
            .force = 4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(approach, 1.5),
            .duration = duration_factor * approach / v,
            .contact_radius = std::sqrt(radius * approach)};
}

run::Scene<3> two_spheres(const TwoSpheres& options) {
    const HertzImpact hertz = hertz_impact(options);
    const double size = hertz.contact_radius / options.faces;
    const double gap = options.gap * hertz.approach;
    const auto sphere = [&](double side, int variant, const char* name) {
        return mesh::sphere({.centre = side * (options.radius + 0.5 * gap) * Vector<3>::UnitX(),
                             .radius = options.radius,
                             .size = options.coarse * options.radius,
                             .refinement = mesh::Refinement<3>{side * 0.5 * gap * Vector<3>::UnitX(), size, options.radius,
                                                               1.3 * hertz.contact_radius},
                             .variant = variant,
                             .name = name});
    };
    run::Scene<3> scene;
    scene.mesh = mesh::combine<3>(std::vector{sphere(-1.0, 0, "left"), sphere(1.0, 1, "right")});
    scene.solid.law = solid::ContactLaw::reconstruction;  // figures of docs/validation.md
    scene.solid.materials.assign(2, {.young = options.young, .poisson = options.poisson, .density = options.density});
    const double speed = 0.5 * options.speed;
    scene.velocity = {speed * Vector<3>::UnitX(), -speed * Vector<3>::UnitX()};
    scene.time = gap / options.speed + 1.2 * hertz.duration;
    scene.remedy_if_overlapping = "Raise the gap.";
    return scene;
}

template <int Dim>
void ImpactObserver<Dim>::begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    spdlog::info("{} cells; {} steps of {:.4g} s", scene.mesh.n_cells(), result.run.steps, result.run.dt);
    apps::log_warnings(apps::only(run::warnings_before(scene, result), {run::WarningKind::blind_corners}));
}

template <int Dim>
void ImpactObserver<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    const Bodies<Dim> bodies = add_up(run, solid);
    const double dt = samples_.empty() ? 0.0 : run.time - samples_.back().time;
    Sample sample{.time = run.time, .force = Vector<Dim>::Zero(), .displacement = bodies.displacement, .spin = 0.0};
    if (dt > 0.0) sample.force = bodies.impulse / dt;
    for (std::size_t body = 0; body < 2; ++body)
        sample.velocity[body] =
            bodies.mass[body] > 0.0 ? Vector<Dim>(bodies.momentum[body] / bodies.mass[body]) : Vector<Dim>::Zero();
    if constexpr (Dim == 2) sample.spin = spin(run, solid);
    sample.in_contact = solid.contact().report().active_pairs > 0;
    if (sample.in_contact) {
        if (std::isnan(first_)) first_ = run.time - dt;
        last_ = run.time;
    }
    samples_.push_back(sample);
}

template <int Dim>
ImpactRun<Dim> run_impact(const run::Scene<Dim>& scene, const run::RunOptions& options) {
    ImpactRun<Dim> run;
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        apps::ShowProgress<Dim> progress;
        run::Observers<Dim> observers{run.observer, progress};
        run.result = run::simulate<Dim>(scene, options, observers);
    }
    run.seconds = seconds;
    apps::log_warnings(run::without_notes(run::warnings_after(run.result)), fmt::format("{} cells", scene.mesh.n_cells()));
    return run;
}

template class ImpactObserver<2>;
template class ImpactObserver<3>;
template ImpactRun<2> run_impact(const run::Scene<2>&, const run::RunOptions&);
template ImpactRun<3> run_impact(const run::Scene<3>&, const run::RunOptions&);

}  // namespace abut::studies
