#include "runs.hpp"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/input/scene_file.hpp"
#include "abut/run/report/result_files.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/verdict.hpp"
#include "abut/run/words/warnings.hpp"
#include "docstrings.hpp"
#include "record.hpp"
#include "scenes.hpp"
#include "tables.hpp"

namespace abut::python {
namespace {

using namespace py::literals;

/// Runs a scene. The message of a run that fails ends with what is left of it.
template <int Dim>
run::RunResult<Dim> simulate_into(run::ResultFiles<Dim>& files, const run::Scene<Dim>& scene, const run::RunOptions& options,
                                  run::Observer<Dim>& observer) {
    std::optional<run::Checkpoint> from;
    if (options.resume) from = std::move(files.last_checkpoint().checkpoint);
    try {
        run::RunResult<Dim> result = run::simulate<Dim>(scene, options, observer, from ? &*from : nullptr);
        files.finish(scene, result);
        return result;
    } catch (const Error& error) {
        throw_again(error, error.what() + files.left_behind());
    }
}

/// {column: array}, a row per cell that has left.
template <int Dim>
py::dict eroded_of(const run::ErosionReport<Dim>& erosion) {
    std::vector<std::int32_t> cell;
    std::vector<std::int64_t> step;
    std::vector<double> time;
    for (const run::ErodedCell& one : erosion.cells) {
        cell.push_back(one.cell);
        step.push_back(one.step);
        time.push_back(one.time);
    }
    return py::dict("cell"_a = copy_of(cell), "step"_a = copy_of(step), "time"_a = copy_of(time));
}

/// A function of Python that names cells that leave, called after each step; none for None.
template <int Dim>
auto leaving_of(const py::object& function) -> decltype(run::Scene<Dim>::leaving) {
    if (function.is_none()) return {};
    return [held = kept(function)](const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) {
        const py::gil_scoped_acquire lock;
        const py::object cells = shown_to<Dim>(*held, view, solid);
        try {
            return cells.is_none() ? std::vector<std::int32_t>() : py::cast<std::vector<std::int32_t>>(cells);
        } catch (const py::cast_error&) {
            throw py::type_error("leaving(state) gave " + std::string(py::str(py::repr(cells))) +
                                 "; numbers of cells are needed, or None");
        }
    };
}

/// Data of which abut.Result is made. `name`: what files and summary call the run.
template <int Dim>
py::object run_scene(const run::Scene<Dim>& scene, const run::RunOptions& options, const std::string& name,
                     const py::object& look) {
    Look<Dim> python(look);
    Record<Dim> record;
    std::optional<run::RunResult<Dim>> result;
    {
        const py::gil_scoped_release release;
        if (options.out.empty()) {
            run::Observers<Dim> both{record, python};
            result.emplace(run::simulate<Dim>(scene, options, both));
        } else {
            run::ResultFiles<Dim> files(options, name, "bodies");
            run::Observers<Dim> all{files, record, python};
            result.emplace(simulate_into<Dim>(files, scene, options, all));
        }
    }
    py::list warnings;
    for (const run::Warning& warning : run::without_notes(run::all_warnings(scene, *result)))
        warnings.append(text_of(warning.text));
    const run::Verdict said = run::verdict(scene, *result);
    const py::dict figures(
        "name"_a = text_of(name), "title"_a = text_of(scene.title), "comment"_a = text_of(scene.comment),
        "mesh"_a = py::cast(scene.mesh), "ledger"_a = table_of(result->ledger), "probes"_a = record.probes(),
        "forces"_a = record.forces(), "frames"_a = record.frames(), "eroded"_a = eroded_of(result->erosion),
        "displacement"_a = copy_of_vectors<Dim>(python.final_displacement), "start"_a = motions_of(result->bodies.start),
        "end"_a = motions_of(result->bodies.end), "steps"_a = result->run.steps,
        "resumed_after"_a = result->run.resumed_after, "dt"_a = result->run.dt, "stable_dt"_a = result->run.stable.dt,
        "complete"_a = result->run.complete, "energy_scale"_a = result->energy.scale.value,
        "contact"_a = report_of(result->contact.report), "warnings"_a = warnings, "verdict"_a = text_of(said.text),
        "good"_a = said.good, "seconds"_a = result->seconds.total,
        "summary"_a = text_of(run::summary_json(name, scene, *result)),
        "table"_a = text_of(run::closing_table(name, scene, *result)),
        "out"_a = options.out.empty() ? py::object(py::none()) : py::object(py::cast(options.out)));
    return py::module_::import("abut._results").attr("Result")(figures);
}

template <int Dim>
py::object simulate(const mesh::Mesh<Dim>& mesh, const std::vector<solid::Material>& materials, const py::object& velocity,
                    const py::object& acceleration, const std::map<std::string, py::object>& held,
                    const std::vector<std::string>& rollers, const std::map<std::string, py::object>& traction,
                    const std::map<std::string, py::object>& temperature_rise, const py::object& displacement,
                    const py::object& added_velocity, bool contact, std::optional<double> energy_scale,
                    const py::object& look, const py::kwargs& given) {
    const run::Scene<Dim> scene = scene_of<Dim>({mesh, materials, velocity, acceleration, held, rollers, traction,
                                                 temperature_rise, displacement, added_velocity, contact, energy_scale});
    return run_scene<Dim>(scene, options_of(given), "python", look);
}

template <int Dim>
py::object run_file(const input::SceneFile& file, const py::object& look, const py::object& leaving) {
    run::Scene<Dim> scene;
    {
        const py::gil_scoped_release release;
        scene = file.scene<Dim>();
    }
    scene.leaving = leaving_of<Dim>(leaving);
    return run_scene<Dim>(scene, file.options(), file.name(), look);
}

py::object run_source(const SceneSource& source, const py::object& look, const py::object& leaving, const py::dict& given) {
    const input::SceneFile file = scene_file(source, given, 0);
    return file.dimension() == 2 ? run_file<2>(file, look, leaving) : run_file<3>(file, look, leaving);
}

template <int Dim>
void add_dimension(py::module_& module, const std::string& suffix) {
    auto glance =
        py::class_<Glance<Dim>, std::shared_ptr<Glance<Dim>>>(module, ("State" + suffix).c_str(), docs::state_class);
    add_state(glance, [](const Glance<Dim>& self) { return self.now(); });

    const std::map<std::string, py::object> none;
    module.def("simulate", &simulate<Dim>, "mesh"_a, "materials"_a, "velocity"_a, py::kw_only(),
               "acceleration"_a = py::none(), "held"_a = none, "rollers"_a = std::vector<std::string>(), "traction"_a = none,
               "temperature_rise"_a = none, "displacement"_a = py::none(), "added_velocity"_a = py::none(),
               "contact"_a = true, "energy_scale"_a = py::none(), "look"_a = py::none(),
               (std::string(docs::simulate) + docs::scene_parameters + docs::simulate_parameters + docs::simulate_returns +
                option_text() + docs::simulate_end)
                   .c_str());
}

}  // namespace

input::SceneFile scene_file(const SceneSource& source, const py::dict& given, int least_steps) {
    const input::Overrides overrides{.set = source.set,
                                     .options =
                                         [&](run::RunOptions& options) {
                                             options.out.clear();
                                             take_options(given, options);
                                             if (std::isnan(options.time))
                                                 options.steps = std::max(options.steps, least_steps);
                                         },
                                     .meshes = source.meshes()};
    if (source.toml) return input::SceneFile(input::SceneText{*source.toml, source.file}, overrides);
    return input::SceneFile(source.file, overrides);
}

void add_runs(py::module_& module) {
    add_dimension<2>(module, "2D");
    add_dimension<3>(module, "3D");
    module.def(
        "run_toml",
        [](const std::filesystem::path& file, const std::optional<std::string>& toml, const py::dict& meshes,
           const std::vector<std::string>& set, const py::object& look, const py::object& leaving, const py::dict& options) {
            return run_source({file, toml, meshes, set}, look, leaving, options);
        },
        "file"_a, "toml"_a, "meshes"_a, "set"_a, "look"_a, "leaving"_a, "options"_a, "For abut.run.");
}

}  // namespace abut::python
