#include "support/run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>

#include "abut/dynamics/parasitic_filter.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "support/energy_file.hpp"
#include "support/energy_picture.hpp"
#include "support/files.hpp"
#include "support/frames.hpp"
#include "support/progress.hpp"
#include "support/summary.hpp"

namespace abut::examples {
namespace {

/// H beyond this many times its first value: the solution is lost, whatever H~ says.
constexpr double divergence_factor = 1e3;

class Stopwatch {
public:
    explicit Stopwatch(double& total) : total_(total), start_(Clock::now()) {}
    ~Stopwatch() { total_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    double& total_;
    Clock::time_point start_;
};

void remove_earlier_results(const std::filesystem::path& directory) {
    for (const char* name : {"summary.json", "energy.csv", "energy.csv.partial", "energy.png", "energy.gp", "cylinders.pvd", "cylinders_surface.pvd"}) {
        std::error_code error;
        std::filesystem::remove(directory / name, error);
        if (error)
            throw std::runtime_error(fmt::format("{}: the result of an earlier run cannot be removed: {}. Choose another folder with --out.",
                                                 (directory / name).string(), error.message()));
    }
}

template <int Dim>
dynamics::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, const RunOptions& options) {
    dynamics::SolidOptions<Dim> solid;
    solid.materials = scene.materials;
    solid.boundary.neumann = options.neumann;
    solid.contact = options.contact;
    return solid;
}

double choose_step(const RunOptions& options, const dynamics::StableStep& stable) {
    if (std::isnan(options.dt)) return options.cfl * stable.dt;
    if (options.dt > stable.dt && !options.allow_unstable)
        throw std::invalid_argument(fmt::format("--dt: {:.6g} s is above the stable step of {:.6g} s. Take at most that, or --cfl; --allow-unstable "
                                                "takes it all the same.",
                                                options.dt, stable.dt));
    return options.dt;
}

template <int Dim>
void check_alive(const dynamics::LedgerEntry<Dim>& entry, const dynamics::LedgerEntry<Dim>& first, double dt, double stable_dt) {
    if (std::isfinite(entry.pseudo_energy) && entry.energy <= divergence_factor * first.energy) return;
    throw std::runtime_error(fmt::format("step {}, t = {:.4g} s: the run has diverged: H is {:.3g} J and H~ {:.3g} J, {:.3g} J at the start, at most "
                                         "{:g} times that is allowed. Steps are {:.4g} s long, stable are {:.4g} s: lower --cfl or --dt. energy.csv.partial "
                                         "holds the records so far.",
                                         entry.step, entry.time, entry.energy, entry.pseudo_energy, first.energy, divergence_factor, dt, stable_dt));
}

/// One run, from the operators to the last step.
template <int Dim>
class Simulation {
public:
    Simulation(const Scene<Dim>& scene, const RunOptions& options)
        : options_(options), solid_(scene.mesh, solid_options(scene, options)), filter_(solid_) {
        result_.stable = dynamics::stable_step(solid_);
        result_.dt = choose_step(options, result_.stable);
        result_.steps = static_cast<std::int64_t>(std::ceil(scene.time / result_.dt));
        result_.stencils = solid_.ccg().stencil_report();
        const std::vector<double> at_rest(solid_.size(), 0.0);
        integrator_.emplace(solid_, at_rest, dynamics::uniform_momentum<Dim>(solid_, scene.velocity), result_.dt);
        if (options.filter)
            integrator_->set_after_step([this](auto q, double dt, auto before, auto after) { filter_(q, dt, before, after); });
    }

    [[nodiscard]] RunResult<Dim>& result() { return result_; }

    void run() {
        EnergyFile<Dim> energies(options_.out / "energy.csv");
        std::optional<Frames<Dim>> frames;
        if (options_.frames > 0) frames.emplace(options_.out, solid_.mesh(), options_.frames, result_.steps);
        Progress progress(result_.steps);
        result_.start = dynamics::body_motions(*integrator_, solid_);
        record(energies);
        write(frames);
        while (integrator_->steps() < result_.steps) {
            step();
            if (integrator_->steps() % options_.interval == 0 || integrator_->steps() == result_.steps) record(energies);
            write(frames);
            progress.show(integrator_->steps(), integrator_->time(), result_.ledger.pseudo_energy_drift() / result_.ledger.entries().front().kinetic);
        }
        result_.end = dynamics::body_motions(*integrator_, solid_);
        result_.contact = solid_.contact_report();
        result_.times = solid_.times();
        energies.finish();
    }

private:
    void step() {
        try {
            integrator_->step();
        } catch (const std::exception& error) {
            throw std::runtime_error(fmt::format("step {}, t = {:.4g} s (steps of {:.4g} s, stable are {:.4g} s): {} energy.csv.partial holds the records so far.",
                                                 integrator_->steps() + 1, integrator_->time(), result_.dt, result_.stable.dt, error.what()));
        }
    }

    void record(EnergyFile<Dim>& energies) {
        {
            const Stopwatch watch(result_.seconds.ledger);
            result_.ledger.record(dynamics::measure(*integrator_, solid_));
            result_.candidates_max = std::max(result_.candidates_max, solid_.contact_report().candidates);
        }
        const Stopwatch watch(result_.seconds.output);
        const auto& entries = result_.ledger.entries();
        energies.append(entries.back());
        check_alive(entries.back(), entries.front(), result_.dt, result_.stable.dt);
    }

    void write(std::optional<Frames<Dim>>& frames) {
        const Stopwatch watch(result_.seconds.output);
        if (frames) frames->write_if_due(*integrator_, solid_);
    }

    const RunOptions& options_;
    dynamics::Solid<Dim> solid_;
    dynamics::NeutralFilter<Dim> filter_;
    std::optional<dynamics::Memm<dynamics::Solid<Dim>>> integrator_;
    RunResult<Dim> result_;
};

template <int Dim>
void draw(const Scene<Dim>& scene, const RunOptions& options, RunResult<Dim>& result) {
    const Stopwatch watch(result.seconds.output);
    const auto& first = result.ledger.entries().front();
    const std::string title = fmt::format("{}, {}D, {} cells, {} steps", scene.program, Dim, scene.mesh.n_cells(), result.steps);
    result.without_picture = draw_energy(options.out, {title, first.pseudo_energy, first.kinetic});
}

}  // namespace

template <int Dim>
void run(const Scene<Dim>& scene, const RunOptions& options) {
    std::optional<oneapi::tbb::global_control> threads;
    if (options.threads > 0) threads.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));

    double total = 0.0;
    double setup = 0.0;
    std::optional<Simulation<Dim>> simulation;
    {
        const Stopwatch whole(total);
        {
            const Stopwatch watch(setup);
            prepare_directory(options.out);
            mesh::check_apart(scene.mesh, scene.remedy_if_overlapping, options.contact.broad_phase);
            simulation.emplace(scene, options);
        }
        spdlog::info("{} cells, {} boundary faces; {} steps of {:.4g} s", scene.mesh.n_cells(), scene.mesh.boundary_faces.size(),
                     simulation->result().steps, simulation->result().dt);
        remove_earlier_results(options.out);
        simulation->run();
        draw(scene, options, simulation->result());
    }
    auto& result = simulation->result();
    result.seconds.total = total;
    result.seconds.setup = setup;
    write_whole(options.out / "summary.json", summary(scene, options, result).dump(2) + "\n");
    print_table(scene, options, result);
}

int report_errors(const std::string& name, const std::function<void()>& program) {
    try {
        spdlog::set_default_logger(spdlog::stdout_color_mt(name));
        spdlog::set_pattern("[%T] %v");
        program();
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: error: {}\n", name, error.what());
        return 1;
    }
}

template void run<2>(const Scene<2>&, const RunOptions&);
template void run<3>(const Scene<3>&, const RunOptions&);

}  // namespace abut::examples
