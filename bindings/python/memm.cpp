#include "runs.hpp"

#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>

#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/dynamics/step_options.hpp"
#include "abut/input/scene_file.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/without_cells.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/outside_view.hpp"
#include "abut/solid/step_of_breaking.hpp"
#include "abut/solid/stepped_run.hpp"
#include "docstrings.hpp"
#include "in_use.hpp"
#include "record.hpp"
#include "scenes.hpp"
#include "tables.hpp"

namespace abut::python {
namespace {

using namespace py::literals;

constexpr std::array<Word<dynamics::StepChange>, 2> step_changes{
    {{"keep", dynamics::StepChange::keep}, {"restart", dynamics::StepChange::restart}}};
constexpr std::array<Word<solid::LoadImpulse>, 2> load_impulses{
    {{"as_given", solid::LoadImpulse::as_given}, {"trapezoid", solid::LoadImpulse::trapezoid}}};

constexpr const char* run_in_use = "this run takes steps in another thread. Use one thread at a time.";

/// A solid under MEMM, taken step by step.
template <int Dim>
class Memm {
public:
    Memm(run::Scene<Dim> scene, const run::RunOptions& given) : scene_(std::move(scene)), options_(checked(scene_, given)) {
        auto solid = std::make_unique<solid::Solid<Dim>>(scene_.mesh, run::solid_options(scene_, options_));
        stable_dt_ = solid::step_of_breaking(*solid).dt;
        std::vector<double> q = run::displacement_at_start(scene_, *solid);
        const std::vector<double> p = run::momentum_at_start(scene_, *solid);
        run_.emplace(std::move(solid), std::move(q), p, run::choose_step(options_, stable_dt_),
                     solid::RunRemedies{.filter = options_.filter, .restart = options_.restart});
        record();
    }

    /// Ctrl-C ends it between two steps.
    void step(std::int64_t n) {
        if (n < 0) throw py::value_error("step: n is " + std::to_string(n) + "; 0 and more are allowed");
        const bindings::Use use(in_use_, run_in_use);
        const py::gil_scoped_release release;
        auto asked = std::chrono::steady_clock::now();
        for (std::int64_t i = 0; i < n; ++i) {
            run_->step();
            if (const auto now = std::chrono::steady_clock::now(); now - asked > std::chrono::milliseconds(50)) {
                const py::gil_scoped_acquire lock;
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                asked = now;
            }
        }
    }
    void set_step(double dt, const std::string& change) {
        const bindings::Use use(in_use_, run_in_use);
        const dynamics::StepChange how = choice_called(step_changes, "set_step: change", change);
        if (!options_.allow_unstable)
            dynamics::require_stable("set_step: dt", dt, stable_dt_, "Give at most that (stable_dt).");
        std::string warning;
        {
            const py::gil_scoped_release release;
            warning = run_->set_step(dt, how, "run.clock()");
        }
        if (!warning.empty() && PyErr_WarnEx(PyExc_RuntimeWarning, ("abut: " + warning).c_str(), 1) < 0)
            throw py::error_already_set();
    }
    void set_traction(const std::string& group, const py::object& traction) {
        const bindings::Use use(in_use_, run_in_use);
        run_->solid().set_traction(group, vectors_of<Dim>(traction, "traction"));
    }
    [[nodiscard]] py::dict faces(const std::string& group) {
        const bindings::Use use(in_use_, run_in_use);
        return faces_of<Dim>(solid::outside_faces<Dim>(run_->memm(), run_->solid(), group),
                             run_->solid().outside(group).motion(run_->memm().q(), run_->memm().next_q(),
                                                                 run_->memm().time(), run_->memm().dt()));
    }
    [[nodiscard]] py::dict outside_work() const {
        const bindings::Use use(in_use_, run_in_use);
        const solid::OutsideWork work = run_->solid().outside_work(run_->memm().q());
        return py::dict("steps"_a = work.steps, "changes"_a = work.changes, "held"_a = work.held, "heat"_a = work.heat);
    }
    void record() {
        const bindings::Use use(in_use_, run_in_use);
        run_->record();
    }
    [[nodiscard]] py::object ledger() const {
        const bindings::Use use(in_use_, run_in_use);
        return table_of(run_->ledger());
    }
    [[nodiscard]] py::dict remove_cells(const std::vector<std::int32_t>& cells) {
        const bindings::Use use(in_use_, run_in_use);
        solid::Left<Dim> left;
        {
            const py::gil_scoped_release release;
            auto [mesh, old_cells] = mesh::without_cells<Dim>(run_->solid().mesh(), cells);
            auto next = std::make_unique<mesh::Mesh<Dim>>(std::move(mesh));
            left = run_->change(std::make_unique<solid::Solid<Dim>>(*next, run_->solid().options()), old_cells);
            mesh_ = std::move(next);
            stable_dt_ = solid::step_of_breaking(run_->solid()).dt;
        }
        return py::dict("cells"_a = left.cells, "mass"_a = left.mass,
                        "momentum"_a = py::array_t<double>(py::ssize_t{Dim}, left.momentum.data()),
                        "kinetic"_a = left.kinetic, "potential"_a = left.potential);
    }
    [[nodiscard]] const mesh::Mesh<Dim>& mesh() const { return run_->solid().mesh(); }
    [[nodiscard]] double dt() const { return run_->memm().dt(); }
    [[nodiscard]] double stable_dt() const { return stable_dt_; }
    [[nodiscard]] py::array_t<double> masses() const { return copy_of(run_->solid().masses()); }
    [[nodiscard]] py::list bodies() const {
        const bindings::Use use(in_use_, run_in_use);
        return motions_of(solid::body_motions<Dim>(view(), run_->solid()));
    }
    [[nodiscard]] py::dict contact() const {
        const bindings::Use use(in_use_, run_in_use);
        return report_of(run_->solid().contact().report());
    }

    /// The present state, while somebody looks at it.
    struct Held {
        bindings::Use use;
        dynamics::RunView<Dim> view;
        State<Dim> state;
        explicit Held(Memm& run) : use(run.in_use_, run_in_use), view(run.run_->memm()), state(view, run.run_->solid()) {}
        const State<Dim>* operator->() const { return &state; }
    };

    /// A clock of this run, which is kept with it.
    [[nodiscard]] solid::ClockedRun<Dim> clock(const std::string& impulse) {
        const bindings::Use use(in_use_, run_in_use);
        return solid::ClockedRun<Dim>(*run_, choice_called(load_impulses, "clock: impulse", impulse));
    }
    [[nodiscard]] std::atomic_flag& in_use() const { return in_use_; }

private:
    [[nodiscard]] static run::RunOptions checked(const run::Scene<Dim>& scene, const run::RunOptions& given) {
        run::check(given);
        if (given.kinematics == run::BodyKinematics::automatic)
            throw BadInput(
                "kinematics: automatic is for simulate: a pilot run of the same time decides, and memm does not know how "
                "long "
                "you will step. Choose small, floating, finite or rigid.");
        if (scene.contact) mesh::check_apart(scene.mesh, "", given.contact.search.broad_phase);
        return run::with_defaults<Dim>(run::with_restart(given, scene));
    }
    [[nodiscard]] dynamics::RunView<Dim> view() const { return run_->memm(); }

    run::Scene<Dim> scene_;
    run::RunOptions options_;
    double stable_dt_ = 0.0;                     // [s]
    std::unique_ptr<mesh::Mesh<Dim>> mesh_;      // null: that of the scene, as long as it has all its cells
    std::optional<solid::SteppedRun<Dim>> run_;  // always there
    mutable std::atomic_flag in_use_{};
};

/// Times that Python dictates.
template <int Dim>
class Clock {
public:
    using State = typename solid::ClockedRun<Dim>::State;

    Clock(Memm<Dim>& run, const std::string& impulse) : run_(run), clock_(run.clock(impulse)) {}

    void advance(double d) {
        const bindings::Use use(run_.in_use(), run_in_use);
        const py::gil_scoped_release release;
        clock_.advance(d);
    }
    void set_traction(const std::string& group, const py::object& traction) {
        const bindings::Use use(run_.in_use(), run_in_use);
        clock_.set_traction(group, vectors_of<Dim>(traction, "traction"));
    }
    [[nodiscard]] py::array_t<double> motion(const std::string& group, double d) {
        const bindings::Use use(run_.in_use(), run_in_use);
        return copy_of_vectors<Dim>(clock_.motion(group, d));
    }
    [[nodiscard]] py::dict faces(const std::string& group) {
        const bindings::Use use(run_.in_use(), run_in_use);
        return faces_of<Dim>(clock_.faces(group), clock_.motion(group, clock_.time_to_node()));
    }
    [[nodiscard]] py::array_t<double> displacement() {
        const bindings::Use use(run_.in_use(), run_in_use);
        const std::vector<double> q = clock_.q();
        return copy_of_vectors<Dim>(as_vectors<Dim>(std::span<const double>(q)));
    }
    [[nodiscard]] State state() const {
        const bindings::Use use(run_.in_use(), run_in_use);
        return clock_.state();
    }
    void restore(const State& state) {
        const bindings::Use use(run_.in_use(), run_in_use);
        clock_.restore(state);
    }
    [[nodiscard]] double time() const { return clock_.time(); }
    [[nodiscard]] double time_to_node() const { return clock_.time_to_node(); }

private:
    Memm<Dim>& run_;
    solid::ClockedRun<Dim> clock_;
};

/// Whether an option has a meaning for steps that Python asks for one by one.
bool is_of_memm(const OptionFacts& option) {
    const auto is_among = [&](const std::vector<std::string>& words, const std::string& word) {
        return std::ranges::find(words, word) != words.end();
    };
    return option.table != "output" && !is_among({"time", "steps", "threads", "integrator"}, option.name) &&
           (option.schemes.empty() || is_among(option.schemes, "memm"));
}

void require_of_memm(const py::dict& given) {
    for (const auto& option : run::run_options())
        if (given.contains(option.name.c_str()) && !is_of_memm(option))
            throw py::type_error("memm takes no '" + option.name + "', which is for simulate");
}

template <int Dim>
std::unique_ptr<Memm<Dim>> make_memm(const mesh::Mesh<Dim>& mesh, const std::vector<solid::Material>& materials,
                                     const py::object& velocity, const py::object& acceleration,
                                     const std::map<std::string, py::object>& held, const std::vector<std::string>& rollers,
                                     const std::map<std::string, py::object>& traction,
                                     const std::map<std::string, py::object>& temperature_rise,
                                     const py::object& displacement, const py::object& added_velocity, bool contact,
                                     const std::vector<std::string>& outside, const py::kwargs& given) {
    run::Scene<Dim> scene = scene_of<Dim>({mesh,
                                           materials,
                                           velocity,
                                           acceleration,
                                           held,
                                           rollers,
                                           traction,
                                           temperature_rise,
                                           displacement,
                                           added_velocity,
                                           contact,
                                           {}});
    for (const std::string& group : outside) scene.solid.boundary.traction.push_back({.group = group, .from_outside = true});
    require_of_memm(given);
    const run::RunOptions options = options_of(given);
    const py::gil_scoped_release release;
    return std::make_unique<Memm<Dim>>(std::move(scene), options);
}

template <int Dim>
py::object memm_of_file(const input::SceneFile& file, const std::vector<std::string>& outside) {
    const py::gil_scoped_release release;
    run::Scene<Dim> scene = file.scene<Dim>();
    for (const std::string& group : outside) scene.solid.boundary.traction.push_back({.group = group, .from_outside = true});
    auto memm = std::make_unique<Memm<Dim>>(std::move(scene), file.options());
    const py::gil_scoped_acquire lock;
    return py::cast(std::move(memm));
}

py::object memm_of_source(const SceneSource& source, const std::vector<std::string>& outside, const py::dict& given) {
    require_of_memm(given);
    const input::SceneFile file = scene_file(source, given, 1);  // whoever steps it says when it ends
    return file.dimension() == 2 ? memm_of_file<2>(file, outside) : memm_of_file<3>(file, outside);
}

template <int Dim>
void add_memm_of(py::module_& module, const std::string& suffix) {
    auto memm = py::class_<Memm<Dim>>(module, ("Memm" + suffix).c_str(), docs::memm_class);
    add_state(memm, [](Memm<Dim>& self) { return typename Memm<Dim>::Held(self); });
    memm.def("step", &Memm<Dim>::step, "n"_a = 1, docs::memm_step)
        .def("set_step", &Memm<Dim>::set_step, "dt"_a, "change"_a, docs::memm_set_step)
        .def("set_traction", &Memm<Dim>::set_traction, "group"_a, "traction"_a, docs::memm_set_traction)
        .def("faces", &Memm<Dim>::faces, "group"_a, docs::memm_faces)
        .def_property_readonly("outside_work", &Memm<Dim>::outside_work,
                               "Works of tractions from outside so far, a dict [J].\n\n"
                               "steps: sum of area traction . motion; changes: what the bodies take in where tractions "
                               "change; held: what H~ has less for the tractions that act; heat: of temperatures that vary.")
        .def(
            "clock", [](Memm<Dim>& self, const std::string& impulse) { return std::make_unique<Clock<Dim>>(self, impulse); },
            "impulse"_a = "as_given", py::keep_alive<0, 1>(), docs::memm_clock)
        .def("remove_cells", &Memm<Dim>::remove_cells, "cells"_a, docs::memm_remove_cells)
        .def_property_readonly(
            "mesh", [](const Memm<Dim>& self) { return mesh::Mesh<Dim>(self.mesh()); }, "Mesh as it is now, a copy.")
        .def("record", &Memm<Dim>::record, docs::memm_record)
        .def_property_readonly("ledger", &Memm<Dim>::ledger,
                               "Columns of energy.csv, a structured array; its first row is the start.")
        .def_property_readonly("dt", &Memm<Dim>::dt, "Length of the steps [s].")
        .def_property_readonly("stable_dt", &Memm<Dim>::stable_dt, "Longest stable step [s].")
        .def_property_readonly("masses", &Memm<Dim>::masses, "Masses of the cells (n_cells,) [kg].")
        .def_property_readonly("bodies", &Memm<Dim>::bodies,
                               "Mass [kg], velocity [m/s] and rotation [rad] of each body, a list of dicts.")
        .def_property_readonly("contact", &Memm<Dim>::contact, "Counters since the start; missed_contacts must stay 0.");

    py::class_<typename Clock<Dim>::State>(module, ("ClockState" + suffix).c_str(), docs::clock_state_class);
    py::class_<Clock<Dim>>(module, ("Clock" + suffix).c_str(), docs::clock_class)
        .def("advance", &Clock<Dim>::advance, "d"_a, docs::clock_advance)
        .def("set_traction", &Clock<Dim>::set_traction, "group"_a, "traction"_a, docs::memm_set_traction)
        .def("motion", &Clock<Dim>::motion, "group"_a, "d"_a, docs::clock_motion)
        .def("faces", &Clock<Dim>::faces, "group"_a, docs::clock_faces)
        .def("state", &Clock<Dim>::state, docs::clock_state)
        .def("restore", &Clock<Dim>::restore, "state"_a, docs::clock_restore)
        .def_property_readonly("displacement", &Clock<Dim>::displacement,
                               "Displacement of the points that carry mass, now (n, dim) [m].")
        .def_property_readonly("time", &Clock<Dim>::time, "Time now [s].")
        .def_property_readonly("time_to_node", &Clock<Dim>::time_to_node, "Time to the next node of the run [s], > 0.");

    const std::map<std::string, py::object> none;
    module.def("memm", &make_memm<Dim>, "mesh"_a, "materials"_a, "velocity"_a, py::kw_only(), "acceleration"_a = py::none(),
               "held"_a = none, "rollers"_a = std::vector<std::string>(), "traction"_a = none, "temperature_rise"_a = none,
               "displacement"_a = py::none(), "added_velocity"_a = py::none(), "contact"_a = true,
               "outside"_a = std::vector<std::string>(),
               (std::string(docs::memm) + docs::scene_parameters + docs::memm_parameters + docs::memm_returns +
                option_text() + docs::memm_end)
                   .c_str());
}

}  // namespace

void add_memm(py::module_& module) {
    add_memm_of<2>(module, "2D");
    add_memm_of<3>(module, "3D");
    module.def(
        "memm_toml",
        [](const std::filesystem::path& file, const std::optional<std::string>& toml, const py::dict& meshes,
           const std::vector<std::string>& set, const std::vector<std::string>& outside, const py::dict& options) {
            return memm_of_source({file, toml, meshes, set}, outside, options);
        },
        "file"_a, "toml"_a, "meshes"_a, "set"_a, "outside"_a, "options"_a, "For abut.memm.");
}

}  // namespace abut::python
