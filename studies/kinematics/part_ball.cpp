#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/shapes.hpp"
#include "studies/kinematics/rows.hpp"

namespace abut::studies::kinematics {
namespace ball_part {
namespace {

constexpr double radius = 1.0, speed = 0.01, gap = 1e-3, hardness = 1e4;

/// Hertz's figures of a rigid ball of radius and density 1 on a half space of E = 1 and nu = 0.3.
struct Hertz {
    double modulus = 1.0 / (1.0 - 0.3 * 0.3);
    double mass = 4.0 / 3.0 * std::numbers::pi;
    double depth = std::pow(15.0 * mass * speed * speed / (16.0 * modulus * std::sqrt(radius)), 0.4);
    double time = 2.94392 * depth / speed;
    double contact_radius = std::sqrt(radius * depth);
};

struct Size {
    double block;  // of a cell at the contact [m]
    double ball;
    double extent;     // half a side of the block, which is as deep
    double far = 1.5;  // of a cell far away
};

Case<3> ball_on_block(const Size& size, Kinematics kinematics) {
    const Hertz hertz;
    const Vector<3> lower(-size.extent, -size.extent, -size.extent), upper(size.extent, size.extent, 0.0);
    const double near = 1.2 * hertz.contact_radius;
    const auto box =
        mesh::box<3>({.lower = lower,
                      .upper = upper,
                      .size = size.far,
                      .refinement = mesh::Refinement<3>{Vector<3>::Zero(), size.block, 4.0 * (size.far - size.block), near},
                      .name = "block"});
    const Vector<3> centre(0.0, 0.0, radius + gap);
    const auto sphere = mesh::sphere({.centre = centre,
                                      .radius = radius,
                                      .size = 0.4,
                                      .refinement = mesh::Refinement<3>{Vector<3>(0.0, 0.0, gap), size.ball, 1.0, near},
                                      .name = "ball"});
    Case<3> one = case_of<3>("ball on a block", {box, sphere}, kinematics);
    one.scene.solid.kinematics = {kinematics, Kinematics::rigid};
    one.scene.solid.law = solid::ContactLaw::pair_potential;
    one.scene.solid.materials[1].young = hardness;
    one.motion[1].velocity = {0.0, 0.0, -speed};
    one.scene.time = gap / speed + 1.25 * hertz.time;
    return one;
}

/// The skin of the ball is that of E = 1e4, and the bound for its step knows nothing of what it meets: the stable step
/// of the block alone is the one that counts.
double step_of(const Case<3>& one) {
    Case<3> soft = one;
    soft.scene.solid.materials[1].young = 1e-2;
    const solid::Solid<3> solid(soft.scene.mesh, run::solid_options<3>(soft.scene, soft.run));
    return 0.8 * dynamics::stable_step(const_cast<solid::Solid<3>&>(solid)).dt;
}

void bounce(const Size& size, Kinematics kinematics, double allowed, const Options& options, const Sink& sink) {
    Case<3> one = ball_on_block(size, kinematics);
    one.run.dt = step_of(one);
    one.run.allow_unstable = true;
    one.run.filter = true;
    const Hertz hertz;
    double first = 0.0, last = 0.0;
    const Watch<3> watch = [&](const auto& run, const auto& solid) {
        if (run.steps == 0 || solid.contact_counts().active_pairs == 0) return;
        if (first == 0.0) first = run.time;
        last = run.time;
    };
    CaseResult<3> result;
    const std::string setting =
        fmt::format("{}, a/h {:.2g}, ball {:.2g}, L {:g}", run::name_of(kinematics), hertz.contact_radius / size.block,
                    hertz.contact_radius / size.ball, size.extent);
    Row row = row_of<3>(one, setting, options, &result, watch);
    row.quantities.near("touches for [s]", last - first, hertz.time, allowed);
    if (!result.velocity.empty())
        row.quantities.near("velocity after over that before", result.velocity[1].z() / speed, 1.0);
    row.quantities.at_most("H - H~", row.run->excess, 0.05);
    sink(row);
}

}  // namespace
}  // namespace ball_part

void run_ball(const Options& options, const Sink& sink) {
    using namespace ball_part;
    if (options.quick) return bounce({.block = 0.15, .ball = 0.15, .extent = 3.0}, Kinematics::floating, 0.2, options, sink);
    for (const double size : {0.1, 0.06})
        bounce({.block = size, .ball = size, .extent = 7.0}, Kinematics::floating, size < 0.08 ? 0.03 : no_target, options,
               sink);
    bounce({.block = 0.1, .ball = 0.1, .extent = 4.0}, Kinematics::floating, no_target, options, sink);
    bounce({.block = 0.1, .ball = 0.05, .extent = 7.0}, Kinematics::floating, no_target, options, sink);
    bounce({.block = 0.1, .ball = 0.1, .extent = 7.0}, Kinematics::small, no_target, options, sink);
}

}  // namespace abut::studies::kinematics
