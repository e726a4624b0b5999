#include "abut/run/steps/pilot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/warnings.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/options/law_options.hpp"
#include "abut/solid/step_of_breaking.hpp"

namespace abut::run {
namespace {

using solid::Kinematics;

/// Share of the largest kinetic energy of the scene that a rigid body may take as elastic energy at most.
constexpr double rigid_strain_share = 0.01;
/// The pilot run sees in steps of so much of the time at least how far bodies turn.
constexpr double least_pilot_steps = 200.0;
/// From which the time of a whole run is told.
constexpr int timed_steps = 8;

/// Facts about a body at rest.
template <int Dim>
struct RestBody {
    double size = 0.0;        // edge of a cube or square as large [m]
    double compliance = 0.0;  // of a body of that size [m/N]
    double wave_speed = 0.0;  // sqrt(E/rho) [m/s]
};

template <int Dim>
std::vector<RestBody<Dim>> bodies_at_rest(const Scene<Dim>& scene) {
    std::vector<RestBody<Dim>> bodies(scene.mesh.body_names.size());
    std::vector<double> measure(bodies.size(), 0.0);
    for (std::int32_t c = 0; c < scene.mesh.n_cells(); ++c)
        measure[static_cast<std::size_t>(scene.mesh.cell_body[c])] += scene.mesh.cell_measure[c];
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const solid::Material& material = scene.solid.materials.at(i);
        bodies[i].size = std::pow(measure[i], 1.0 / Dim);
        bodies[i].compliance = 1.0 / (material.mean_young() * std::pow(bodies[i].size, Dim - 2));
        bodies[i].wave_speed = std::sqrt(material.mean_young() / material.density);
    }
    return bodies;
}

double sum(const solid::SolidTimes& times) { return times.bulk + times.contact + times.search; }

/// Looks at the start of a run alone.
template <int Dim>
struct StartEnergies {
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid, bool is_displaced) {
        if (run.steps > 0) return;
        kinetic.assign(solid.mesh().body_names.size(), 0.0);
        for (std::size_t i = 0; i < solid.masses().size(); ++i)
            kinetic[static_cast<std::size_t>(solid.body_of_points()[i])] +=
                0.5 * run.momentum(static_cast<std::ptrdiff_t>(i)).squaredNorm() / solid.masses()[i];
        if (is_displaced) potential = std::abs(solid.potential(run.q));
    }

    std::vector<double> kinetic;  // of each body [J]
    double potential = 0.0;       // of all [J]
};

/// Looks at a few steps: where they start, and how long they take after the first one, which searches for candidates.
template <int Dim>
struct TrialLook final : Observer<Dim> {
    explicit TrialLook(bool is_displaced) : is_displaced_(is_displaced) {}

    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        start.look(run, solid, is_displaced_);
        if (run.steps == 1) first_step_ = sum(solid.times());
        if (run.steps > 1) seconds_per_step = (sum(solid.times()) - first_step_) / static_cast<double>(run.steps - 1);
    }

    StartEnergies<Dim> start;
    double seconds_per_step = 0.0;

private:
    bool is_displaced_;
    double first_step_ = 0.0;
};

/// Looks at a run with rigid bodies.
template <int Dim>
class Lookout final : public Observer<Dim> {
public:
    explicit Lookout(std::vector<RestBody<Dim>> bodies)
        : rotation(bodies.size(), 0.0), strain(bodies.size(), 0.0), bodies_(std::move(bodies)) {}

    std::vector<double> rotation;  // of each body, at most [rad]
    std::vector<double> strain;    // the same, elastic energy [J]
    double kinetic = 0.0;          // of all, at most [J]
    StartEnergies<Dim> start;

    void record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>&) override {
        kinetic = std::max(kinetic, entry.kinetic);
    }
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        start.look(run, solid, false);
        const std::vector<double> rotations = solid.rotations(run.q);
        const auto motions = solid::body_motions<Dim>(run, solid);
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            rotation[i] = std::max(rotation[i], rotations[i]);
            const double rim = motions[i].spin.norm() * bodies_[i].size, slowness = rim / bodies_[i].wave_speed;
            raise(i, 0.5 * motions[i].mass * rim * rim * slowness * slowness);
        }
        if (run.steps > 0 && solid.contact().pair_potential() != nullptr)
            look_at_contact(solid.contact().pair_potential()->last());
    }

private:
    void raise(std::size_t body, double energy) { strain[body] = std::max(strain[body], energy); }

    /// Two bodies that press on each other share the energy of their contact as two springs do.
    void look_at_contact(const contact::NodalStep<Dim>& step) {
        for (const contact::BodyPairStep<Dim>& pair : step.body_pairs) {
            if (pair.active_pairs == 0) continue;
            const auto compliance = [&](std::int32_t body) {
                return static_cast<std::size_t>(body) < bodies_.size() ? bodies_[static_cast<std::size_t>(body)].compliance
                                                                       : 0.0;
            };
            const double sum = compliance(pair.body_1) + compliance(pair.body_2);
            for (const std::int32_t body : {pair.body_1, pair.body_2})
                if (compliance(body) > 0.0) raise(static_cast<std::size_t>(body), step.energy * compliance(body) / sum);
        }
    }

    std::vector<RestBody<Dim>> bodies_;
};

RunOptions of_one_kind(RunOptions options, BodyKinematics kinematics) {
    const RunOptions by_default;
    options.kinematics = kinematics;
    options.integrator = SolidIntegrator::memm;
    options.levels = by_default.levels;
    options.contact_margin = by_default.contact_margin;
    options.contact_levels = by_default.contact_levels;
    options.gauge = by_default.gauge;
    options.settle = false;
    options.filter = false;
    options.restart = 0;
    options.law = solid::ContactLaw::automatic;
    solid::SolidOptions<2> choices;  // of contact, whatever the dimension
    choices.contact = options.contact;
    choices.facing = options.facing;
    choices.gauss = options.gauss;
    solid::take_back_choices_of_one_law(choices);
    options.contact = *choices.contact;
    options.facing = choices.facing;
    options.gauss = choices.gauss;
    return options;
}

/// A few steps of a run of one kind.
struct Trial {
    double dt = not_given;                // [s]
    double seconds_per_step = not_given;  // NaN: it cannot be run so

    [[nodiscard]] double seconds(double length) const { return length / dt * seconds_per_step; }
};

template <int Dim>
Trial try_kind(const Scene<Dim>& scene, const RunOptions& given, BodyKinematics kinematics, TrialLook<Dim>& look) {
    RunOptions options = of_one_kind(given, kinematics);
    options.time = not_given;
    options.steps = timed_steps;
    try {
        const double dt = simulate<Dim>(scene, options, look).run.dt;
        return {dt, look.seconds_per_step};
    } catch (const BadInput&) {
        return {};
    }
}

/// The pilot run.
template <int Dim>
RunResult<Dim> run_rigid(const Scene<Dim>& scene, const RunOptions& given, double length, Observer<Dim>& observer) {
    RunOptions options = of_one_kind(given, BodyKinematics::rigid);
    try {
        options.dt = length / least_pilot_steps;
        {
            solid::Solid<Dim> solid(scene.mesh, solid_options(scene, options));
            options.dt = std::min(options.dt, given.cfl * solid::step_of_breaking(solid).dt);
        }
        options.time = length;
        options.interval = 1;
        return simulate<Dim>(scene, options, observer);
    } catch (const Error& error) {
        throw_again(error,
                    fmt::format("--kinematics automatic: the pilot run, with rigid bodies, ended with an error. Choose "
                                "the kinematics yourself. Its message: {}",
                                error.what()));
    }
}

/// Largest elastic energy of each body over the largest kinetic energy of all.
template <int Dim>
std::vector<double> strain_shares(const StartEnergies<Dim>& elastic_start, const Lookout<Dim>& lookout) {
    std::vector<double> share(lookout.strain.size(), 0.0);
    for (std::size_t i = 0; i < share.size(); ++i) {
        const double vibrates = elastic_start.kinetic.empty() ? 0.0 : elastic_start.kinetic[i] - lookout.start.kinetic[i];
        const double energy = std::max(lookout.strain[i], vibrates + elastic_start.potential);
        if (energy > 0.0) share[i] = energy / lookout.kinetic;
    }
    return share;
}

std::vector<PilotBody> picked(const std::vector<double>& share, const std::vector<double>& rotation) {
    bool one_turns = false;
    for (std::size_t i = 0; i < share.size(); ++i)
        one_turns = one_turns || (share[i] > rigid_strain_share && rotation[i] > 0.5 * far_rotation);
    const Kinematics of_elastic = one_turns ? Kinematics::floating : Kinematics::small;
    std::vector<PilotBody> bodies;
    for (std::size_t i = 0; i < share.size(); ++i)
        bodies.push_back({share[i] <= rigid_strain_share ? Kinematics::rigid : of_elastic, rotation[i], share[i]});
    return bodies;
}

template <int Dim>
PilotReport look_at_all_kinds(Scene<Dim> scene, const RunOptions& options) {
    scene.after_step = {};  // whoever looks on at the run does not see the pilot
    scene.findings = {};
    const bool is_displaced = static_cast<bool>(scene.displacement);
    TrialLook<Dim> of_floating(is_displaced), of_small(is_displaced);
    const Trial floating = try_kind<Dim>(scene, options, BodyKinematics::floating, of_floating);
    const Trial small = try_kind<Dim>(scene, options, BodyKinematics::small, of_small);
    const bool by_steps = std::isnan(options.time) && options.steps > 0;
    const double length = by_steps                   ? options.steps * (std::isnan(floating.dt) ? small.dt : floating.dt)
                          : std::isnan(options.time) ? scene.time
                                                     : options.time;
    Lookout<Dim> lookout(bodies_at_rest(scene));
    const RunResult<Dim> pilot = run_rigid<Dim>(scene, options, length, lookout);
    return {.bodies = picked(strain_shares(of_floating.start, lookout), lookout.rotation),
            .steps = pilot.run.steps,
            .small = small.seconds(length),
            .floating = floating.seconds(length),
            .rigid = sum(pilot.seconds.solid)};
}

}  // namespace

std::vector<Kinematics> PilotReport::kinematics() const {
    std::vector<Kinematics> all;
    for (const PilotBody& body : bodies) all.push_back(body.picked);
    return all;
}

template <int Dim>
PilotReport choose_kinematics(const Scene<Dim>& scene, const RunOptions& options) {
    double seconds = 0.0;
    PilotReport report;
    {
        const Stopwatch watch(seconds);
        report = look_at_all_kinds<Dim>(scene, options);
    }
    report.seconds = seconds;
    return report;
}

std::string text_of(const PilotReport& pilot, const std::vector<std::string>& body_names) {
    std::vector<std::string> bodies;
    for (std::size_t i = 0; i < pilot.bodies.size(); ++i) {
        const PilotBody& body = pilot.bodies[i];
        bodies.push_back(fmt::format("'{}' {} (turns by up to {:.2g} rad, takes up to {:.2g} % of the kinetic energy)",
                                     body_names[i], name_of(body.picked), body.rotation, 100.0 * body.strain_share));
    }
    const auto seconds = [](double value) {
        return std::isnan(value) ? std::string("impossible") : fmt::format("{:.2g} s", value);
    };
    return fmt::format(
        "{}; the steps of the run with all bodies small: {}, floating: {}, rigid: {}; this choice took {:.2g} s",
        fmt::join(bodies, ", "), seconds(pilot.small), seconds(pilot.floating), seconds(pilot.rigid), pilot.seconds);
}

template PilotReport choose_kinematics<2>(const Scene<2>&, const RunOptions&);
template PilotReport choose_kinematics<3>(const Scene<3>&, const RunOptions&);

}  // namespace abut::run
