#include "abut/run/simulation.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/memm_async.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/run/pilot.hpp"
#include "abut/run/run_identity.hpp"
#include "abut/solid/local_steps.hpp"

namespace abut::run {
namespace {

using oneapi::tbb::global_control;

/// H beyond this many times its first value: the solution is lost, whatever H~ says.
constexpr double divergence_factor = 1e3;
/// H up to this many times |H~|, or of its first value: nothing is wrong yet.
constexpr double sound_factor = 2.0;

const std::string observers_kind = "observers of a run";

std::int64_t choose_steps(const RunOptions& options, double time_of_scene, double dt) {
    if (std::isnan(options.time) && options.steps > 0) return options.steps;
    return steps_until(std::isnan(options.time) ? time_of_scene : options.time, dt);
}

solid::SolidTimes difference(const solid::SolidTimes& a, const solid::SolidTimes& b) {
    return {a.bulk - b.bulk, a.contact - b.contact, a.search - b.search};
}

EnergyScale known_scale(EnergyScale scale, double kinetic) {
    if (scale.value == 0.0) scale.value = kinetic;
    if (scale.name.empty())
        throw BadInput("Scene::energy_scale has no name. Give a letter and what stands below it, such as H0.");
    if (!(scale.value > 0.0))
        throw BadInput(fmt::format(
            "the kinetic energy at the start is {} J, above 0 J is needed to measure energies with. Raise the speed "
            "at the start; a scene that starts at rest gives Scene::energy_scale.",
            scale.value));
    return scale;
}

/// With what the pilot run picked, if there was one.
template <int Dim>
solid::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, RunOptions options,
                                       const std::optional<PilotReport>& pilot) {
    if (!pilot) return run::solid_options(scene, options);
    options.kinematics = BodyKinematics::scene;
    solid::SolidOptions<Dim> solid = run::solid_options(scene, options);
    solid.kinematics = pilot->kinematics();
    return solid;
}

/// What a run begins from, whatever its integrator.
template <int Dim>
struct Start {
    Start(const Scene<Dim>& scene, const RunOptions& options, std::optional<PilotReport> pilot)
        : solid(scene.mesh, solid_options(scene, options, pilot)) {
        result.pilot = std::move(pilot);
        result.stable = dynamics::stable_step(solid);
        result.finest_dt = result.dt = choose_step(options, result.stable.dt);
        if (options.integrator == SolidIntegrator::memm_async) set_local_steps(options);
        result.steps = choose_steps(options, scene.time, result.dt);
        result.stencils = solid.ccg().stencil_report();
        result.boundary_stencils = solid.ccg().boundary().report;
        result.contact_faces_left_out = solid.contact_faces_left_out();
        const auto& kinematics = solid.options().kinematics;
        result.all_may_turn =
            !kinematics.empty() && std::ranges::find(kinematics, solid::Kinematics::small) == kinematics.end();
        result.blind_corners = solid.blind_corners();
        result.unseen_edges = solid.unseen_edges();
        q = displacement_at_start(scene, solid);
        momentum = momentum_at_start(scene, solid);
    }

    solid::Solid<Dim> solid;
    RunResult<Dim> result;
    std::vector<double> q;
    std::vector<double> momentum;
    dynamics::LocalSteps local_steps;  // of memm_async

private:
    void set_local_steps(const RunOptions& options) {
        auto local =
            solid::local_steps(solid, result.stable,
                               {.most_levels = options.levels == 0 ? solid::LocalStepOptions{}.most_levels : options.levels,
                                .contact_margin = options.contact_margin,
                                .contact_levels = options.contact_levels});
        local_steps = std::move(local.steps);
        result.level_cells = std::move(local.cells);
        result.dt *= local.dt / result.stable.dt;
        result.finest_dt = result.dt / local_steps.parts.back();
    }
};

/// c of the Bilbao scheme [J].
template <int Dim>
double gauge(const Scene<Dim>& scene, const RunOptions& options, const Start<Dim>& start) {
    if (!std::isnan(options.gauge)) return options.gauge;
    if (scene.energy_scale.value > 0.0) return 2.0 * scene.energy_scale.value;  // V may sink by that scale
    return 0.5 * dynamics::mass_product(start.momentum, start.solid.inverse_mass(), start.momentum);
}

/// One run, from the first step to the last.
template <int Dim, class Integrator>
class Simulation {
public:
    Simulation(const Scene<Dim>& scene, const RunOptions& options, Start<Dim>& start, Observer<Dim>& observer,
               Integrator integrator)
        : scene_(scene),
          options_(options),
          observer_(observer),
          solid_(start.solid),
          result_(start.result),
          filter_(solid_),
          integrator_(std::move(integrator)),
          times_of_setup_(solid_.times()) {
        if constexpr (Integrator::takes_after_step)
            if (options.filter)
                integrator_.set_after_step(
                    [this](auto q, double dt, auto before, auto after) { filter_(q, dt, before, after); });
        make_restart({.period = options.restart, .report_before = {}});
    }

    void run(const Checkpoint* from) {
        result_.start = solid::body_motions<Dim>(integrator_, solid_);
        if (from)
            resume(*from);
        else
            begin();
        while (integrator_.steps() < result_.steps) {
            step();
            const bool stops = integrator_.steps() < result_.steps && observer_.asks_to_stop();
            const bool records = integrator_.steps() % options_.interval == 0 || integrator_.steps() == result_.steps;
            if (records) record();
            observer_.look(integrator_, solid_);
            if (observer_.wants_checkpoint(integrator_.steps(), stops)) observer_.keep(checkpoint());
            if (stops) stop(records);
        }
        result_.end = solid::body_motions<Dim>(integrator_, solid_);
        result_.local_rotations = solid_.local_rotations(integrator_.q());
        result_.finite = solid_.finite_extremes();
        result_.contact = solid_.contact_report();
        result_.skin = solid_.skin();
        result_.evaluations = solid_.evaluations();
        result_.times = difference(solid_.times(), times_of_setup_);
        if (scene_.findings) result_.findings = scene_.findings(result_);
    }

private:
    void step() {
        try {
            integrator_.step();
        } catch (const Error& error) {
            fail_at(error.facts());
            throw_again(error, at_this_step(error.what()));
        } catch (const std::exception& error) {
            throw std::runtime_error(at_this_step(error.what()));
        }
        if (scene_.after_step) scene_.after_step(solid_, result_.dt);
    }

    void begin() {
        observer_.begin(scene_, result_);
        const bool stops = observer_.asks_to_stop();
        record();
        observer_.look(integrator_, solid_);
        if (stops) stop(true);
    }

    /// Here; what was not recorded is, so that the last entry is the last step.
    void stop(bool recorded) {
        result_.steps = integrator_.steps();
        result_.complete = false;
        if (!recorded) record();
    }

    [[nodiscard]] Checkpoint checkpoint() {
        Checkpoint checkpoint{.run = identity(scene_, result_),
                              .motion = integrator_.state(),
                              .solid = solid_.state(),
                              .ledger = {},
                              .restarts = restart_ ? restart_->report() : dynamics::RestartReport{},
                              .inadmissible_overlaps_max = result_.inadmissible_overlaps_max,
                              .observers = {}};
        for (const auto& entry : result_.ledger.entries()) {
            const std::vector<double> values = dynamics::ledger_values(entry);
            checkpoint.ledger.insert(checkpoint.ledger.end(), values.begin(), values.end());
        }
        StateWriter state(observers_kind, 1);
        observer_.save(state);
        checkpoint.observers = std::move(state).finish();
        return checkpoint;
    }

    void resume(const Checkpoint& from) {
        require_same_run(from.run, identity(scene_, result_));
        integrator_.restore(from.motion);
        solid_.restore(from.solid, integrator_.q());
        make_restart({.period = options_.restart, .steps_before = integrator_.steps(), .report_before = from.restarts});
        const std::size_t n = dynamics::ledger_columns<Dim>().size();
        for (std::span<const double> left(from.ledger); !left.empty(); left = left.subspan(n))
            result_.ledger.record(dynamics::ledger_entry<Dim>(left.first(std::min(n, left.size()))));
        if (result_.ledger.entries().empty()) throw BadInput("a checkpoint without ledger cannot be gone on from.");
        result_.scale = known_scale(scene_.energy_scale, result_.ledger.entries().front().kinetic);
        result_.inadmissible_overlaps_max = from.inadmissible_overlaps_max;
        result_.resumed_after = integrator_.steps();
        keep_sound();
        StateReader state(from.observers, observers_kind, 1);
        observer_.resume(scene_, result_, state);
        state.finish();
    }

    void make_restart(const dynamics::RestartOptions& options) {
        if constexpr (Integrator::takes_node_restart) {
            if (options.period == 0) return;
            restart_.emplace(solid_, options);
            integrator_.set_node_restart(
                [this](auto q, double dt, auto before, auto after) { (*restart_)(q, dt, before, after); });
        }
    }

    /// Where a step has no end.
    void fail_at(const ErrorFacts& facts) {
        Failure failure{.sound = sound_, .lost = nullptr, .cells = {}};
        for (const std::int64_t cell : {facts.cell, std::int64_t{solid_.cell_of_contact_face(facts.face_1)},
                                        std::int64_t{solid_.cell_of_contact_face(facts.face_2)}})
            if (cell >= 0 && cell < scene_.mesh.n_cells()) failure.cells.push_back(static_cast<std::int32_t>(cell));
        observer_.fail(failure, solid_);
    }

    /// What `fail` needs, without allocation from one record to the next.
    void keep_sound() {
        const auto copy = [](std::span<const double> from, std::vector<double>& to) { to.assign(from.begin(), from.end()); };
        copy(integrator_.q(), sound_.q);
        copy(integrator_.p_before(), sound_.p_before);
        copy(integrator_.p_after(), sound_.p_after);
        sound_.dt = result_.dt;
        sound_.time = integrator_.time();
        sound_.steps = integrator_.steps();
    }

    [[nodiscard]] std::string at_this_step(const char* what) const {
        return fmt::format("step {}, t = {:.4g} s (steps of {:.4g} s, stable are {:.4g} s): {}", integrator_.steps() + 1,
                           integrator_.time(), result_.dt, result_.stable.dt, what);
    }

    void record() {
        {
            const Stopwatch watch(result_.seconds.ledger);
            result_.ledger.record(
                dynamics::measure(integrator_, solid_, restart_ ? restart_->report() : dynamics::RestartReport{}));
            result_.contact = solid_.contact_report();
            result_.inadmissible_overlaps_max =
                std::max(result_.inadmissible_overlaps_max, result_.contact.inadmissible_overlaps);
        }
        const auto& entries = result_.ledger.entries();
        if (entries.size() == 1) result_.scale = known_scale(scene_.energy_scale, entries.front().kinetic);
        observer_.record(entries.back(), result_);
        const double scale = std::max(entries.front().energy, result_.scale.value);
        check_alive(entries.back(), scale);
        if (entries.size() == 1 || entries.back().energy <= sound_factor * std::max(scale, entries.back().pseudo_energy))
            keep_sound();
    }

    void check_alive(const dynamics::LedgerEntry<Dim>& entry, double scale) {
        if (std::isfinite(entry.pseudo_energy) && entry.energy <= divergence_factor * scale) return;
        const dynamics::IntegratorState lost = integrator_.state();
        if (sound_.q.empty()) sound_ = lost;  // it never was
        const WorstCell worst = worst_cell(lost, solid_);
        observer_.fail({.sound = sound_, .lost = &lost, .cells = {worst.cell}}, solid_);
        throw Diverged(fmt::format("step {}, t = {:.4g} s: the run has diverged: H is {:.3g} J and H~ {:.3g} J; {:g} times "
                                   "{:.3g} J is allowed. Worst is {}, with {:.3g} m/s. Steps are {:.4g} s long, stable are "
                                   "{:.4g} s: lower --cfl or --dt.",
                                   entry.step, entry.time, entry.energy, entry.pseudo_energy, divergence_factor, scale,
                                   name_of_cell(scene_.mesh, worst.cell), worst.speed, result_.dt, result_.stable.dt),
                       {.cell = worst.cell, .value = entry.energy, .allowed = divergence_factor * scale});
    }

    const Scene<Dim>& scene_;
    const RunOptions& options_;
    Observer<Dim>& observer_;
    solid::Solid<Dim>& solid_;
    RunResult<Dim>& result_;
    dynamics::NeutralFilter<solid::Solid<Dim>> filter_;
    std::optional<dynamics::NeutralRestart<solid::Solid<Dim>>> restart_;
    Integrator integrator_;
    dynamics::IntegratorState sound_;   // Failure::sound, except what only the scheme knows
    solid::SolidTimes times_of_setup_;  // the start-up of the scheme, in the seconds of set-up already
};

/// The one place that knows all schemes.
template <int Dim>
void simulate(const Scene<Dim>& scene, const RunOptions& options, Start<Dim>& start, Observer<Dim>& observer,
              const Checkpoint* from) {
    using Solid = solid::Solid<Dim>;
    const auto run_with = [&](auto integrator) {
        Simulation<Dim, decltype(integrator)>(scene, options, start, observer, std::move(integrator)).run(from);
    };
    const double dt = start.result.dt;
    switch (options.integrator) {
        case SolidIntegrator::memm:
            return run_with(dynamics::Memm<Solid>(start.solid, start.q, start.momentum, dt));
        case SolidIntegrator::memm_async:
            return run_with(dynamics::MemmAsync<Solid>(start.solid, start.q, start.momentum, dt, start.local_steps));
        case SolidIntegrator::leapfrog:
            return run_with(dynamics::Leapfrog<Solid>(start.solid, start.q, start.momentum, dt));
        case SolidIntegrator::bilbao:
            return run_with(dynamics::Bilbao<Solid>(start.solid, start.q, start.momentum, dt, gauge(scene, options, start)));
    }
}

}  // namespace

template <int Dim>
RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& given, Observer<Dim>& observer, const Checkpoint* from) {
    check(given);
    const RunOptions options = with_defaults<Dim>(given);
    std::optional<global_control> threads;
    if (options.threads > 0)
        threads.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
    RunSeconds seconds;
    std::optional<Start<Dim>> start;
    {
        const Stopwatch whole(seconds.total);
        {
            const Stopwatch watch(seconds.setup);
            if (scene.contact)
                mesh::check_apart(scene.mesh, scene.remedy_if_overlapping, options.contact.search.broad_phase,
                                  scene.solid.ignored_pairs);
            std::optional<PilotReport> pilot;
            if (options.kinematics == BodyKinematics::automatic) pilot = choose_kinematics(scene, options);
            start.emplace(scene, options, std::move(pilot));
        }
        RunResult<Dim>& result = start->result;
        result.options = options;
        result.threads = static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
        result.seconds.setup = seconds.setup;
        simulate(scene, options, *start, observer, from);
    }
    start->result.seconds.total = seconds.total;
    return std::move(start->result);
}

template RunResult<2> simulate<2>(const Scene<2>&, const RunOptions&, Observer<2>&, const Checkpoint*);
template RunResult<3> simulate<3>(const Scene<3>&, const RunOptions&, Observer<3>&, const Checkpoint*);

}  // namespace abut::run
