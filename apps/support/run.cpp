#include "apps/support/run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <spdlog/spdlog.h>

#include <optional>
#include <stdexcept>

#include "abut/base/stopwatch.hpp"
#include "apps/support/energy_file.hpp"
#include "apps/support/energy_picture.hpp"
#include "apps/support/files.hpp"
#include "apps/support/frames.hpp"
#include "apps/support/progress.hpp"
#include "apps/support/simulation.hpp"
#include "apps/support/summary.hpp"
#include "apps/support/warnings.hpp"

namespace abut::examples {
namespace {

using oneapi::tbb::global_control;

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
    warn_of_corners(result);
}

template <int Dim>
void log_end(const RunResult<Dim>& result) {
    warn_of_compression(result);
    warn_of_contact(result);
    if (result.not_admitted_max > 0)
        spdlog::info("up to {} pairs of faces overlap without being contacts: far sides of bodies", result.not_admitted_max);
}

/// What a run leaves behind as it goes, and what it says.
template <int Dim>
class Files : public Observer<Dim> {
public:
    Files(const RunOptions& options, const std::string& series) : options_(options), series_(series) {}

    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override {
        log_start(scene, result);
        energies_.emplace(options_.out / "energy.csv");
        if (options_.frames > 0) frames_.emplace(options_.out, series_, scene.mesh, options_.frames, result.steps);
        progress_.emplace(result.steps);
    }
    void record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>& result) override {
        const Stopwatch watch(seconds_);
        energies_->append(entry);
        drift_ = result.ledger.pseudo_energy_drift() / result.scale.value;
        warn_once(entry.step, result.contact);
    }
    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        const Stopwatch watch(seconds_);
        if (frames_) frames_->write_if_due(run, solid);
        if (run.steps > 0) progress_->show(run.steps, run.time, drift_);
    }
    void finish() {
        progress_.reset();
        energies_->finish();
    }

    [[nodiscard]] bool have_begun() const { return energies_.has_value(); }
    [[nodiscard]] double seconds() const { return seconds_; }

private:
    void warn_once(std::int64_t step, const contact::ContactReport& contact) {
        if (warned_ || contact.compressed_steps == 0) return;
        warned_ = true;
        spdlog::warn(
            "by step {} faces are pressed {:.2g} of D, the depth of their cells, into each other, more than {:g}; above "
            "{:g} the run stops. A lower speed or load makes it less",
            step, contact.compression_max, options_.contact.compression_warning, options_.contact.compression_limit);
    }

    const RunOptions& options_;
    const std::string& series_;
    std::optional<EnergyFile<Dim>> energies_;
    std::optional<Frames<Dim>> frames_;
    std::optional<Progress> progress_;
    double drift_ = 0.0;  // of H~ so far, over the energy scale
    double seconds_ = 0.0;
    bool warned_ = false;
};

/// A run that fails says what is left of it.
template <int Dim>
RunResult<Dim> simulate_into(Files<Dim>& files, const Scene<Dim>& scene, const RunOptions& options) {
    try {
        return simulate<Dim>(scene, options, files);
    } catch (const std::runtime_error& error) {
        if (!files.have_begun()) throw;
        throw std::runtime_error(std::string(error.what()) + " energy.csv.partial holds the records so far.");
    }
}

template <int Dim>
void draw(const std::string& program, const Scene<Dim>& scene, const RunOptions& options, RunResult<Dim>& result) {
    const Stopwatch watch(result.seconds.output);
    const std::string title = fmt::format("{}, {}D, {}, {} cells, {} steps", program, Dim, name_of(options.integrator),
                                          scene.mesh.n_cells(), result.steps);
    result.without_picture = draw_energy(
        options.out, {title, result.ledger.entries().front().pseudo_energy, result.scale.value, result.scale.name});
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
    RunResult<Dim> result;
    {
        const Stopwatch whole(seconds.total);
        scene = timed_scene(make_scene, seconds.mesh);
        Files<Dim> files(options, program.series);
        result = simulate_into(files, *scene, options);
        files.finish();
        result.seconds.output = files.seconds();
        draw(program.name, *scene, options, result);
    }
    result.seconds.total = seconds.total;
    result.seconds.mesh = seconds.mesh;
    result.threads = static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
    if (scene->findings) result.findings = scene->findings(result);
    write_whole(options.out / "summary.json", summary(program, *scene, options, result).dump(2) + "\n");
    log_end(result);
    print_table(program, *scene, options, result);
}

template void run<2>(const Program&, const RunOptions&, const std::function<Scene<2>()>&);
template void run<3>(const Program&, const RunOptions&, const std::function<Scene<3>()>&);

}  // namespace abut::examples
