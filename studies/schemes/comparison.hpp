#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abut/base/stopwatch.hpp"
#include "abut/run/files/folder_lock.hpp"
#include "abut/run/values/value.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/program.hpp"
#include "studies/schemes/gnuplot.hpp"
#include "studies/schemes/schemes.hpp"

namespace abut::studies {

/// A run at a node, as its scene sees it.
struct Node {
    double time;  ///< [s]
    std::span<const double> q;
    std::span<const double> p_before;  ///< p^{n-1/2}
    std::span<const double> p_after;   ///< p^{n+1/2}

    [[nodiscard]] double momentum(std::size_t i) const { return 0.5 * (p_before[i] + p_after[i]); }
};

/// Watcher of a scene beside the energies, in a run of one scheme; by itself it watches nothing.
class Watcher {
public:
    virtual ~Watcher() = default;
    virtual void look(const Node&) {}  ///< at the start and then at each node that is looked at
    [[nodiscard]] virtual std::vector<std::string> columns() const { return {}; }
    [[nodiscard]] virtual std::vector<double> row() const { return {}; }  ///< of the last look, for the file
    [[nodiscard]] virtual std::vector<run::Finding> findings() const { return {}; }
};

/// How long a run is and how often it is looked at.
struct Schedule {
    std::int64_t steps;
    std::int64_t look = 1;      ///< steps between two looks: largest values are those of all looks
    std::int64_t interval = 0;  ///< steps between two rows of the file, a multiple of `look`; 0: no file
    double energy_scale = 0.0;  ///< what errors are divided by [J]
};

/// Place and reason of the end of a run before its time.
struct BreakOff {
    std::int64_t step;
    double time;      ///< [s]
    std::string why;  ///< a sentence
};

/// One scheme's run. Largest values until it broke off, if it did.
struct SchemeRun {
    std::string name;
    double dt = 0.0;
    std::int64_t steps = 0;
    double energy_start = 0.0;           ///< H of q and p as given [J]
    double energy_scale = 0.0;           ///< [J]
    double energy_error = 0.0;           ///< max |H - energy_start| [J]
    double drift = 0.0;                  ///< max |own energy - its start| [J]
    double excess = 0.0;                 ///< max (H - H~) [J]
    double parasitic = 0.0;              ///< max |e|/m [m/s]
    std::optional<double> gauge_defect;  ///< of bilbao, max |psi - sqrt(2 (V + c))| [J^(1/2)]
    std::int64_t evaluations = 0;        ///< of bonds, in the steps
    double seconds = 0.0;                ///< of the steps, without reading the clock
    std::optional<BreakOff> broken_off;
    std::vector<double> q;  ///< at the end
    apps::Table series;     ///< empty if the schedule asks for none
    std::vector<run::Finding> findings;
};

namespace detail {

/// H beyond this many times the energy scale: the solution is lost, whatever the scheme's own energy says.
inline constexpr double explosion_factor = 1e3;

inline void raise(double& largest, double value) {
    if (std::isfinite(value)) largest = std::max(largest, value);
}

/// Time that a stopwatch measures of nothing [s]: a good part of a step of six masses.
[[nodiscard]] double clock_seconds();

/// Leads one integrator through its run.
template <class S, class Integrator>
class Follower {
public:
    Follower(S& system, Integrator& integrator, const Schedule& schedule, Watcher& watcher, SchemeRun& run)
        : system_(system), integrator_(integrator), schedule_(schedule), watcher_(watcher), run_(run), e_(system.size()) {}

    void follow(double dt) {
        own_start_ = integrator_.pseudo_energy();
        run_.series.columns = {"time", "energy", "own_energy", "drift", "excess", "parasitic"};
        for (const auto& name : watcher_.columns()) run_.series.columns.push_back(name);
        look();
        while (integrator_.steps() < schedule_.steps && !run_.broken_off) {
            advance(dt);
            const std::int64_t n = integrator_.steps();
            if (!run_.broken_off && (n % schedule_.look == 0 || n == schedule_.steps)) look();
        }
        run_.steps = integrator_.steps();
        run_.seconds = std::max(0.0, run_.seconds - static_cast<double>(run_.steps) * clock_seconds());
        run_.q.assign(integrator_.q().begin(), integrator_.q().end());
        run_.findings = watcher_.findings();
    }

private:
    void advance(double dt) {
        const std::int64_t before = system_.evaluations();
        try {
            const Stopwatch watch(run_.seconds);
            integrator_.step(dt, dynamics::StepChange::keep);
        } catch (const Diverged& error) {
            break_off(error.what());
        }
        run_.evaluations += system_.evaluations() - before;
    }

    void look() {
        const double energy = integrator_.energy(), own = integrator_.pseudo_energy(), excess = integrator_.energy_excess();
        const double parasitic = parasitic_speed();
        raise(run_.energy_error, std::abs(energy - run_.energy_start));
        raise(run_.drift, std::abs(own - own_start_));
        raise(run_.excess, excess);
        raise(run_.parasitic, parasitic);
        if constexpr (requires { integrator_.gauge_defect(); }) {
            if (!run_.gauge_defect) run_.gauge_defect = 0.0;
            raise(*run_.gauge_defect, std::abs(integrator_.gauge_defect()));
        }
        watcher_.look({integrator_.time(), integrator_.q(), integrator_.p_before(), integrator_.p_after()});
        if (!(energy <= explosion_factor * run_.energy_scale))
            return break_off("it explodes, H is above 1000 times H0. Take a shorter time step.");
        const std::int64_t n = integrator_.steps();
        if (schedule_.interval == 0 || (n % schedule_.interval != 0 && n != schedule_.steps)) return;
        run_.series.rows.push_back({integrator_.time(), energy, own, own - own_start_, excess, parasitic});
        for (const double value : watcher_.row()) run_.series.rows.back().push_back(value);
    }

    double parasitic_speed() {
        integrator_.parasitic_momentum(e_);
        double largest = 0.0;
        for (std::size_t i = 0; i < e_.size(); ++i) raise(largest, std::abs(system_.inverse_mass()[i] * e_[i]));
        return largest;
    }

    void break_off(const std::string& why) { run_.broken_off = {integrator_.steps(), integrator_.time(), why}; }

    S& system_;
    Integrator& integrator_;
    const Schedule& schedule_;
    Watcher& watcher_;
    SchemeRun& run_;
    double own_start_ = 0.0;
    std::vector<double> e_;
};

}  // namespace detail

/// Runs a scheme on a system. A run that explodes, or that its scheme refuses to go on with, breaks off: an outcome, no
/// error.
/// `prepare`, called with the integrator, may change it before the first step.
template <class S, class Prepare>
SchemeRun follow(Scheme scheme, S& system, const Start& start, const SchemeOptions& options, const Schedule& schedule,
                 Watcher& watcher, const Prepare& prepare) {
    SchemeRun run{.name = name_of(scheme), .dt = start.dt, .energy_scale = schedule.energy_scale};
    run.energy_start = system.potential(start.q) + 0.5 * dynamics::mass_product(start.p, system.inverse_mass(), start.p);
    with_integrator(scheme, system, start, options, [&](auto& integrator) {
        prepare(integrator);
        detail::Follower(system, integrator, schedule, watcher, run).follow(start.dt);
    });
    return run;
}
template <class S>
SchemeRun follow(Scheme scheme, S& system, const Start& start, const SchemeOptions& options, const Schedule& schedule,
                 Watcher& watcher) {
    return follow(scheme, system, start, options, schedule, watcher, [](auto&) {});
}

/// --interval.
void add_interval_option(apps::CommandParser& parser, int& interval);

/// Steps between two rows of a file of about 10,000 rows, unless the user has given it.
[[nodiscard]] std::int64_t rows_interval(int given, std::int64_t steps);

/// Makes the folder and takes it for as long as the result lives, and removes what an earlier run of the program left there:
/// summary.json, a file of each scheme, the picture, and `more`.
[[nodiscard]] run::FolderLock prepare_results(const apps::Program& program, const std::filesystem::path& out,
                                              std::vector<std::string> more = {});

/// A finished comparison.
struct Comparison {
    std::string title;  ///< of the table
    std::vector<SchemeRun> runs;
    std::vector<run::Finding> findings;  ///< of all of them together
    run::NamedValues options;            ///< as they were used
    Picture picture;
};

/// Leaves <scheme>.csv, the picture and summary.json, and prints the table: one line per figure, one column per scheme. Then
/// throws std::runtime_error if a run broke off, with its scheme, step, time and reason.
void report(const apps::Program& program, const std::filesystem::path& out, const Comparison& comparison);

}  // namespace abut::studies
