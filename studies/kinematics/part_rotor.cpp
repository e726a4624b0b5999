#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "abut/solid/contact_view.hpp"
#include "studies/kinematics/axles.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/kinematics/shapes.hpp"

namespace abut::studies::kinematics {
namespace rotor_part {
namespace {

using std::numbers::pi;

constexpr double spin = 0.05, arm = 1.0, counter = 0.2, half = 0.1;  // of the rotor: rad/s, ends from the axle, half a side
constexpr double rotor_centre = 0.5 * (arm - counter);               // from the axle
constexpr double width = 0.8, height = 0.2, clear = 0.95;            // of a plate, and how far it is from the axle
constexpr double stiffness = 0.02, damping = 0.003;                  // of both springs of a plate together
constexpr double density = 10.0, hinge = 20.0, drive = 2e-5;         // of a rotor that is a body
constexpr std::int32_t plates = 2;

/// A plate over the axle and one under it, each on two springs of no length, which pull its ends back to where they are at
/// rest. All cells hold them: their mean pulls the centre of mass, however the plate bends and turns.
void hold_plates(Case<2>& one) {
    for (std::int32_t body = 0; body < plates; ++body)
        for (const double side : {-1.0, 1.0}) {
            const Vector<2> end(0.4 * side * width, (body == 0 ? 1.0 : -1.0) * (clear + 0.5 * height));
            one.scene.solid.springs.push_back({.first = {.body = solid::ground, .position = end},
                                               .second = {.body = body, .position = end, .radius = 2.0 * width},
                                               .stiffness = 0.5 * stiffness,
                                               .damping = 0.5 * damping});
        }
}

mesh::Mesh<2> plate(double side, int cells) {
    return turned_box<2>({.centre = {0.0, side * (clear + 0.5 * height)},
                          .sides = {width, height},
                          .cells = {4 * cells, cells},
                          .name = side > 0.0 ? "upper" : "lower"});
}

/// Follows the plates: the free vibration of the upper one between the hits, and all impulses on both.
class PlateWatch {
public:
    void look(const dynamics::RunView<2>& run, const solid::Solid<2>& solid) {
        const Centre upper = centre_of(run, solid, 0), lower = centre_of(run, solid, 1);
        const Vector<2> shift = upper.shift + lower.shift, momentum = upper.momentum + lower.momentum;
        const double dt = run.time - time_before_;
        const Vector<2> push = push_of_rotor(run, solid, dt);
        if (run.steps == 0) {
            start_ = momentum;
        } else {
            // As steps take them: springs at the mean of both ends, dashpots at that of the rates of this step and the
            // one before.
            const Vector<2> step = shift - shift_;
            springs_ -= 0.5 * (stiffness * dt * (shift_ + shift) + damping * (step_ + step));
            step_ = step;
            rotor_ += push;
            largest_ = std::max(largest_, rotor_.norm());
            lack_ = std::max(lack_, (momentum - start_ - springs_ - rotor_).norm());
        }
        shift_ = shift;
        follow_free_flight(upper.shift.y(), run.time, solid.contact_counts().active_pairs > 0);
        upper_before_ = upper.shift.y();
        time_before_ = run.time;
    }
    [[nodiscard]] double turned() const { return turning_.total(); }  ///< the rotor that is a body [rad]
    [[nodiscard]] double period() const { return half_periods_ > 0 ? 2.0 * in_them_ / half_periods_ : 0.0; }
    [[nodiscard]] int half_periods() const { return half_periods_; }
    [[nodiscard]] double lack_of_impulse() const { return lack_ / largest_; }

private:
    /// Its impulse on the plates in the last step: as an obstacle says, or as a body has lost to other things than its
    /// hinge.
    Vector<2> push_of_rotor(const dynamics::RunView<2>& run, const solid::Solid<2>& solid, double dt) {
        if (!solid.options().obstacles.empty()) return -dt * solid.contact().obstacle_force(0);
        const Centre centre = centre_of(run, solid, plates);
        const double angle = angle_of(run, solid, plates);
        turning_.follow(angle);
        const Vector<2> from_axle(rotor_centre, 0.0), axle = from_axle + centre.shift - rotation(angle) * from_axle;
        const Vector<2> push = momentum_of_rotor_ - centre.momentum - 0.5 * hinge * dt * (axle_ + axle);
        momentum_of_rotor_ = centre.momentum;
        axle_ = axle;
        return push;
    }
    /// Half periods lie between two passages through the position at rest without a contact since.
    void follow_free_flight(double at, double time, bool touches) {
        if (touches) {
            last_passage_.reset();
        } else if (at * upper_before_ < 0.0) {
            const double passage = time - (time - time_before_) * at / (at - upper_before_);
            if (last_passage_) in_them_ += passage - *last_passage_, ++half_periods_;
            last_passage_ = passage;
        }
    }

    Vector<2> start_ = Vector<2>::Zero(), springs_ = Vector<2>::Zero(), rotor_ = Vector<2>::Zero();
    Vector<2> shift_ = Vector<2>::Zero(), step_ = Vector<2>::Zero();
    Vector<2> momentum_of_rotor_ = Vector<2>::Zero(), axle_ = Vector<2>::Zero();
    Turning turning_;
    double upper_before_ = 0.0, time_before_ = 0.0, in_them_ = 0.0, lack_ = 0.0, largest_ = 0.0;
    std::optional<double> last_passage_;
    int half_periods_ = 0;
};

/// Between the hits: of a mass on a spring with a dashpot.
double free_period() {
    const double mass = width * height, decay = 0.5 * damping / mass;
    return 2.0 * pi / std::sqrt(stiffness / mass - decay * decay);
}

/// The outline of the rotor, which starts along x.
contact::RigidObstacle<2> driven_rotor() {
    contact::RigidObstacle<2> rotor =
        wall_along({{-counter, -half}, {-counter, half}, {arm, half}, {arm, -half}, {-counter, -half}});
    rotor.placement = [](double time) {
        return contact::Placement<2>{.turn = rotation(spin * time), .offset = Vector<2>::Zero()};
    };
    return rotor;
}

Case<2> sprung_plates(std::vector<mesh::Mesh<2>> more, Kinematics kinematics, bool filter, const Options& options) {
    const int cells = options.quick ? 2 : 4;
    std::vector<mesh::Mesh<2>> meshes{plate(1.0, cells), plate(-1.0, cells)};
    meshes.insert(meshes.end(), more.begin(), more.end());
    Case<2> one = case_of<2>("rotor", meshes, kinematics);
    hold_plates(one);
    one.is_free = false;
    one.scene.energy_scale = {"E0", 0.5 * stiffness * std::pow(arm - clear, 2)};
    one.scene.time = (options.quick ? 1.0 : 5.0) * 2.0 * pi / spin;
    one.run.filter = filter;
    one.run.interval = 10;
    return one;
}

void report(Case<2>& one, const std::string& setting, const Options& options, const Sink& sink) {
    PlateWatch seen;
    const Watch<2> watch = [&](const auto& run, const auto& solid) { seen.look(run, solid); };
    Row row = row_of<2>(one, setting, options, nullptr, watch);
    row.quantities.near("period of a plate between the hits [s]", seen.period(), free_period(), 1e-3);
    row.quantities.at_most("half periods seen", seen.half_periods());
    const bool is_body = one.motion.size() > plates;
    if (is_body) row.quantities.at_most("turns of the rotor", seen.turned() / (2.0 * pi));
    // The filter keeps the momentum of what touches, but not where that is an obstacle. The impulse of the hinge on a
    // body is known as well as its stiffness times the rounding of a position, which adds up.
    const double allowed = is_body ? 1e-9 : one.run.filter ? no_target : 1e-11;
    row.quantities.at_most("momentum of the plates less all impulses, over that of the rotor", seen.lack_of_impulse(),
                           allowed);
    row.quantities.at_most("H - H~", row.run->excess, 0.05);
    sink(row);
}

/// The rotor turns as it is told, and its work is booked.
void drive_rotor(Kinematics kinematics, bool filter, const Options& options, const Sink& sink) {
    Case<2> one = sprung_plates({}, kinematics, filter, options);
    one.scene.solid.obstacles = {driven_rotor()};
    report(one, "driven, plates " + run::name_of(kinematics) + (filter ? ", filter" : ""), options, sink);
}

/// The rotor is a rigid body on an axle, which a moment drives.
void turn_rotor(Kinematics kinematics, bool filter, const Options& options, const Sink& sink) {
    const auto body = turned_box<2>(
        {.centre = {rotor_centre, 0.0}, .sides = {arm + counter, 2.0 * half}, .cells = {12, 2}, .name = "rotor"});
    Case<2> one = sprung_plates({body}, kinematics, filter, options);
    one.scene.solid.kinematics.back() = Kinematics::rigid;
    one.scene.solid.materials.back().density = density;
    one.motion.back() = {.velocity = {0.0, spin * rotor_centre}, .spin = AxialVector<2>(spin)};
    one.scene.solid.springs.push_back({.first = {.body = solid::ground, .position = Vector<2>::Zero()},
                                       .second = {.body = plates, .position = Vector<2>::Zero()},
                                       .stiffness = hinge});
    one.scene.solid.moments = {{.body = plates, .moment = AxialVector<2>(drive)}};
    report(one, "a body, plates " + run::name_of(kinematics) + (filter ? ", filter" : ""), options, sink);
}

}  // namespace
}  // namespace rotor_part

void run_rotor(const Options& options, const Sink& sink) {
    using namespace rotor_part;
    for (const Kinematics kinematics : {Kinematics::floating, Kinematics::rigid})
        for (const bool filter : {false, true}) {
            drive_rotor(kinematics, filter, options, sink);
            turn_rotor(kinematics, filter, options, sink);
        }
}

}  // namespace abut::studies::kinematics
