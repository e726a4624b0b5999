#include "abut/run/steps/time_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/dynamics/remedies.hpp"
#include "abut/dynamics/with_scheme.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/files/run_identity.hpp"
#include "abut/run/steps/erosion.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/run/steps/output_times.hpp"
#include "abut/run/steps/rank_balance.hpp"
#include "abut/run/steps/start_contact.hpp"
#include "abut/run/steps/whole_run.hpp"
#include "abut/run/values/frame_piece.hpp"
#include "abut/run/watch/divergence.hpp"
#include "abut/run/watch/fine_motion.hpp"
#include "abut/run/watch/friction_watch.hpp"
#include "abut/run/watch/last_sound.hpp"
#include "abut/run/watch/obstacle_watch.hpp"
#include "abut/run/watch/self_watch.hpp"
#include "abut/run/watch/step_figures.hpp"
#include "abut/run/watch/surface_watch.hpp"
#include "abut/run/watch/wanted.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/change.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/fragments.hpp"

namespace abut::run {
namespace {

/// H - H~ up to this part of the energy in play: nothing is wrong yet.
constexpr double sound_share = 0.5;

const std::string observers_kind = "observers of a run";
constexpr int observers_version = 5;
const std::string looks_kind = "looks at surfaces";
constexpr int looks_version = 8;
constexpr std::int64_t sightings_per_run = 40;  // looks for bodies past a rim and together with themselves, about

/// One run, from the first step to the last.
template <int Dim, class Integrator>
class TimeLoop {
public:
    /// `make` makes the integrator of a start.
    TimeLoop(Start<Dim>& start, Observer<Dim>& observer, std::function<Integrator(Start<Dim>&)> make)
        : start_(start),
          scene_(start.scene),
          options_(start.options),
          observer_(observer),
          result_(start.result),
          whole_(start),
          times_(start, whole_, observer),
          remedies_(std::in_place, *start.solid, options_.filter, options_.restart),
          obstacle_watch_(scene_),
          self_watch_(std::in_place, scene_, whole_.seen()),
          make_(std::move(make)),
          integrator_(make_(start)),
          times_of_setup_(start.solid->times()),
          friction_watch_(scene_, options_),
          balance_(start.first_share.again ? options_.rebalance : 0, options_.rebalance_above),
          watch_(std::in_place, start.scene),
          erosion_(start) {
        remedies_->prepare(*integrator_);
    }

    void run(const Checkpoint* from) {
        whole_.show(*integrator_,
                    [&](const auto& run, auto& solid) { result_.start = solid::body_motions<Dim>(run, solid); });
        if (from)
            resume(*from);
        else
            begin();
        while (integrator_->steps() < result_.steps) {
            step();
            attend();
            if (balance_.is_due(integrator_->steps()) && integrator_->steps() < result_.steps) rebalance();
        }
        end();
    }

private:
    /// The solid of the run, which may change its part and lose cells.
    [[nodiscard]] solid::Solid<Dim>& solid() { return *start_.solid; }
    [[nodiscard]] const solid::Solid<Dim>& solid() const { return *start_.solid; }

    void step() {
        std::optional<StepStart> start;
        if (times_.is_due(integrator_->time() + integrator_->dt(), integrator_->steps() + 1))
            start = StepStart{integrator_->state(), solid().state()};
        take_step();
        const std::vector<solid::LeavingCell> leaving = cells_that_leave();
        if (start) times_.show(*start, integrator_->state());
        if (!leaving.empty()) erode(leaving);
    }
    void take_step() {
        try {
            integrator_->step();
        } catch (const Error& error) {
            fail_at(error);
            throw_again(error, at_this_step((error.what() + advice_on_law(error, solid())).c_str()));
        } catch (const std::exception& error) {
            throw std::runtime_error(at_this_step(error.what()));
        }
        if (scene_.after_step) scene_.after_step(solid(), result_.dt);
    }

    // Cells that leave

    /// Looked at before anything else evaluates the solid.
    [[nodiscard]] std::vector<solid::LeavingCell> cells_that_leave() {
        if (!erosion_.acts()) return {};
        try {
            return erosion_.leaving(*integrator_);
        } catch (const Error& error) {
            throw_again(error, at_this_time(error.what()));
        }
    }
    void erode(std::span<const solid::LeavingCell> leaving) {
        try {
            const solid::SolidTimes times = solid().times();
            const solid::RunState state = erosion_.take_out(leaving, integrator_->state());
            times_before_ = added(times_before_, times, times_of_setup_);
            const dynamics::RestartReport restarts = remedies_->report();
            go_on_with_rest();
            solid::go_on_from(state, solid(), *integrator_);
            take_remedies(restarts);
        } catch (const Error& error) {
            fail_at(error);
            throw_again(error, at_this_time(error.what()));
        }
        times_of_setup_ = solid().times();
        sound_.keep(*integrator_, result_.dt);
        observer_.cells_left(solid(), erosion_.first_cells());
    }
    /// All that knows of the solid and of its mesh knows the rest now.
    void go_on_with_rest() {
        remedies_.reset();
        integrator_.emplace(make_(start_));
        fine_motion_.reset();
        times_.forget_solid();
        self_watch_.emplace(start_.present(), whole_.seen());
        StateWriter looked(looks_kind, looks_version);
        watch_->save(looked);
        const std::vector<std::byte> looks = std::move(looked).finish();
        watch_.emplace(start_.present());
        StateReader known(looks, looks_kind, looks_version);
        watch_->restore(known);
    }
    /// Remedies of another integrator.
    void take_remedies(const dynamics::RestartReport& restarts) {
        remedies_.emplace(solid(), options_.filter, options_.restart);
        remedies_->go_on_from(integrator_->steps(), restarts);
        remedies_->prepare(*integrator_);
    }

    /// All that is due after a step, for the ledger and for the observer.
    void attend() {
        const bool records = integrator_->steps() % options_.interval == 0 || integrator_->steps() == result_.steps;
        if (records) record();
        const Wanted wanted = ask(records);
        look(wanted);
        if (wanted.checkpoint) keep();
        if (wanted.stop) stop(records);
    }

    /// Asks what rank 0 wants now, in one message; progress is told of with it.
    [[nodiscard]] Wanted ask(bool records) {
        return Wanted::of(first_says(solid().ranks(), [&] {
            const std::int64_t step = integrator_->steps();
            Wanted wanted;
            wanted.stop = step < result_.steps && observer_.asks_to_stop();
            wanted.look = observer_.wants_look(step);
            wanted.measure = records && step > 0 && step < result_.steps && watch_->is_due(step);
            wanted.piece = observer_.wants_piece(step);
            wanted.checkpoint = step > 0 && observer_.wants_checkpoint(step, wanted.stop);
            observer_.progress(step, integrator_->time());
            return wanted.as_number();
        }));
    }
    void look(const Wanted& wanted) {
        if (wanted.piece >= 0) make_piece(wanted.piece);
        if (wanted.measure)
            whole_.show(*integrator_, [&](const auto& run, auto& solid) {
                const Stopwatch watch(result_.seconds.looks);
                whole_.evaluate(run, solid);
                watch_->look(run, solid, result_.accounts.speed, result_.contact.active_pairs > 0);
            });
        if (wanted.look) whole_.show(*integrator_, [&](const auto& run, auto& solid) { observer_.look(run, solid); });
    }

    void make_piece(std::int64_t frame) {
        const FramePiece<Dim> piece = frame_piece<Dim>(frame, scene_.mesh, *integrator_, solid());
        dynamics::agreed(solid().ranks(), [&] { observer_.piece(piece); });
        whole_.on_first([&] { observer_.all_pieces(piece); });
    }
    void keep() {
        const Checkpoint kept = checkpoint();
        whole_.on_first([&] { observer_.keep(kept); });
    }

    // Several ranks share the cells out again

    /// Time of this rank in the operators of its cells, since the last call [s].
    [[nodiscard]] double own_seconds() {
        return solid().times().own_cells - std::exchange(own_seconds_before_, solid().times().own_cells);
    }

    /// Rebalances where that is worth it. The run goes on as from a checkpoint.
    void rebalance() {
        const dynamics::Ranks& ranks = solid().ranks();
        const std::vector<double> weights = balance_.weights(ranks, own_seconds());
        if (weights.empty()) return;
        double seconds = 0.0;
        const std::vector<std::int32_t> before(ranks.numbers().begin(), ranks.numbers().end());
        {
            const Stopwatch watch(seconds);
            const solid::RunState state = solid::run_state(solid(), *integrator_);
            const dynamics::IntegratorState sound = dynamics::gathered<Dim>(ranks, sound_.state());
            times_before_ = added(times_before_, solid().times(), times_of_setup_);
            const dynamics::RestartReport restarts = remedies_->report();
            remedies_.reset();
            start_.take_part(start_.first_share.again(weights));
            integrator_.emplace(make_(start_));
            solid::go_on_from(state, solid(), *integrator_);
            take_remedies(restarts);
            sound_.replace(dynamics::own_of<Dim>(solid().ranks(), sound));
            times_of_setup_ = solid().times();
            own_seconds_before_ = times_of_setup_.own_cells;
        }
        balance_.shared_out(integrator_->steps(), before, solid().ranks(), seconds);
    }

    void begin() {
        whole_.on_first([&] { observer_.begin(scene_, result_); });
        record();
        times_.show_start(integrator_->state());
        const Wanted wanted = ask(true);
        look(wanted);
        if (wanted.stop) stop(true);
    }

    /// Here; what was not recorded is, so that the last entry is the last step.
    void stop(bool recorded) {
        result_.steps = integrator_->steps();
        result_.complete = false;
        if (!recorded) record();
    }

    void end() {
        show_end();
        take_figures();
        result_.times = added(times_before_, solid().times(), times_of_setup_);
        if (balance_.is_on()) balance_.end(solid().ranks(), own_seconds());
        result_.rebalancing = balance_.report();
        whole_.on_first([&] {
            if (scene_.findings) result_.findings = scene_.findings(result_);
        });
    }
    /// The last state, to those who look on.
    void show_end() {
        const contact::ContactReport contact = solid().contact().report();
        whole_.show(*integrator_, [&](const auto& run, auto& solid) {
            result_.end = solid::body_motions<Dim>(run, solid);
            take_fragments(run, solid);
            whole_.evaluate(run, solid);
            watch_->end(run, solid, result_.accounts.speed, contact.active_pairs > 0, contact.active_pairs_max > 0);
            observer_.end(run, solid);
        });
        result_.looks = watch_->looks();
    }
    void take_fragments(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
        if (!solid.bonds().may_break()) return;
        result_.fragments = solid::fragments<Dim>(run, solid);
        result_.broken_bonds = solid.bonds().broken_share();
    }
    /// Figures of the whole run that solid and watches have.
    void take_figures() {
        result_.weak_friction = friction_watch_.weakest();
        result_.local_rotations = solid().local_rotations(integrator_->q());
        result_.finite = solid().cells().finite_extremes();
        result_.dissipated = solid().dissipated();
        result_.contact = solid().contact().report();
        if (const auto* by_nodes = solid().contact().pair_potential())
            result_.overlaps.assign(by_nodes->interference().begin(), by_nodes->interference().end());
        result_.skin = solid().contact().skin();
        result_.evaluations = solid().evaluations();
    }

    [[nodiscard]] Checkpoint checkpoint() {
        Checkpoint checkpoint{.run = identity(scene_, result_),
                              .motion = whole_.of(integrator_->state()),
                              .solid = solid().state(),
                              .ledger = {},
                              .restarts = remedies_->report(),
                              .inadmissible_overlaps_max = result_.inadmissible_overlaps_max,
                              .looks = {},
                              .observers = {}};
        for (const auto& entry : result_.ledger.entries()) {
            const std::vector<double> values = dynamics::ledger_values(entry);
            checkpoint.ledger.insert(checkpoint.ledger.end(), values.begin(), values.end());
        }
        whole_.on_first([&] {
            StateWriter looks(looks_kind, looks_version);
            result_.erosion.save(looks);
            result_.accounts.save(looks);
            result_.sliding.save(looks);
            watch_->save(looks);
            result_.sightings.save(looks);
            looks.put(result_.turned.name);
            looks.put(result_.turned.angle);
            friction_watch_.save(looks);
            looks.put(result_.fine_energy_max);
            checkpoint.looks = std::move(looks).finish();
            StateWriter state(observers_kind, observers_version);
            observer_.save(state);
            checkpoint.observers = std::move(state).finish();
        });
        return checkpoint;
    }

    void resume(const Checkpoint& from) {
        require_same_run(from.run, identity(scene_, result_), options_.other_end);
        if (from.motion.steps > result_.steps)
            throw BadInput(fmt::format(
                "the run is to end at step {}, t = {:.6g} s, and the checkpoint is of step {}, t = {:.6g} s. "
                "Give a later end.",
                result_.steps, static_cast<double>(result_.steps) * result_.dt, from.motion.steps, from.motion.time));
        StateReader looks(from.looks, looks_kind, looks_version);
        result_.erosion.restore(looks);
        const bool has_lost_cells = !result_.erosion.cells.empty();
        if (has_lost_cells) {
            erosion_.resume(from.motion);
            go_on_with_rest();
        }
        solid::go_on_from({from.motion, from.solid}, solid(), *integrator_);
        if (has_lost_cells)
            take_remedies(from.restarts);
        else
            remedies_->go_on_from(integrator_->steps(), from.restarts);
        times_of_setup_ = solid().times();
        const std::size_t n = dynamics::ledger_columns<Dim>().size();
        for (std::span<const double> left(from.ledger); !left.empty(); left = left.subspan(n))
            result_.ledger.record(dynamics::ledger_entry<Dim>(left.first(std::min(n, left.size()))));
        if (result_.ledger.entries().empty()) throw BadInput("a checkpoint without ledger cannot be gone on from.");
        result_.accounts.restore(looks);
        result_.sliding.restore(looks);
        watch_->restore(looks);
        result_.sightings.restore(looks);
        result_.turned.name = looks.get_text();
        result_.turned.angle = looks.get<double>();
        friction_watch_.restore(looks);
        result_.fine_energy_max = looks.get<double>();
        looks.finish();
        result_.scale = known_scale<Dim>(scene_.energy_scale, result_);
        result_.inadmissible_overlaps_max = from.inadmissible_overlaps_max;
        result_.resumed_after = integrator_->steps();
        times_.skip(integrator_->time(), integrator_->steps());
        sound_.keep(*integrator_, result_.dt);
        whole_.on_first([&] {
            StateReader state(from.observers, observers_kind, observers_version);
            observer_.resume(scene_, result_, state);
            state.finish();
            if (has_lost_cells) observer_.cells_left(solid(), erosion_.first_cells());
        });
    }

    /// Reports a step that has no end.
    void fail_at(const Error& error) {
        const dynamics::IntegratorState sound = whole_.of(sound_.state());
        tell({.sound = sound,
              .lost = nullptr,
              .cells = named_cells(error, solid().ranks(), whole_.seen(), solid().mesh().n_cells())});
    }

    /// The error of the run counts, not one of those who are told of it.
    void tell(const Failure& failure) {
        whole_.on_first([&] {
            try {
                observer_.fail(failure, whole_.seen());
            } catch (...) {
            }
        });
    }

    [[nodiscard]] std::string at_this_time(const char* what) const {
        return fmt::format("step {}, t = {:.4g} s: {}", integrator_->steps(), integrator_->time(), what);
    }

    [[nodiscard]] std::string at_this_step(const char* what) const {
        return fmt::format("step {}, t = {:.4g} s (steps of {:.4g} s, stable are {:.4g} s): {}", integrator_->steps() + 1,
                           integrator_->time(), result_.dt, result_.stable.dt, what);
    }

    void record() {
        const double excess_before = result_.ledger.energy_excess();
        measure();
        if (is_sighting_due(integrator_->steps())) look_around();
        const auto& entries = result_.ledger.entries();
        result_.scale = known_scale<Dim>(scene_.energy_scale, result_);
        if (entries.size() == 1 && scene_.contact && !options_.settle) check_contact(entries.front());
        whole_.on_first([&] { observer_.record(entries.back(), result_); });
        const double scale = std::max({result_.accounts.energy_in_play, result_.scale.value, result_.rest_energy});
        check_alive(entries.back(), scale, excess_before);
        const dynamics::LedgerEntry<Dim>& last = entries.back();
        if (entries.size() == 1 || last.energy - last.pseudo_energy <= sound_share * scale)
            sound_.keep(*integrator_, result_.dt);
    }

    /// An entry of the ledger, and what is counted with it.
    void measure() {
        const Stopwatch watch(result_.seconds.ledger);
        result_.ledger.record(dynamics::measure(*integrator_, solid(), remedies_->report(), result_.erosion.left));
        const dynamics::LedgerEntry<Dim>& entry = result_.ledger.entries().back();
        const dynamics::RunView<Dim> now(*integrator_);
        result_.accounts.record(
            entry, largest_speed(now, solid()),
            momentum_from_outside(integrator_->time(), scene_.mesh.n_bodies(), solid()) + result_.erosion.impulse_of_weight);
        result_.contact = solid().contact().report();
        result_.sliding.record(result_.contact);
        friction_watch_.record(entry, solid().contact().impulses(), result_.accounts.speed);
        result_.compressed = most_compressed(scene_, solid());
        if (!result_.all_may_turn) record_turned();
        result_.inadmissible_overlaps_max =
            std::max(result_.inadmissible_overlaps_max, result_.contact.inadmissible_overlaps);
    }

    /// For bodies past a rim and together with themselves, and for motion from cell to cell.
    void look_around() {
        const Stopwatch watch(result_.seconds.looks);
        obstacle_watch_.look(solid(), integrator_->q(), integrator_->time(), result_.sightings.past_rims);
        if (self_watch_->is_on()) look_for_crossings();
        whole_.show(*integrator_, [&](const auto& run, auto& solid) {
            result_.fine_energy_max = std::max(result_.fine_energy_max, fine_energy(run, solid));
        });
    }

    void record_turned() {
        const std::vector<double> angles = solid().rotations(integrator_->q());
        for (std::size_t body = 0; body < angles.size(); ++body)
            if (!result_.may_turn[body] && angles[body] > result_.turned.angle)
                result_.turned = {quoted_name(scene_, static_cast<std::int32_t>(body)), angles[body]};
    }

    void look_for_crossings() {
        try {
            whole_.show(*integrator_, [&](const auto& run, auto& solid) {
                whole_.evaluate(run, solid);
                self_watch_->look(solid, run.q, run.time, run.steps, result_.sightings);
            });
        } catch (const Diverged&) {
            tell({.sound = whole_.of(integrator_->state()), .lost = nullptr, .cells = {}});
            throw;
        }
    }

    /// Neighbours of cells are listed at the first look.
    [[nodiscard]] double fine_energy(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
        if (!fine_motion_) fine_motion_.emplace(solid.mesh());
        return fine_motion_->energy(run, solid);
    }

    /// At the end, and at evenly spaced records before it: a look at fine motion costs about a tenth of a step, and the
    /// lists for the first one less than a step (27,000 bricks, or as many tetrahedra).
    [[nodiscard]] bool is_sighting_due(std::int64_t step) const {
        const std::int64_t interval = options_.interval;
        const std::int64_t every = interval * std::max<std::int64_t>(1, result_.steps / (interval * sightings_per_run));
        return step % every == 0 || step == result_.steps;
    }

    void check_contact(const dynamics::LedgerEntry<Dim>& at_start) {
        const double scale = std::max(at_start.kinetic, scene_.energy_scale.value);
        whole_.show(*integrator_, [&](const auto& run, auto& solid) {
            check_start_contact<Dim>(scene_, solid, run.q, scale, result_.rest_energy);
        });
    }

    /// The record before the last one tells of H - H~, and at the end of the run the last one, too, unless all was at
    /// rest until then.
    void check_alive(const dynamics::LedgerEntry<Dim>& entry, double scale, double excess_before) {
        const bool at_end = result_.ledger.entries().size() > 1 && entry.step == result_.steps;
        const bool moved = result_.accounts.energy_in_play > result_.rest_energy;
        if (is_alive(entry, scale, at_end && moved ? result_.ledger.energy_excess() : excess_before)) return;
        if (!sound_.is_kept()) sound_.replace(integrator_->state());
        const dynamics::IntegratorState sound = whole_.of(sound_.state()), lost = whole_.of(integrator_->state());
        WorstCell worst;
        whole_.on_first([&] { worst = worst_cell<Dim>(lost, whole_.seen()); });
        tell({.sound = sound, .lost = &lost, .cells = {worst.cell}});
        whole_.on_first([&] { refuse_diverged(start_.present(), result_, scale, worst); });
    }

    Start<Dim>& start_;
    const Scene<Dim>& scene_;
    const RunOptions& options_;
    Observer<Dim>& observer_;
    RunResult<Dim>& result_;
    WholeRun<Dim> whole_;
    OutputTimes<Dim> times_;
    std::optional<dynamics::Remedies<solid::Solid<Dim>>> remedies_;  // always there
    ObstacleWatch<Dim> obstacle_watch_;
    std::optional<SelfWatch<Dim>> self_watch_;  // always there
    std::function<Integrator(Start<Dim>&)> make_;
    std::optional<Integrator> integrator_;  // always there
    LastSound sound_;
    solid::SolidTimes times_of_setup_;  // the start-up of the scheme, in the seconds of set-up already
    solid::SolidTimes times_before_;    // of steps with other parts
    FrictionWatch<Dim> friction_watch_;
    RankBalance balance_;
    double own_seconds_before_ = 0.0;
    std::optional<SurfaceWatch<Dim>> watch_;  // always there, on rank 0
    Erosion<Dim> erosion_;
    std::optional<FineMotion<Dim>> fine_motion_;  // on rank 0
};

}  // namespace

template <int Dim>
void take_steps(Start<Dim>& start, Observer<Dim>& observer, const Checkpoint* from) {
    const SolidIntegrator scheme = start.options.integrator;
    const double gauge = scheme == SolidIntegrator::bilbao ? run::gauge(start) : 0.0;
    dynamics::with_scheme<solid::Solid<Dim>>(scheme, {.gauge = gauge}, [&](const auto& make) {
        const auto make_at = [&](Start<Dim>& s) { return make(*s.solid, s.q, s.momentum, s.result.dt, s.local_steps); };
        TimeLoop<Dim, decltype(make_at(start))>(start, observer, make_at).run(from);
    });
}

template void take_steps<2>(Start<2>&, Observer<2>&, const Checkpoint*);
template void take_steps<3>(Start<3>&, Observer<3>&, const Checkpoint*);

}  // namespace abut::run
