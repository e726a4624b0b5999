#include "support/run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/local_steps.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/parasitic_filter.hpp"
#include "abut/geometry/stopwatch.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "support/energy_file.hpp"
#include "support/energy_picture.hpp"
#include "support/files.hpp"
#include "support/frames.hpp"
#include "support/progress.hpp"
#include "support/summary.hpp"

namespace abut::examples {
namespace {

using oneapi::tbb::global_control;

/// H beyond this many times its first value: the solution is lost, whatever H~ says.
constexpr double divergence_factor = 1e3;
constexpr int default_levels = 8;
/// More than any run takes; all of them are counted exactly in doubles and integers.
constexpr double most_steps = 1e15;

template <int Dim>
dynamics::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, const RunOptions& options) {
    dynamics::SolidOptions<Dim> solid = scene.solid;
    solid.boundary.neumann = options.neumann;
    solid.contact = options.contact;
    return solid;
}

double choose_step(const RunOptions& options, const dynamics::StableStep& stable) {
    if (std::isnan(options.dt)) return options.cfl * stable.dt;
    if (options.dt > stable.dt && !options.allow_unstable)
        throw std::invalid_argument(
            fmt::format("--dt: {:.6g} s is above the stable step of {:.6g} s. Take at most that, or --cfl; "
                        "--allow-unstable takes it all the same.",
                        options.dt, stable.dt));
    return options.dt;
}

std::int64_t choose_steps(const RunOptions& options, double time_of_scene, double dt) {
    if (std::isnan(options.time) && options.steps > 0) return options.steps;
    const double time = std::isnan(options.time) ? time_of_scene : options.time;
    const double steps = std::ceil(time / dt);
    if (!(steps >= 1.0 && steps <= most_steps))
        throw std::invalid_argument(fmt::format(
            "--time, --dt: {:g} s in steps of {:g} s are {:g} steps, 1 to {:g} are allowed. Give another end of the "
            "run with --time or --steps, or another step with --dt or --cfl.",
            time, dt, steps, most_steps));
    return static_cast<std::int64_t>(steps);
}

dynamics::SolidTimes difference(const dynamics::SolidTimes& a, const dynamics::SolidTimes& b) {
    return {a.bulk - b.bulk, a.contact - b.contact, a.search - b.search};
}

EnergyScale known_scale(EnergyScale scale, double kinetic) {
    if (scale.value == 0.0) scale.value = kinetic;
    if (!(scale.value > 0.0))
        throw std::invalid_argument(fmt::format(
            "the kinetic energy at the start is {} J, above 0 J is needed to measure energies with. Raise the speed "
            "at the start; a scene that starts at rest gives Scene::energy_scale.",
            scale.value));
    return scale;
}

/// What a run begins from, whatever its integrator.
template <int Dim>
struct Start {
    Start(const Scene<Dim>& scene, const RunOptions& options) : solid(scene.mesh, solid_options(scene, options)) {
        result.stable = dynamics::stable_step(solid);
        result.finest_dt = result.dt = choose_step(options, result.stable);
        if (options.integrator == SolidIntegrator::memm_async) set_local_steps(options);
        result.steps = choose_steps(options, scene.time, result.dt);
        result.stencils = solid.ccg().stencil_report();
        result.boundary_stencils = solid.ccg().boundary().report;
        result.contact_faces_left_out = solid.contact_faces_left_out();
        at_rest.assign(solid.size(), 0.0);
        momentum = dynamics::uniform_momentum<Dim>(solid, scene.velocity);
    }

    dynamics::Solid<Dim> solid;
    RunResult<Dim> result;
    std::vector<double> at_rest;
    std::vector<double> momentum;
    dynamics::LocalSteps local_steps;  // of memm_async

private:
    void set_local_steps(const RunOptions& options) {
        auto local = dynamics::local_steps(solid, result.stable,
                                           {.most_levels = options.levels == 0 ? default_levels : options.levels,
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
    Simulation(const Scene<Dim>& scene, const RunOptions& options, Start<Dim>& start, Integrator integrator)
        : scene_(scene),
          options_(options),
          solid_(start.solid),
          result_(start.result),
          filter_(solid_),
          integrator_(std::move(integrator)),
          times_of_setup_(solid_.times()) {
        if constexpr (Integrator::takes_after_step)
            if (options.filter)
                integrator_.set_after_step(
                    [this](auto q, double dt, auto before, auto after) { filter_(q, dt, before, after); });
    }

    void run(const std::string& series) {
        EnergyFile<Dim> energies(options_.out / "energy.csv");
        std::optional<Frames<Dim>> frames;
        if (options_.frames > 0) frames.emplace(options_.out, series, solid_.mesh(), options_.frames, result_.steps);
        Progress progress(result_.steps);
        result_.start = dynamics::body_motions<Dim>(integrator_, solid_);
        record(energies);
        write(frames);
        while (integrator_.steps() < result_.steps) {
            step();
            if (integrator_.steps() % options_.interval == 0 || integrator_.steps() == result_.steps) record(energies);
            write(frames);
            progress.show(integrator_.steps(), integrator_.time(),
                          result_.ledger.pseudo_energy_drift() / result_.scale.value);
        }
        result_.end = dynamics::body_motions<Dim>(integrator_, solid_);
        result_.contact = solid_.contact_report();
        result_.skin = solid_.contact()->skin();
        result_.evaluations = solid_.evaluations();
        result_.times = difference(solid_.times(), times_of_setup_);
        energies.finish();
    }

private:
    void step() {
        try {
            integrator_.step();
        } catch (const std::exception& error) {
            throw std::runtime_error(
                fmt::format("step {}, t = {:.4g} s (steps of {:.4g} s, stable are {:.4g} s): {} "
                            "energy.csv.partial holds the records so far.",
                            integrator_.steps() + 1, integrator_.time(), result_.dt, result_.stable.dt, error.what()));
        }
        if (scene_.after_step) scene_.after_step(solid_, result_.dt);
    }

    void record(EnergyFile<Dim>& energies) {
        {
            const Stopwatch watch(result_.seconds.ledger);
            result_.ledger.record(dynamics::measure(integrator_, solid_));
            const auto contact = solid_.contact_report();
            result_.not_admitted_max = std::max(result_.not_admitted_max, contact.not_admitted);
            warn_once(contact);
        }
        const Stopwatch watch(result_.seconds.output);
        const auto& entries = result_.ledger.entries();
        if (entries.size() == 1) result_.scale = known_scale(scene_.energy_scale, entries.front().kinetic);
        energies.append(entries.back());
        check_alive(entries.back(), std::max(entries.front().energy, result_.scale.value));
    }

    void warn_once(const contact::ContactReport& contact) {
        if (warned_ || contact.compressed_steps == 0) return;
        warned_ = true;
        spdlog::warn(
            "by step {} faces are pressed {:.2g} of the skin D into each other, more than {:g}; above {:g} the run stops. "
            "A lower speed or load makes it less",
            integrator_.steps(), contact.compression_max, options_.contact.compression_warning,
            options_.contact.compression_limit);
    }

    void check_alive(const dynamics::LedgerEntry<Dim>& entry, double scale) const {
        if (std::isfinite(entry.pseudo_energy) && entry.energy <= divergence_factor * scale) return;
        throw std::runtime_error(fmt::format(
            "step {}, t = {:.4g} s: the run has diverged: H is {:.3g} J and H~ {:.3g} J; {:g} times {:.3g} J is allowed. "
            "Steps "
            "are {:.4g} s long, stable are {:.4g} s: lower --cfl or --dt. energy.csv.partial holds the records so far.",
            entry.step, entry.time, entry.energy, entry.pseudo_energy, divergence_factor, scale, result_.dt,
            result_.stable.dt));
    }

    void write(std::optional<Frames<Dim>>& frames) {
        const Stopwatch watch(result_.seconds.output);
        if (frames) frames->write_if_due(integrator_, solid_);
    }

    const Scene<Dim>& scene_;
    const RunOptions& options_;
    dynamics::Solid<Dim>& solid_;
    RunResult<Dim>& result_;
    dynamics::NeutralFilter<Dim> filter_;
    Integrator integrator_;
    dynamics::SolidTimes times_of_setup_;  // the start-up of the scheme, in the seconds of set-up already
    bool warned_ = false;
};

void check(const RunOptions& options) {
    if (options.filter && options.integrator != SolidIntegrator::memm)
        throw std::invalid_argument(
            fmt::format("--filter neutral: the filter is made for memm, and {} was chosen. Take --filter none.",
                        name_of(options.integrator)));
    const RunOptions by_default;
    if (options.integrator != SolidIntegrator::memm_async &&
        (options.levels != by_default.levels || options.contact_margin != by_default.contact_margin ||
         options.contact_levels != by_default.contact_levels))
        throw std::invalid_argument(
            fmt::format("--levels, --contact-margin, --contact-levels: {} takes one step for all cells. Take --integrator "
                        "memm_async, or leave them out.",
                        name_of(options.integrator)));
    if (!std::isnan(options.gauge) && options.integrator != SolidIntegrator::bilbao)
        throw std::invalid_argument(fmt::format("--gauge: {} has no gauge. Take --integrator bilbao, or leave --gauge out.",
                                                name_of(options.integrator)));
}

/// The one place that knows all schemes.
template <int Dim>
void simulate(const std::string& series, const Scene<Dim>& scene, const RunOptions& options, Start<Dim>& start) {
    using Solid = dynamics::Solid<Dim>;
    const auto run_with = [&](auto integrator) {
        Simulation<Dim, decltype(integrator)>(scene, options, start, std::move(integrator)).run(series);
    };
    const double dt = start.result.dt;
    switch (options.integrator) {
        case SolidIntegrator::memm:
            return run_with(dynamics::Memm<Solid>(start.solid, start.at_rest, start.momentum, dt));
        case SolidIntegrator::memm_async:
            return run_with(dynamics::MemmAsync<Solid>(start.solid, start.at_rest, start.momentum, dt, start.local_steps));
        case SolidIntegrator::leapfrog:
            return run_with(dynamics::Leapfrog<Solid>(start.solid, start.at_rest, start.momentum, dt));
        case SolidIntegrator::bilbao:
            return run_with(
                dynamics::Bilbao<Solid>(start.solid, start.at_rest, start.momentum, dt, gauge(scene, options, start)));
    }
}

void log_mesh(const mesh::BuildReport& report) {
    for (const std::string& warning : report.warnings) spdlog::warn("Gmsh: {}", warning);
    if (report.n_unused_vertices > 0)
        spdlog::info("{} vertices belong to no cell and are left out", report.n_unused_vertices);
    if (report.n_ignored_elements > 0)
        spdlog::info("{} elements are neither cells nor faces of a named group and are left out", report.n_ignored_elements);
    if (report.n_cut_cells > 0)
        spdlog::info("{} cells are cut into tetrahedra, for {} faces that are not planar", report.n_cut_cells,
                     report.n_non_planar_faces);
    if (report.n_coincident_vertices > 0)
        spdlog::warn("{} vertices lie on a vertex of another body: meshes that match are a special case of contact",
                     report.n_coincident_vertices);
}

/// What was found at set-up and is not as it should be.
template <int Dim>
void log_start(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    spdlog::info("{} cells, {} boundary faces; {} steps of {:.4g} s", scene.mesh.n_cells(), scene.mesh.boundary_faces.size(),
                 result.steps, result.dt);
    log_mesh(scene.mesh.report);
    if (const auto& stencils = result.stencils; stencils.extrapolated > 0)
        spdlog::warn(
            "{} of {} faces extrapolate from the cells around them, worst weight {:.2g}: the stable step is shorter",
            stencils.extrapolated, stencils.faces, stencils.worst_weight);
    if (result.contact_faces_left_out > 0)
        spdlog::info("{} faces with a prescribed displacement take no part in contact", result.contact_faces_left_out);
}

template <int Dim>
void log_end(const RunResult<Dim>& result) {
    if (result.contact.compressed_steps > 0)
        spdlog::warn("strongly compressed in {} of {:.0f} steps, at most {:.2g} of the skin D",
                     result.contact.compressed_steps, static_cast<double>(result.steps) * result.dt / result.finest_dt,
                     result.contact.compression_max);
    if (result.not_admitted_max > 0)
        spdlog::info("up to {} pairs of faces overlap without being contacts: far sides of bodies", result.not_admitted_max);
    if (result.contact.lost_contacts > 0)
        spdlog::warn("{} contacts were lost, 0 are allowed: the energy is not exact", result.contact.lost_contacts);
}

template <int Dim>
void draw(const std::string& program, const Scene<Dim>& scene, const RunOptions& options, RunResult<Dim>& result) {
    const Stopwatch watch(result.seconds.output);
    const std::string title = fmt::format("{}, {}D, {}, {} cells, {} steps", program, Dim, name_of(options.integrator),
                                          scene.mesh.n_cells(), result.steps);
    result.without_picture = draw_energy(
        options.out, {title, result.ledger.entries().front().pseudo_energy, result.scale.value, result.scale.name});
}

/// The same for every dimension on the command line, but not here.
template <int Dim>
RunOptions with_defaults(RunOptions options) {
    if (options.interval == 0) options.interval = Dim == 2 ? 1 : 10;
    if (options.contact.quadrature == 0) options.contact.quadrature = Dim;
    return options;
}

template <int Dim>
Scene<Dim> timed_scene(const std::function<Scene<Dim>()>& make_scene, double& seconds) {
    const Stopwatch watch(seconds);
    return make_scene();
}

}  // namespace

template <int Dim>
void run(const Program& program, const RunOptions& given, const std::function<Scene<Dim>()>& make_scene) {
    const RunOptions options = with_defaults<Dim>(given);
    std::optional<global_control> threads;
    if (options.threads > 0)
        threads.emplace(global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));

    check(options);
    prepare_directory(options.out);
    remove_earlier_results(options.out, program.series);
    RunSeconds seconds;
    std::optional<Scene<Dim>> scene;
    std::optional<Start<Dim>> start;
    {
        const Stopwatch whole(seconds.total);
        scene = timed_scene(make_scene, seconds.mesh);
        {
            const Stopwatch watch(seconds.setup);
            mesh::check_apart(scene->mesh, scene->remedy_if_overlapping, options.contact.search.broad_phase);
            start.emplace(*scene, options);
        }
        log_start(*scene, start->result);
        simulate(program.series, *scene, options, *start);
        draw(program.name, *scene, options, start->result);
    }
    auto& result = start->result;
    result.seconds.total = seconds.total;
    result.seconds.mesh = seconds.mesh;
    result.seconds.setup = seconds.setup;
    result.threads = static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
    if (scene->findings) result.findings = scene->findings(result);
    write_whole(options.out / "summary.json", summary(program, *scene, options, result).dump(2) + "\n");
    log_end(result);
    print_table(program, *scene, options, result);
}

template void run<2>(const Program&, const RunOptions&, const std::function<Scene<2>()>&);
template void run<3>(const Program&, const RunOptions&, const std::function<Scene<3>()>&);

}  // namespace abut::examples
