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
#include "abut/dynamics/ranks.hpp"
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

/// What is not made for several ranks, before anything is set up.
template <int Dim>
void check_for_ranks(const dynamics::Ranks* ranks, const Scene<Dim>& scene, const RunOptions& options) {
    if (options.kinematics == BodyKinematics::automatic)
        dynamics::refuse_ranks(ranks, "a pilot run (--kinematics automatic)");
    if (options.integrator == SolidIntegrator::memm_async) dynamics::refuse_ranks(ranks, "local steps (memm_async)");
    if (options.filter) dynamics::refuse_ranks(ranks, "the filter");
    if (options.restart != 0) dynamics::refuse_ranks(ranks, "a neutral restart");
    if (scene.after_step) dynamics::refuse_ranks(ranks, "a scene that looks at each step (Scene::after_step)");
}

/// What a run begins from, whatever its integrator.
template <int Dim>
struct Start {
    Start(const Scene<Dim>& scene, const RunOptions& options, std::optional<PilotReport> pilot, const Share<Dim>* share)
        : solid(share ? share->part : scene.mesh, solid_options(scene, options, pilot), share ? &share->ranks : nullptr) {
        result.pilot = std::move(pilot);
        dynamics::agreed(solid.ranks(), [&] {
            if (share && share->ranks.rank() == 0) whole.emplace(scene.mesh, solid_options(scene, options, {}));
        });
        result.stable = dynamics::stable_step(solid);
        result.finest_dt = result.dt = choose_step(options, result.stable.dt);
        if (options.integrator == SolidIntegrator::memm_async) set_local_steps(options);
        result.steps = choose_steps(options, scene.time, result.dt);
        const solid::Solid<Dim>& seen = whole ? *whole : solid;
        result.stencils = seen.ccg().stencil_report();
        result.boundary_stencils = seen.ccg().boundary().report;
        result.contact_faces_left_out = solid.contact_faces_left_out();
        const auto& kinematics = solid.options().kinematics;
        result.all_may_turn =
            !kinematics.empty() && std::ranges::find(kinematics, solid::Kinematics::small) == kinematics.end();
        result.blind_corners = solid.blind_corners();
        result.unseen_edges = solid.unseen_edges();
        dynamics::agreed(solid.ranks(), [&] {
            q = displacement_at_start(scene, solid);
            momentum = momentum_at_start(scene, solid);
        });
    }

    solid::Solid<Dim> solid;
    std::optional<solid::Solid<Dim>> whole;  // on rank 0 of several, for observers
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
    const std::vector<double>& p = start.momentum;
    const auto inverse_mass = start.solid.inverse_mass();
    if (const dynamics::Ranks* ranks = start.solid.ranks())
        return 0.5 * dynamics::mass_product_over(*ranks, p, inverse_mass, p);
    return 0.5 * dynamics::mass_product(p, inverse_mass, p);
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
          whole_(start.whole),
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
        show([&](const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
            result_.start = solid::body_motions<Dim>(run, solid);
        });
        if (from)
            resume(*from);
        else
            begin();
        while (integrator_.steps() < result_.steps) {
            step();
            const bool stops = integrator_.steps() < result_.steps && first_says([&] { return observer_.asks_to_stop(); });
            const bool records = integrator_.steps() % options_.interval == 0 || integrator_.steps() == result_.steps;
            if (records) record();
            look();
            if (first_says([&] { return observer_.wants_checkpoint(integrator_.steps(), stops); })) keep();
            if (stops) stop(records);
        }
        show([&](const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
            result_.end = solid::body_motions<Dim>(run, solid);
        });
        result_.local_rotations = solid_.local_rotations(integrator_.q());
        result_.finite = solid_.finite_extremes();
        result_.contact = solid_.contact_report();
        result_.skin = solid_.skin();
        result_.evaluations = solid_.evaluations();
        result_.times = difference(solid_.times(), times_of_setup_);
        on_first([&] {
            if (scene_.findings) result_.findings = scene_.findings(result_);
        });
    }

private:
    void step() {
        try {
            integrator_.step();
        } catch (const Error& error) {
            fail_at(error);
            throw_again(error, at_this_step(error.what()));
        } catch (const std::exception& error) {
            throw std::runtime_error(at_this_step(error.what()));
        }
        if (scene_.after_step) scene_.after_step(solid_, result_.dt);
    }

    // Observers are those of rank 0: the others take part where the whole is brought together.

    /// Calls body() on rank 0, and agrees with the others on how it ended.
    template <class Body>
    void on_first(const Body& body) {
        const dynamics::Ranks* ranks = solid_.ranks();
        dynamics::agreed(ranks, [&] {
            if (!ranks || ranks->rank() == 0) body();
        });
    }
    /// What rank 0 says, on all.
    template <class Question>
    [[nodiscard]] bool first_says(const Question& question) {
        bool answer = false;
        on_first([&] { answer = question(); });
        const dynamics::Ranks* ranks = solid_.ranks();
        return ranks ? ranks->largest(answer ? 1.0 : 0.0) > 0.0 : answer;
    }
    /// A state with the points of all ranks, on rank 0; without points on the others.
    [[nodiscard]] dynamics::IntegratorState whole_of(dynamics::IntegratorState state) const {
        if (const dynamics::Ranks* ranks = solid_.ranks())
            for (auto* values : {&state.q, &state.p_before, &state.p_after}) *values = ranks->collect(*values, Dim);
        return state;
    }
    /// The other way round, where all ranks have it.
    [[nodiscard]] dynamics::IntegratorState own_of(dynamics::IntegratorState state) const {
        const dynamics::Ranks* ranks = solid_.ranks();
        if (!ranks) return state;
        const auto n_points = static_cast<std::size_t>(ranks->n_points());
        for (auto* values : {&state.q, &state.p_before, &state.p_after}) {
            if (values->size() != n_points * Dim) return state;  // of another solid: whoever restores it says so
            std::vector<double> own;
            for (const std::int32_t number : ranks->numbers())
                own.insert(own.end(), values->begin() + number * Dim, values->begin() + (number + 1) * Dim);
            *values = std::move(own);
        }
        return state;
    }
    /// Calls see(run, solid) with the present state of the whole, on rank 0.
    template <class See>
    void show(const See& see) {
        if (!solid_.ranks()) return see(dynamics::RunView<Dim>(integrator_), solid_);
        const dynamics::IntegratorState state = whole_of(integrator_.state());
        const std::vector<std::byte> memory = solid_.state();
        on_first([&] {
            whole_->restore(memory, state.q);
            see(dynamics::RunView<Dim>(state), *whole_);
        });
    }
    void look() {
        if (first_says([&] { return observer_.wants_look(integrator_.steps()); }))
            show([&](const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) { observer_.look(run, solid); });
        on_first([&] { observer_.progress(integrator_.steps(), integrator_.time()); });
    }
    void keep() {
        const Checkpoint kept = checkpoint();
        on_first([&] { observer_.keep(kept); });
    }

    void begin() {
        on_first([&] { observer_.begin(scene_, result_); });
        const bool stops = first_says([&] { return observer_.asks_to_stop(); });
        record();
        look();
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
                              .motion = whole_of(integrator_.state()),
                              .solid = solid_.state(),
                              .ledger = {},
                              .restarts = restart_ ? restart_->report() : dynamics::RestartReport{},
                              .inadmissible_overlaps_max = result_.inadmissible_overlaps_max,
                              .observers = {}};
        for (const auto& entry : result_.ledger.entries()) {
            const std::vector<double> values = dynamics::ledger_values(entry);
            checkpoint.ledger.insert(checkpoint.ledger.end(), values.begin(), values.end());
        }
        on_first([&] {
            StateWriter state(observers_kind, 1);
            observer_.save(state);
            checkpoint.observers = std::move(state).finish();
        });
        return checkpoint;
    }

    void resume(const Checkpoint& from) {
        require_same_run(from.run, identity(scene_, result_));
        dynamics::agreed(solid_.ranks(), [&] { integrator_.restore(own_of(from.motion)); });
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
        on_first([&] {
            StateReader state(from.observers, observers_kind, 1);
            observer_.resume(scene_, result_, state);
            state.finish();
        });
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
    void fail_at(const Error& error) {
        ErrorFacts facts = error.facts();
        // A rank numbers cells and faces of its own; those of contact are the same on all.
        if (solid_.ranks()) facts.cell = ErrorFacts::none;
        if (solid_.ranks() && error.kind() != ErrorKind::too_deep) facts = {};
        const dynamics::IntegratorState sound = whole_of(sound_);
        const solid::Solid<Dim>& seen = whole_ ? *whole_ : solid_;
        Failure failure{.sound = sound, .lost = nullptr, .cells = {}};
        for (const std::int64_t cell : {facts.cell, std::int64_t{seen.cell_of_contact_face(facts.face_1)},
                                        std::int64_t{seen.cell_of_contact_face(facts.face_2)}})
            if (cell >= 0 && cell < scene_.mesh.n_cells()) failure.cells.push_back(static_cast<std::int32_t>(cell));
        tell(failure);
    }

    /// The error of the run counts, not one of those who are told of it.
    void tell(const Failure& failure) {
        on_first([&] {
            try {
                observer_.fail(failure, whole_ ? *whole_ : solid_);
            } catch (...) {
            }
        });
    }

    /// What `fail` needs, without allocation from one record to the next.
    void keep_sound() {
        const auto copy = [](std::span<const double> from, std::vector<double>& to) { to.assign(from.begin(), from.end()); };
        copy(integrator_.q(), sound_.q);
        copy(integrator_.p_before(), sound_.p_before);
        copy(integrator_.p_after(), sound_.p_after);
        was_sound_ = true;
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
        on_first([&] { observer_.record(entries.back(), result_); });
        const double scale = std::max(entries.front().energy, result_.scale.value);
        check_alive(entries.back(), scale);
        if (entries.size() == 1 || entries.back().energy <= sound_factor * std::max(scale, entries.back().pseudo_energy))
            keep_sound();
    }

    void check_alive(const dynamics::LedgerEntry<Dim>& entry, double scale) {
        if (std::isfinite(entry.pseudo_energy) && entry.energy <= divergence_factor * scale) return;
        if (!was_sound_) sound_ = integrator_.state();
        const dynamics::IntegratorState sound = whole_of(sound_), lost = whole_of(integrator_.state());
        WorstCell worst;
        on_first([&] { worst = worst_cell<Dim>(lost, whole_ ? *whole_ : solid_); });
        tell({.sound = sound, .lost = &lost, .cells = {worst.cell}});
        on_first([&] { refuse(entry, scale, worst); });
    }

    [[noreturn]] void refuse(const dynamics::LedgerEntry<Dim>& entry, double scale, const WorstCell& worst) const {
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
    std::optional<solid::Solid<Dim>>& whole_;  // Start::whole
    RunResult<Dim>& result_;
    dynamics::NeutralFilter<solid::Solid<Dim>> filter_;
    std::optional<dynamics::NeutralRestart<solid::Solid<Dim>>> restart_;
    Integrator integrator_;
    dynamics::IntegratorState sound_;   // Failure::sound, except what only the scheme knows
    bool was_sound_ = false;            // once at least
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
RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& given, Observer<Dim>& observer, const Checkpoint* from,
                        const Share<Dim>* share) {
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
            const dynamics::Ranks* ranks = share ? &share->ranks : nullptr;
            if (ranks) check_for_ranks(ranks, scene, options);
            dynamics::agreed(ranks, [&] {
                if (scene.contact && (!ranks || ranks->rank() == 0))
                    mesh::check_apart(scene.mesh, scene.remedy_if_overlapping, options.contact.search.broad_phase,
                                      scene.solid.ignored_pairs);
            });
            std::optional<PilotReport> pilot;
            if (options.kinematics == BodyKinematics::automatic) pilot = choose_kinematics(scene, options);
            start.emplace(scene, options, std::move(pilot), share);
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

template RunResult<2> simulate<2>(const Scene<2>&, const RunOptions&, Observer<2>&, const Checkpoint*, const Share<2>*);
template RunResult<3> simulate<3>(const Scene<3>&, const RunOptions&, Observer<3>&, const Checkpoint*, const Share<3>*);

}  // namespace abut::run
