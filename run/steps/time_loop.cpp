#include "abut/run/steps/time_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/state_fields.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/dynamics/with_scheme.hpp"
#include "abut/run/files/run_identity.hpp"
#include "abut/run/steps/erosion.hpp"
#include "abut/run/steps/ledger_rows.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/run/steps/output_times.hpp"
#include "abut/run/steps/rank_balance.hpp"
#include "abut/run/steps/soundness.hpp"
#include "abut/run/steps/start_contact.hpp"
#include "abut/run/steps/stepper.hpp"
#include "abut/run/steps/watches.hpp"
#include "abut/run/steps/whole_run.hpp"
#include "abut/run/values/frame_piece.hpp"
#include "abut/run/watch/divergence.hpp"
#include "abut/run/watch/step_figures.hpp"
#include "abut/run/watch/wanted.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/change.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/fragments.hpp"

namespace abut::run {
namespace {

const std::string observers_kind = "observers of a run";
constexpr int observers_version = 6;
const std::string looks_kind = "looks at surfaces";
constexpr int looks_version = 9;

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
          stepper_(start, std::move(make)),
          watches_(start, whole_),
          soundness_(start, whole_, observer),
          balance_(start.first_share.again ? options_.rebalance : 0, options_.rebalance_above),
          erosion_(start) {}

    void run(const Checkpoint* from) {
        result_.bodies.start = solid::body_motions<Dim>(*stepper_, solid());
        if (from)
            resume(*from);
        else
            begin();
        while (stepper_->steps() < result_.run.steps) {
            step();
            attend();
            if (balance_.is_due(stepper_->steps()) && stepper_->steps() < result_.run.steps) rebalance();
        }
        end();
    }

private:
    /// The solid of the run, which may change its part and lose cells.
    [[nodiscard]] solid::Solid<Dim>& solid() { return *start_.solid; }
    [[nodiscard]] const solid::Solid<Dim>& solid() const { return *start_.solid; }

    void step() {
        std::optional<StepStart> start;
        if (times_.is_due(stepper_->time() + stepper_->dt(), stepper_->steps() + 1))
            start = StepStart{stepper_->state(), solid().state()};
        take_step();
        const std::vector<solid::LeavingCell> leaving = cells_that_leave();
        if (start) times_.show(*start, stepper_->state());
        if (!leaving.empty()) erode(leaving);
    }
    void take_step() {
        try {
            stepper_->step();
        } catch (const Error& error) {
            soundness_.tell_of_step(error);
            throw_again(error, stepper_.at_this_step(error.what() + advice_on_law(error, solid())));
        } catch (const std::exception& error) {
            throw std::runtime_error(stepper_.at_this_step(error.what()));
        }
        if (scene_.after_step) scene_.after_step(solid(), result_.run.dt);
    }

    // Cells that leave

    /// Looked at before anything else evaluates the solid.
    [[nodiscard]] std::vector<solid::LeavingCell> cells_that_leave() {
        if (!erosion_.acts()) return {};
        try {
            return erosion_.leaving(*stepper_);
        } catch (const Error& error) {
            throw_again(error, stepper_.at_this_time(error.what()));
        }
    }
    void erode(std::span<const solid::LeavingCell> leaving) {
        try {
            go_on_without(leaving);
        } catch (const Error& error) {
            soundness_.tell_of_step(error);
            throw_again(error, stepper_.at_this_time(error.what()));
        }
        soundness_.keep(*stepper_);
        observer_.cells_left(solid(), erosion_.first_cells());
    }
    void go_on_without(std::span<const solid::LeavingCell> leaving) {
        stepper_.change_solid([&] { return erosion_.take_out(leaving, stepper_->state()); });
        take_rest();
    }
    /// All that knows of the mesh knows the rest now.
    void take_rest() {
        times_.forget_solid();
        watches_.take_rest();
    }

    /// All that is due after a step, for the ledger and for the observer.
    void attend() {
        const bool records = stepper_->steps() % options_.interval == 0 || stepper_->steps() == result_.run.steps;
        if (records) record();
        const Wanted wanted = ask(records);
        look(wanted);
        if (wanted.checkpoint) keep();
        if (wanted.stop) stop(records);
    }

    /// Asks what rank 0 wants now, in one message; progress is told of with it.
    [[nodiscard]] Wanted ask(bool records) {
        return Wanted::of(first_says(solid().ranks(), [&] {
            const std::int64_t step = stepper_->steps();
            Wanted wanted;
            observer_.note({.steps = step, .time = stepper_->time(), .impulses = solid().contact().impulses()});
            wanted.stop = step < result_.run.steps && observer_.asks_to_stop();
            wanted.see = observer_.wants_sight(step);
            wanted.look = observer_.wants_look(step);
            wanted.measure = records && step > 0 && step < result_.run.steps && watches_.is_look_due(step);
            wanted.piece = observer_.wants_piece(step);
            wanted.checkpoint = step > 0 && observer_.wants_checkpoint(step, wanted.stop);
            observer_.progress(step, stepper_->time());
            return wanted.as_number();
        }));
    }
    void look(const Wanted& wanted) {
        if (wanted.piece >= 0) make_piece(wanted.piece);
        if (wanted.measure) watches_.look_at_surfaces(*stepper_);
        if (wanted.see) whole_.show(*stepper_, [&](const auto& sight) { observer_.see(sight); });
        if (wanted.look && solid().ranks().is_one()) observer_.look(*stepper_, solid());
    }

    void make_piece(std::int64_t frame) {
        const FramePiece<Dim> piece = frame_piece<Dim>(frame, *stepper_, solid());
        dynamics::agreed(solid().ranks(), [&] { observer_.piece(piece); });
        whole_.on_first([&] { observer_.all_pieces(piece); });
    }
    void keep() {
        const Checkpoint kept = checkpoint();
        whole_.on_first([&] { observer_.keep(kept); });
    }

    // Several ranks share the cells out again

    /// Rebalances where that is worth it.
    void rebalance() {
        const std::vector<double> weights = balance_.weights(solid().ranks(), stepper_.own_seconds());
        if (weights.empty()) return;
        const auto numbers = solid().ranks().numbers();
        const std::vector<std::int32_t> before(numbers.begin(), numbers.end());
        double seconds = 0.0;
        {
            const Stopwatch watch(seconds);
            go_on_with_parts(weights);
        }
        balance_.shared_out(stepper_->steps(), before, solid().ranks(), seconds);
    }
    /// The run goes on as from a checkpoint.
    void go_on_with_parts(std::span<const double> weights) {
        const dynamics::IntegratorState sound = dynamics::gathered<Dim>(solid().ranks(), soundness_.state());
        times_.forget_solid();
        stepper_.change_solid([&] {
            const solid::RunState state = solid::run_state(solid(), *stepper_);
            start_.take_part(start_.first_share.again(weights));
            return state;
        });
        soundness_.replace(dynamics::own_of<Dim>(solid().ranks(), sound));
    }

    void begin() {
        whole_.on_first([&] { observer_.begin(scene_, result_); });
        record();
        times_.show_start(stepper_->state());
        const Wanted wanted = ask(true);
        look(wanted);
        if (wanted.stop) stop(true);
    }

    /// Here; what was not recorded is, so that the last entry is the last step.
    void stop(bool recorded) {
        result_.run.steps = stepper_->steps();
        result_.run.complete = false;
        if (!recorded) record();
    }

    void end() {
        show_end();
        take_figures();
        result_.seconds.solid = stepper_.times();
        if (balance_.is_on()) balance_.end(solid().ranks(), stepper_.own_seconds());
        result_.rebalancing = balance_.report();
        whole_.on_first([&] {
            if (scene_.findings) result_.watch.findings = scene_.findings(result_);
        });
    }
    /// The last state, to those who look on.
    void show_end() {
        const contact::ContactReport contact = solid().contact().report();
        result_.bodies.end = solid::body_motions<Dim>(*stepper_, solid());
        take_fragments();
        const auto see = [&](const Sight<Dim>& sight) {
            watches_.end(sight, contact);
            observer_.end(sight);
        };
        static_cast<void>(solid().potential(stepper_->q()));
        whole_.show(*stepper_, see, Evaluated::yes);
    }
    void take_fragments() {
        if (!solid().bonds().may_break()) return;
        result_.bonds.fragments = solid::fragments<Dim>(*stepper_, solid());
        result_.bonds.broken_share = solid().bonds().broken_share();
        result_.bonds.beyond_fracture_energy = solid().bonds().beyond_fracture_energy();
    }
    /// Figures of the whole run that solid and watches have.
    void take_figures() {
        watches_.take_figures();
        result_.bodies.local_rotations = solid().local_rotations(stepper_->q());
        result_.bodies.finite = solid().cells().finite_extremes();
        result_.energy.dissipated = solid().dissipated();
        result_.contact.report = solid().contact().report();
        if (const auto* by_nodes = solid().contact().pair_potential())
            result_.contact.overlaps.assign(by_nodes->interference().begin(), by_nodes->interference().end());
        result_.contact.skin = solid().contact().skin();
        result_.run.evaluations = solid().evaluations();
    }

    // Checkpoints

    [[nodiscard]] Checkpoint checkpoint() {
        Checkpoint checkpoint{.run = "",
                              .motion = whole_.of(stepper_->state()),
                              .solid = solid().state(),
                              .ledger = ledger_rows(result_.ledger),
                              .restarts = stepper_.restarts(),
                              .inadmissible_overlaps_max = result_.contact.inadmissible_overlaps_max,
                              .looks = {},
                              .observers = {}};
        whole_.on_first([&] { keep_looks(checkpoint); });
        return checkpoint;
    }
    void keep_looks(Checkpoint& checkpoint) const {
        checkpoint.run = identity(scene_, result_);
        StateWriter looks(looks_kind, looks_version);
        put_value(looks, result_.erosion);
        put_value(looks, watches_);
        checkpoint.looks = std::move(looks).finish();
        StateWriter state(observers_kind, observers_version);
        observer_.save(state);
        checkpoint.observers = std::move(state).finish();
    }

    void resume(const Checkpoint& from) {
        whole_.on_first([&] { require_same_run(from.run, identity(scene_, result_), options_.other_end); });
        require_later_end(from.motion);
        StateReader looks(from.looks, looks_kind, looks_version);
        get_value(looks, result_.erosion);
        go_on_from(from);
        record_rows(from.ledger, result_.ledger);
        get_value(looks, watches_);
        looks.finish();
        result_.energy.scale = known_scale<Dim>(scene_.energy_scale, result_);
        result_.contact.inadmissible_overlaps_max = from.inadmissible_overlaps_max;
        result_.run.resumed_after = stepper_->steps();
        times_.skip(stepper_->time(), stepper_->steps());
        soundness_.keep(*stepper_);
        whole_.on_first([&] { resume_observer(from.observers); });
    }
    void require_later_end(const dynamics::IntegratorState& motion) const {
        if (motion.steps <= result_.run.steps) return;
        throw BadInput(fmt::format(
            "the run is to end at step {}, t = {:.6g} s, and the checkpoint is of step {}, t = {:.6g} s. "
            "Give a later end.",
            result_.run.steps, static_cast<double>(result_.run.steps) * result_.run.dt, motion.steps, motion.time));
    }
    /// Solid, integrator and remedies do.
    void go_on_from(const Checkpoint& from) {
        if (has_lost_cells()) {
            erosion_.resume(from.motion);
            stepper_.take_solid();
            take_rest();
        }
        stepper_.go_on_from({from.motion, from.solid}, from.restarts);
    }
    void resume_observer(std::span<const std::byte> of_observers) {
        StateReader state(of_observers, observers_kind, observers_version);
        observer_.resume(scene_, result_, state);
        state.finish();
        if (has_lost_cells()) observer_.cells_left(solid(), erosion_.first_cells());
    }
    [[nodiscard]] bool has_lost_cells() const { return !result_.erosion.cells.empty(); }

    // Records

    void record() {
        const double excess_before = result_.ledger.energy_excess();
        measure();
        look_around();
        const auto& entries = result_.ledger.entries();
        result_.energy.scale = known_scale<Dim>(scene_.energy_scale, result_);
        if (entries.size() == 1 && scene_.contact && !options_.settle) check_contact(entries.front());
        whole_.on_first([&] { observer_.record(entries.back(), result_); });
        soundness_.judge(*stepper_, excess_before);
    }

    /// An entry of the ledger, and what is counted with it.
    void measure() {
        const Stopwatch watch(result_.seconds.ledger);
        result_.ledger.record(dynamics::measure(*stepper_, solid(), stepper_.restarts(), result_.erosion.left));
        const dynamics::LedgerEntry<Dim>& entry = result_.ledger.entries().back();
        const dynamics::RunView<Dim> now(*stepper_);
        result_.energy.accounts.record(
            entry, largest_speed(now, solid()),
            momentum_from_outside(stepper_->time(), scene_.mesh.n_bodies(), solid()) + result_.erosion.impulse_of_weight);
        result_.contact.report = solid().contact().report();
        result_.contact.sliding.record(result_.contact.report);
        watches_.record(entry, stepper_->q());
        result_.watch.compressed = most_compressed(scene_, solid());
        result_.contact.inadmissible_overlaps_max =
            std::max(result_.contact.inadmissible_overlaps_max, result_.contact.report.inadmissible_overlaps);
    }

    void look_around() {
        try {
            watches_.look_around(*stepper_);
        } catch (const Diverged&) {
            soundness_.tell_of_crossing(stepper_->state());
            throw;
        }
    }
    void check_contact(const dynamics::LedgerEntry<Dim>& at_start) {
        const double scale = std::max(at_start.kinetic, scene_.energy_scale.value);
        check_start_contact<Dim>(scene_, solid(), stepper_->q(), scale, result_.energy.at_rest);
    }

    Start<Dim>& start_;
    const Scene<Dim>& scene_;
    const RunOptions& options_;
    Observer<Dim>& observer_;
    RunResult<Dim>& result_;
    WholeRun<Dim> whole_;
    OutputTimes<Dim> times_;
    Stepper<Dim, Integrator> stepper_;
    Watches<Dim> watches_;
    Soundness<Dim> soundness_;
    RankBalance balance_;
    Erosion<Dim> erosion_;
};

}  // namespace

template <int Dim>
void take_steps(Start<Dim>& start, Observer<Dim>& observer, const Checkpoint* from) {
    const SolidIntegrator scheme = start.options.integrator;
    const double gauge = scheme == SolidIntegrator::bilbao ? run::gauge(start) : 0.0;
    dynamics::with_scheme<solid::Solid<Dim>>(scheme, {.gauge = gauge}, [&](const auto& make) {
        const auto make_at = [&](Start<Dim>& s) { return make(*s.solid, s.q, s.momentum, s.result.run.dt, s.local_steps); };
        TimeLoop<Dim, decltype(make_at(start))>(start, observer, make_at).run(from);
    });
}

template void take_steps<2>(Start<2>&, Observer<2>&, const Checkpoint*);
template void take_steps<3>(Start<3>&, Observer<3>&, const Checkpoint*);

}  // namespace abut::run
