#include "abut/run/steps/settling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::run {
namespace {

constexpr double cfl = 0.9;  // of the steps to rest
constexpr double settled =
    1e-11;  // of the largest peak of the kinetic energy; a rigid body that rocks on a plane stays above 1e-12
constexpr std::int64_t window = 500;  // steps: where peaks do not fall by a tenth from one to the next, no more is to be had
constexpr int most_standstills = 10;  // such windows in all: from there on rests are a step later in turn
constexpr std::int64_t most_rise = 20'000;  // steps without a peak: the bodies fall or slide
constexpr std::int64_t most_steps = 200'000;
constexpr std::int64_t between_looks = 50;  // steps
// Paths within most_rise steps, of the radius of a body, below which it does not move: of rigid bodies, and by loads that
// something else might balance.
constexpr double still_path = 1e-9, balanced_path = 1e-6;

/// Loads and obstacles that stay as they are at t = 0.
template <int Dim>
solid::SolidOptions<Dim> frozen(solid::SolidOptions<Dim> options) {
    const auto freeze = [](solid::Field<Dim>& history) {
        if (history) history = [of_time = history](double, const Vector<Dim>& position) { return of_time(0.0, position); };
    };
    for (auto& condition : options.boundary.dirichlet) freeze(condition.history);
    for (auto& condition : options.boundary.traction) freeze(condition.history);
    for (solid::BodyMoment<Dim>& moment : options.moments)
        if (moment.history) moment.moment = std::exchange(moment.history, {})(0.0);
    for (contact::RigidObstacle<Dim>& obstacle : options.obstacles) {
        if (obstacle.path) obstacle.path = [at = obstacle.path(0.0)](double) { return at; };
        if (obstacle.placement) obstacle.placement = [at = obstacle.placement(0.0)](double) { return at; };
    }
    return options;
}

/// Peaks of the kinetic energy, and whether they have come down as far as they can. Single ones say little: a fast vibration
/// makes a low one while a slow one has only begun.
class Peaks {
public:
    /// Energy `still` and less is that of bodies which do not move [J].
    explicit Peaks(double still) : still_(still) {}

    /// Takes the next one, at a step; whether it is the last.
    bool is_last(double kinetic, std::int64_t step) {
        largest_ = std::max(largest_, kinetic);
        in_window_ = std::max(in_window_, kinetic);
        if (largest_ == 0.0) return true;
        if (step < begin_ + window) return false;
        if (largest_ <= still_) return true;
        begin_ = step;
        const double before = std::exchange(in_window_before_, std::exchange(in_window_, 0.0));
        const bool falls = in_window_before_ <= 0.9 * before;
        if (!falls) ++standstills_;
        return are_settled() && (!falls || step > most_steps);
    }
    /// Whether that many windows in all had peaks that did not fall.
    [[nodiscard]] bool stand_still() const { return standstills_ >= most_standstills; }
    /// Whether the last window had low ones alone.
    [[nodiscard]] bool are_settled() const { return in_window_before_ <= settled * largest_; }

private:
    double still_;
    std::int64_t begin_ = 0;  // of the window
    double largest_ = 0.0;
    double in_window_ = 0.0;
    double in_window_before_ = std::numeric_limits<double>::infinity();
    int standstills_ = 0;
};

/// Finds where the kinetic energy has passed a peak, by the mean of two steps: a swing from step to step is no peak.
class PeakFinder {
public:
    /// Takes the energy after a step [J]. `in_turn`: every other peak is found a step later, so that no vibration turns over
    /// once from each rest to the next, and loses nothing.
    [[nodiscard]] bool has_passed(double kinetic, bool in_turn) {
        const double mean = 0.5 * (kinetic + std::exchange(last_, kinetic));
        if (mean <= peak_) return !in_turn || waited_++ >= peaks_ % 2;
        peak_ = mean;
        return false;
    }
    /// [J]
    [[nodiscard]] double peak() const { return peak_; }
    /// The bodies are at rest again.
    void begin_again() {
        peak_ = last_ = 0.0;
        waited_ = 0;
        ++peaks_;
    }

private:
    double peak_ = 0.0, last_ = 0.0;
    std::int64_t waited_ = 0, peaks_ = 0;
};

/// Largest speed of the points of each body [m/s].
template <int Dim>
std::vector<double> speeds(const solid::Solid<Dim>& solid, std::span<const double> momentum) {
    std::vector<double> of_body(solid.mesh().body_names.size(), 0.0);
    const auto p = as_vectors<Dim>(momentum);
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        double& speed = of_body[static_cast<std::size_t>(solid.body_of_points()[i])];
        speed = std::max(speed, p[i].norm() / solid.masses()[i]);
    }
    for (double& speed : of_body) speed = solid.ranks().largest(speed);
    return of_body;
}

/// Sums over the points of a body, of all ranks: what its motion as a whole is made of.
template <int Dim>
struct Whole {
    double mass = 0.0;                                    // [kg]
    Vector<Dim> first = Vector<Dim>::Zero();              // sum m x [kg m]
    Matrix<Dim> second = Matrix<Dim>::Zero();             // sum m x x^T [kg m^2]
    Vector<Dim> momentum = Vector<Dim>::Zero();           // [kg m/s]
    AxialVector<Dim> angular = AxialVector<Dim>::Zero();  // about the origin [kg m^2/s]

    [[nodiscard]] Vector<Dim> velocity() const { return momentum / mass; }
    /// Angular momentum about the centre [kg m^2/s].
    [[nodiscard]] AxialVector<Dim> spin() const { return angular - moment<Dim>(centre(), momentum); }
    /// As if the body were a disc or a ball [m].
    [[nodiscard]] double radius() const { return std::sqrt(2.0 * about_centre().trace() / mass); }
    /// Speed of the points at that radius about the centre [m/s].
    [[nodiscard]] double speed_of_rim() const {
        const double inertia = about_centre().trace();
        return inertia > 0.0 ? spin().norm() / inertia * radius() : 0.0;
    }

private:
    [[nodiscard]] Vector<Dim> centre() const { return first / mass; }
    [[nodiscard]] Matrix<Dim> about_centre() const { return second - mass * centre() * centre().transpose(); }
};

template <int Dim>
Whole<Dim> whole_of(const solid::Solid<Dim>& solid, std::span<const double> q, std::span<const double> momentum,
                    std::size_t body) {
    Whole<Dim> whole;
    const auto u = as_vectors<Dim>(q), p = as_vectors<Dim>(momentum);
    for (std::size_t i = 0; i < solid.masses().size(); ++i) {
        if (static_cast<std::size_t>(solid.body_of_points()[i]) != body) continue;
        const Vector<Dim> x = solid.rest_positions()[i] + u[i];
        whole.mass += solid.masses()[i];
        whole.first += solid.masses()[i] * x;
        whole.second += solid.masses()[i] * x * x.transpose();
        whole.momentum += p[i];
        whole.angular += moment<Dim>(x, Vector<Dim>(p[i]));
    }
    if (solid.ranks().is_one()) return whole;
    std::vector<double> mine{whole.mass};
    const auto each = [&](const auto& visit) {
        visit(whole.first);
        visit(whole.second);
        visit(whole.momentum);
        visit(whole.angular);
    };
    each([&](const auto& values) { mine.insert(mine.end(), values.data(), values.data() + values.size()); });
    const std::vector<double> all = solid.ranks().gather(mine);
    whole = {};
    for (std::size_t begin = 0; begin < all.size(); begin += mine.size()) {
        const double* next = all.data() + begin;
        whole.mass += *next++;
        each([&](auto& values) {
            for (double& value : std::span(values.data(), static_cast<std::size_t>(values.size()))) value += *next++;
        });
    }
    return whole;
}

/// "along x", "along (0.6, 0.8)"
template <int Dim>
std::string along(const Vector<Dim>& direction) {
    constexpr double nearly = 0.99;
    const Vector<Dim> unit = direction.normalized();
    for (int i = 0; i < Dim; ++i)
        if (std::abs(unit[i]) > nearly) return fmt::format("along {}{}", unit[i] < 0.0 ? "-" : "", "xyz"[i]);
    return fmt::format("along ({:.2g})", fmt::join(unit, ", "));
}

/// How a body moves, why nothing brings it to rest, and what would.
struct Way {
    std::string motion, remedy;
};
template <int Dim>
Way way_of(const Scene<Dim>& scene, const solid::SolidOptions<Dim>& options, const Whole<Dim>& whole, double speed,
           std::size_t body) {
    constexpr double most = 0.5;  // of the speed: it is most of the motion
    const Vector<Dim> velocity = whole.velocity();
    const bool travels = velocity.norm() > most * speed, turns = whole.speed_of_rim() > most * speed;
    const bool rubs = scene.contact && options.has_friction();
    const Vector<Dim> pull = options.acceleration.empty() ? Vector<Dim>::Zero() : options.acceleration[body];
    if (travels && pull.dot(velocity) > 0.9 * pull.norm() * velocity.norm() && !pull.isZero(0.0))
        return {"falls " + along<Dim>(velocity),
                "hold it by supports or springs, put it nearer to where it rests, or give it something to rest on"};
    if (travels && turns)
        return {"rolls " + along<Dim>(velocity), "hold it by supports or springs, or let it begin where it does not roll"};
    if (travels && !rubs)
        return {"slides " + along<Dim>(velocity) + " without friction",
                "give it friction (contact.friction), or hold it by supports or springs"};
    if (travels) return {"slides " + along<Dim>(velocity), "give it more friction, or hold it by supports or springs"};
    if (turns) return {"turns", "hold it by supports or springs, or give it a wider base"};
    return {"vibrates", "look whether a face of it opens and closes again and again, or whether its load has a rest at all"};
}

/// Motion of a body that does not come to rest. Of one that has gone far since it was at `before`, the path counts:
/// velocities begin again at each rest.
template <int Dim>
Way way_of(const Scene<Dim>& scene, const solid::Solid<Dim>& solid, std::span<const double> before,
           std::span<const double> q, std::span<const double> p, double speed, std::size_t body) {
    constexpr double far = 0.05;  // of the radius of the body
    std::vector<double> gone(q.size());
    for (std::size_t i = 0; i < gone.size(); ++i) gone[i] = solid.masses()[i / Dim] * (q[i] - before[i]);
    const Whole<Dim> by_path = whole_of<Dim>(solid, before, gone, body);
    if (const double farthest = speeds<Dim>(solid, gone)[body]; farthest > far * by_path.radius())
        return way_of(scene, solid.options(), by_path, farthest, body);
    return way_of(scene, solid.options(), whole_of<Dim>(solid, q, p, body), speed, body);
}

template <int Dim>
[[noreturn]] void refuse(const Scene<Dim>& scene, const solid::Solid<Dim>& solid,
                         const dynamics::Memm<solid::Solid<Dim>>& motion, std::span<const double> before) {
    const std::vector<double> of_body = speeds(solid, motion.p_after());
    const auto fastest = static_cast<std::size_t>(std::ranges::max_element(of_body) - of_body.begin());
    const Way way = way_of<Dim>(scene, solid, before, motion.q(), motion.p_after(), of_body[fastest], fastest);
    throw BadInput(
        fmt::format("--settle: bodies do not come to rest under the loads of t = 0: after {} steps {} {} with {:.3g} "
                    "m/s, and nothing brings it to rest. To begin at rest {}; else leave --settle out.",
                    motion.steps(), quoted_name(scene, static_cast<std::int32_t>(fastest)), way.motion, of_body[fastest],
                    way.remedy),
        {.value = of_body[fastest], .allowed = 0.0});
}

/// Whether a support, a spring, a bond or contact may hold each body.
template <int Dim>
std::vector<bool> may_be_held(const Scene<Dim>& scene, const solid::SolidOptions<Dim>& options) {
    const mesh::Mesh<Dim>& mesh = scene.mesh;
    const bool may_touch = scene.contact && (mesh.n_bodies() > 1 || !options.obstacles.empty());
    std::vector<bool> is_held(mesh.body_names.size(), may_touch || !options.bonds.empty());
    for (const solid::Spring<Dim>& spring : options.springs)
        for (const std::int32_t body : {spring.first.body, spring.second.body})
            if (body != solid::ground) is_held[static_cast<std::size_t>(body)] = true;
    for (const solid::DirichletCondition<Dim>& support : options.boundary.dirichlet)
        for (const std::int32_t face : mesh.group(support.group).faces) {
            const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(face)][0];
            is_held[static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(cell)])] = true;
        }
    return is_held;
}

/// Kinetic energy of rigid bodies that go nowhere, with steps dt [J]; 0 where a body deforms, which vibrates first.
template <int Dim>
double still_energy(const solid::Solid<Dim>& solid, std::span<const double> q, double dt) {
    const auto deforms = [&](std::size_t body) { return solid::properties_of(solid.options().kinematics, body).deforms; };
    const std::vector<double> at_rest(q.size(), 0.0);
    double energy = 0.0;
    for (std::size_t body = 0; body < solid.mesh().body_names.size(); ++body) {
        if (deforms(body)) return 0.0;
        const Whole<Dim> whole = whole_of<Dim>(solid, q, at_rest, body);
        const double speed = still_path * whole.radius() / (static_cast<double>(most_rise) * dt);
        energy += 0.5 * whole.mass * speed * speed;
    }
    return energy;
}

/// Whether a couple on each body turns it for ever: no traction there keeps its direction as it turns, until loads balance.
template <int Dim>
std::vector<bool> turn_for_ever(const mesh::Mesh<Dim>& mesh, const solid::SolidOptions<Dim>& options) {
    std::vector<bool> turn(mesh.body_names.size(), true);
    for (const solid::TractionCondition<Dim>& traction : options.boundary.traction) {
        if (traction.follows) continue;
        for (const std::int32_t face : mesh.group(traction.group).faces) {
            const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(face)][0];
            const auto body = static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(cell)]);
            if (solid::properties_of(options.kinematics, body).turns) turn[body] = false;
        }
    }
    return turn;
}

/// Refuses a body that nothing holds: `loads` do something to it for ever.
[[noreturn]] void refuse_free(const std::string& body, const std::string& loads, double size) {
    throw BadInput(
        fmt::format("--settle: nothing holds {}: it has no support, spring or bond, and nothing that it could touch, "
                    "and loads of t = 0 {}. To begin at rest hold it by supports or springs, or give it something to "
                    "rest on; else leave --settle out.",
                    body, loads),
        {.value = size, .allowed = 0.0});
}

/// Refuses a body that nothing holds, and that loads would push or turn on for ever.
template <int Dim>
void require_holds(const Scene<Dim>& scene, solid::Solid<Dim>& solid, std::span<const double> q, double dt) {
    const auto of_first = [&](const auto& make) {  // which has the whole mesh
        return values_of_first(solid.ranks(), [&] {
            const std::vector<bool> of_bodies = make();
            return std::vector<double>(of_bodies.begin(), of_bodies.end());
        });
    };
    const std::vector<double> is_held = of_first([&] { return may_be_held(scene, solid.options()); });
    if (std::ranges::find(is_held, 0.0) == is_held.end()) return;
    std::vector<double> force(q.size());
    solid.force(q, force);
    const std::vector<double> turn = of_first([&] { return turn_for_ever(scene.mesh, solid.options()); });
    const double time = static_cast<double>(most_rise) * dt;
    for (std::size_t body = 0; body < is_held.size(); ++body) {
        if (is_held[body] != 0.0) continue;
        const std::string name = quoted_name(scene, static_cast<std::int32_t>(body));
        const Whole<Dim> pushed = whole_of<Dim>(solid, q, force, body);
        const double push = pushed.momentum.norm();                               // resultant of the forces [N]
        const double couple = pushed.spin().norm();                               // [N m]
        const double balanced = balanced_path * pushed.radius() / (time * time);  // acceleration [m/s^2]
        if (push > balanced * pushed.mass)
            refuse_free(name, fmt::format("push it {} with {:.3g} N", along<Dim>(pushed.momentum), push), push);
        if (turn[body] != 0.0 && pushed.speed_of_rim() > balanced)
            refuse_free(name, fmt::format("turn it with a couple of {:.3g} N m", couple), couple);
    }
}

/// Whether no body goes farther than `balanced_path` of its radius in the most steps that a peak may take: loads that nearly
/// balance move it no more.
template <int Dim>
bool creep(const solid::Solid<Dim>& solid, const dynamics::Memm<solid::Solid<Dim>>& motion, double dt) {
    const std::vector<double> of_body = speeds(solid, motion.p_after());
    for (std::size_t body = 0; body < of_body.size(); ++body) {
        const double radius = whole_of<Dim>(solid, motion.q(), motion.p_after(), body).radius();
        if (of_body[body] * static_cast<double>(most_rise) * dt > balanced_path * radius) return false;
    }
    return true;
}

/// Tells rank 0 how far it is, and whether that wants to go on.
template <int Dim>
void show(const solid::Solid<Dim>& solid, const dynamics::Memm<solid::Solid<Dim>>& motion, Observer<Dim>& observer) {
    const double speed = std::ranges::max(speeds(solid, motion.p_after()));
    const bool stops = first_says(solid.ranks(), [&] {
                           observer.settling(motion.steps(), speed);
                           return int{observer.asks_to_stop()};
                       }) != 0;
    if (stops)
        throw std::runtime_error(
            fmt::format("--settle: asked to stop after {} steps to rest, before the run began: there is nothing to go on "
                        "from. Start it again.",
                        motion.steps()));
}

}  // namespace

template <int Dim>
Settled settle(const Scene<Dim>& scene, const solid::SolidOptions<Dim>& options, const Share<Dim>& share,
               std::vector<double> q, double stable_dt, Observer<Dim>& observer) {
    Settled result;
    solid::Solid<Dim> solid(share.part, frozen(options), share.ranks);
    const double dt = cfl * stable_dt;
    require_holds<Dim>(scene, solid, q, dt);
    Peaks peaks(still_energy<Dim>(solid, q, dt));
    const std::vector<double> at_rest(q.size(), 0.0);
    dynamics::Memm<solid::Solid<Dim>> motion(solid, std::move(q), at_rest, dt);
    PeakFinder finder;
    std::int64_t peak_at = 0;
    std::vector<double> q_before(motion.q().begin(), motion.q().end());  // where the last half of the steps begins
    for (bool is_last = false; !is_last;) {
        try {
            motion.step();
        } catch (const Error& error) {
            throw_again(error, fmt::format("--settle: step {} to rest under the loads of t = 0: {}", motion.steps() + 1,
                                           error.what()));
        }
        if (motion.steps() % between_looks == 0) show(solid, motion, observer);
        const bool takes_long = motion.steps() > most_steps && !peaks.are_settled();
        const bool rises = motion.steps() - peak_at > most_rise, is_still = rises && creep(solid, motion, dt);
        if (takes_long || (rises && !is_still)) refuse(scene, solid, motion, q_before);
        if (motion.steps() == most_steps / 2) q_before.assign(motion.q().begin(), motion.q().end());
        if (!finder.has_passed(motion.kinetic_energy(), peaks.stand_still()) && !is_still) continue;
        is_last = is_still || peaks.is_last(finder.peak(), motion.steps());
        if (is_last) result.report.speed = std::ranges::max(speeds(solid, motion.p_after()));
        motion.bring_to_rest();
        ++result.report.rests;
        finder.begin_again();
        peak_at = motion.steps();
    }
    result.report.steps = motion.steps();
    result.report.dissipated = solid.contact().report().friction_dissipated;
    result.q.assign(motion.q().begin(), motion.q().end());
    solid.begin_run();
    result.solid = solid.state();
    return result;
}

template Settled settle<2>(const Scene<2>&, const solid::SolidOptions<2>&, const Share<2>&, std::vector<double>, double,
                           Observer<2>&);
template Settled settle<3>(const Scene<3>&, const solid::SolidOptions<3>&, const Share<3>&, std::vector<double>, double,
                           Observer<3>&);

}  // namespace abut::run
