#include <cmath>
#include <numbers>

#include "abut/mesh/shapes/gear.hpp"
#include "studies/kinematics/axles.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace gears_part {
namespace {

using std::numbers::pi;

constexpr double spin = 0.05;   // of the first gear at the start [rad/s]
constexpr double drive = 1e-3;  // moment on it [N m]
constexpr double hinge = 2.0;   // stiffness of an axle [N/m]
constexpr double backlash = 0.01, gap = 1e-3;

/// 12 teeth drive 18, which a dashpot resists; both turn as rigid gears would that share the moment.
struct Pair {
    mesh::Gear first{.teeth = 12, .radius = 1.0, .bore = 0.4, .pressure_angle = 25.0 * pi / 180.0, .backlash = backlash};
    mesh::Gear second = first;
    double ratio = 1.5;                             // of the numbers of teeth
    double damping = drive * ratio * ratio / spin;  // [N m s]

    explicit Pair(int cells) {
        first.cells = second.cells = cells;
        first.phase = (backlash - gap) / first.radius;  // its teeth are so far from those that they will drive
        second.teeth = 18;
        second.radius = ratio;
        second.bore = 0.9;
        second.centre = {first.radius + second.radius, 0.0};
        second.phase = pi + pi / second.teeth;
        first.name = "first";
        second.name = "second";
    }
};

solid::Spring<2> axle(std::int32_t body, const mesh::Gear& gear) {
    return {.first = {.body = solid::ground, .position = gear.centre},
            .second = {.body = body, .position = gear.centre, .radius = 1.2 * gear.bore},
            .stiffness = hinge};
}

/// Angles and angular momenta about the axles: what contact has done to each gear is what all else has not.
struct Books {
    Turning first, second;
    double momentum_1 = 0.0, momentum_2 = 0.0, at_start_1 = 0.0, at_start_2 = 0.0, time = 0.0;

    void look(const Pair& pair, const dynamics::RunView<2>& run, const solid::Solid<2>& solid) {
        first.follow(angle_of(run, solid, 0));
        second.follow(angle_of(run, solid, 1));
        momentum_1 = angular_momentum_about(pair.first.centre, run, solid, 0);
        momentum_2 = angular_momentum_about(pair.second.centre, run, solid, 1);
        time = run.time;
        if (run.steps > 0) return;
        at_start_1 = momentum_1;
        at_start_2 = momentum_2;
    }
    /// Means over the run of the moments of contact about the axles [N m].
    [[nodiscard]] double moment_on_first() const { return (momentum_1 - at_start_1) / time - drive; }
    [[nodiscard]] double moment_on_second(const Pair& pair) const {
        return (momentum_2 - at_start_2 + pair.damping * second.total()) / time;
    }
};

void mesh_gears(Kinematics kinematics, bool filter, const Options& options, const Sink& sink) {
    const Pair pair(options.quick ? 2 : 4);
    const double turns = options.quick ? 0.5 : options.turns;
    Case<2> one = case_of<2>("gears", {gear(pair.first), gear(pair.second)}, kinematics);
    one.motion[0].spin = AxialVector<2>(spin);
    one.motion[1].spin = AxialVector<2>(-spin / pair.ratio);
    one.is_free = false;
    one.scene.solid.springs = {axle(0, pair.first), axle(1, pair.second)};
    one.scene.solid.moments = {{.body = 0, .moment = AxialVector<2>(drive)},
                               {.body = 1, .moment = AxialVector<2>::Zero(), .damping = pair.damping}};
    one.scene.time = turns * 2.0 * pi / spin;
    one.run.filter = filter;
    one.run.interval = 10;
    Books books;
    const Watch<2> watch = [&](const auto& run, const auto& solid) { books.look(pair, run, solid); };
    Row row = row_of<2>(one, run::name_of(kinematics) + (filter ? ", filter" : ""), options, nullptr, watch);
    // Teeth bend and have their play, by the same angle after half a turn and after ten.
    row.quantities.at_most("turns of the first gear", books.first.total() / (2.0 * pi));
    row.quantities.near("ratio of turns", -books.first.total() / books.second.total(), pair.ratio,
                        options.quick ? 1e-2 : 1e-3);
    row.quantities.near("ratio of the moments of contact", books.moment_on_second(pair) / books.moment_on_first(),
                        pair.ratio, options.quick ? no_target : 0.02);
    row.quantities.at_most("mean moment on the first gear, over the drive", -books.moment_on_first() / drive);
    row.quantities.at_most("H - H~", row.run->excess, 0.05);
    sink(row);
}

}  // namespace
}  // namespace gears_part

void run_gears(const Options& options, const Sink& sink) {
    using namespace gears_part;
    for (const Kinematics kinematics : {Kinematics::floating, Kinematics::rigid})
        for (const bool filter : {false, true}) mesh_gears(kinematics, filter, options, sink);
}

}  // namespace abut::studies::kinematics
