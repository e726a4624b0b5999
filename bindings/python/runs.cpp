#include "runs.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>

#include "abut/base/error.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/run/frames.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/result_files.hpp"
#include "abut/run/simulation.hpp"
#include "abut/run/verdict.hpp"
#include "abut/run/warnings.hpp"
#include "in_use.hpp"
#include "scenes.hpp"
#include "tables.hpp"

namespace abut::python {
namespace {

using namespace py::literals;

/// A run at one moment.
template <int Dim>
class State {
public:
    State(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) : view_(view), solid_(solid) {}

    [[nodiscard]] std::int64_t steps() const { return view_.steps; }
    [[nodiscard]] double time() const { return view_.time; }
    [[nodiscard]] py::array_t<double> displacement() const {
        return copy_of_vectors<Dim>(solid_.cell_displacement(view_.q));
    }
    [[nodiscard]] py::array_t<double> velocity() const {
        std::vector<double> momentum(view_.p_before.begin(), view_.p_before.end());
        for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = 0.5 * (momentum[i] + view_.p_after[i]);
        return copy_of_vectors<Dim>(solid_.cell_velocity(momentum));
    }
    [[nodiscard]] py::array_t<double> stress() const {
        static_cast<void>(solid_.potential(view_.q));  // leaves the stresses of this state behind
        const py::ssize_t n = solid_.mesh().n_cells();
        py::array_t<double> stress({n, py::ssize_t{Dim}, py::ssize_t{Dim}});
        for (py::ssize_t c = 0; c < n; ++c)  // symmetric: the order of rows and columns is free
            Eigen::Map<Matrix<Dim>>(stress.mutable_data(c)) = solid_.stress(static_cast<std::int32_t>(c));
        return stress;
    }
    [[nodiscard]] py::array_t<double> von_mises() const {
        static_cast<void>(solid_.potential(view_.q));
        std::vector<double> equivalent;
        for (std::int32_t c = 0; c < solid_.mesh().n_cells(); ++c) {
            const auto body = static_cast<std::size_t>(solid_.mesh().cell_body[static_cast<std::size_t>(c)]);
            equivalent.push_back(run::von_mises<Dim>(solid_.stress(c), solid_.options().materials[body].poisson));
        }
        return copy_of(equivalent);
    }
    [[nodiscard]] py::array_t<double> contact_pressure() const { return copy_of(solid_.contact_field(view_.q).pressure); }

private:
    const dynamics::RunView<Dim>& view_;
    solid::Solid<Dim>& solid_;
};

/// The same properties for whatever has a state.
template <class Class, class StateOf>
void add_state(Class& made, StateOf state_of) {
    using Self = typename Class::type;
    made.def_property_readonly("steps", [=](Self& self) { return state_of(self)->steps(); })
        .def_property_readonly(
            "time", [=](Self& self) { return state_of(self)->time(); }, "[s]")
        .def_property_readonly(
            "displacement", [=](Self& self) { return state_of(self)->displacement(); }, "of the cells, (n_cells, dim) [m]")
        .def_property_readonly(
            "velocity", [=](Self& self) { return state_of(self)->velocity(); }, "of the cells, (n_cells, dim) [m/s]")
        .def_property_readonly(
            "stress", [=](Self& self) { return state_of(self)->stress(); }, "(n_cells, dim, dim) [Pa]")
        .def_property_readonly(
            "von_mises", [=](Self& self) { return state_of(self)->von_mises(); }, "(n_cells) [Pa]")
        .def_property_readonly(
            "contact_pressure", [=](Self& self) { return state_of(self)->contact_pressure(); },
            "of the boundary faces, in the order of surface [Pa]");
}

/// What `look` is called with; good for that call alone.
template <int Dim>
struct Glance {
    std::optional<State<Dim>> state;
    [[nodiscard]] const State<Dim>* now() const {
        if (!state)
            throw Misuse("the state of a run is there while look is called, and not after. Copy what you need of it.");
        return &*state;
    }
};

/// Hands each state to Python, and ends a run that Python or Ctrl-C wants ended.
template <int Dim>
class Look : public run::Observer<Dim> {
public:
    explicit Look(py::object look) : look_(std::move(look)) {}

    void begin(const run::Scene<Dim>&, const run::RunResult<Dim>& result) override { result_ = &result; }
    void look(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) override {
        if (view.steps == result_->steps) final_displacement = solid.cell_displacement(view.q);
        if (!has_look_) return;
        const py::gil_scoped_acquire lock;
        auto glance = std::make_shared<Glance<Dim>>();
        glance->state.emplace(view, solid);
        struct Close {
            Glance<Dim>& glance;
            ~Close() { glance.state.reset(); }
        } close{*glance};
        const py::object answer = look_(glance);
        const int stops = PyObject_IsTrue(answer.ptr());
        if (stops < 0) throw py::error_already_set();
        stops_ = stops != 0;
    }
    [[nodiscard]] bool asks_to_stop() const override {
        const py::gil_scoped_acquire lock;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        return stops_;
    }

    std::vector<Vector<Dim>> final_displacement;  // of the cells

private:
    py::object look_;
    bool has_look_ = !look_.is_none();
    const run::RunResult<Dim>* result_ = nullptr;
    bool stops_ = false;
};

template <int Dim>
py::dict simulate(const mesh::Mesh<Dim>& mesh, const std::vector<solid::Material>& materials, const py::object& velocity,
                  const py::object& acceleration, const std::map<std::string, py::object>& held,
                  const std::vector<std::string>& rollers, const std::map<std::string, py::object>& traction,
                  const py::object& displacement, const py::object& added_velocity, bool contact,
                  std::optional<double> energy_scale, const py::object& look, const py::kwargs& given) {
    const run::Scene<Dim> scene = scene_of<Dim>({mesh, materials, velocity, acceleration, held, rollers, traction,
                                                 displacement, added_velocity, contact, energy_scale});
    const run::RunOptions options = options_of(given);
    Look<Dim> python(look);
    std::optional<run::RunResult<Dim>> result;
    {
        const py::gil_scoped_release release;
        if (options.out.empty()) {
            result.emplace(run::simulate<Dim>(scene, options, python));
        } else {
            run::ResultFiles<Dim> files(options, "python", "bodies");
            run::Observers<Dim> both{files, python};
            std::optional<run::Checkpoint> from;
            if (options.resume) from = std::move(files.last_checkpoint().checkpoint);
            result.emplace(run::simulate<Dim>(scene, options, both, from ? &*from : nullptr));
            files.finish(scene, *result);
        }
    }
    py::list warnings;
    for (const run::Warning& warning : run::without_notes(run::all_warnings(scene, *result)))
        warnings.append(text_of(warning.text));
    const run::Verdict said = run::verdict(scene, *result);
    return py::dict(
        "ledger"_a = table_of(result->ledger), "displacement"_a = copy_of_vectors<Dim>(python.final_displacement),
        "start"_a = motions_of(result->start), "end"_a = motions_of(result->end), "steps"_a = result->steps,
        "dt"_a = result->dt, "stable_dt"_a = result->stable.dt, "complete"_a = result->complete,
        "energy_scale"_a = result->scale.value, "contact"_a = report_of(result->contact), "warnings"_a = warnings,
        "verdict"_a = text_of(said.text), "good"_a = said.good, "seconds"_a = result->seconds.total);
}

constexpr const char* run_in_use = "this run takes steps in another thread. Use one thread at a time.";

/// A solid under MEMM, taken step by step.
template <int Dim>
class Memm {
public:
    Memm(run::Scene<Dim> scene, const run::RunOptions& given)
        : scene_(std::move(scene)),
          options_(checked(scene_, given)),
          solid_(scene_.mesh, run::solid_options(scene_, options_)),
          stable_dt_(dynamics::stable_step(solid_).dt),
          memm_(solid_, run::displacement_at_start(scene_, solid_), run::momentum_at_start(scene_, solid_),
                run::choose_step(options_, stable_dt_)),
          filter_(solid_) {
        if (options_.filter)
            memm_.set_after_step([this](auto q, double dt, auto before, auto after) { filter_(q, dt, before, after); });
        if (options_.restart > 0) {
            restart_.emplace(solid_, dynamics::RestartOptions{.period = options_.restart});
            memm_.set_node_restart(
                [this](auto q, double dt, auto before, auto after) { (*restart_)(q, dt, before, after); });
        }
        record();
    }

    /// Ctrl-C ends it between two steps.
    void step(std::int64_t n) {
        if (n < 0) throw py::value_error("step: n is " + std::to_string(n) + "; 0 and more are allowed");
        const bindings::Use use(in_use_, run_in_use);
        const py::gil_scoped_release release;
        auto asked = std::chrono::steady_clock::now();
        for (std::int64_t i = 0; i < n; ++i) {
            take_step();
            if (const auto now = std::chrono::steady_clock::now(); now - asked > std::chrono::milliseconds(50)) {
                const py::gil_scoped_acquire lock;
                if (PyErr_CheckSignals() != 0) throw py::error_already_set();
                asked = now;
            }
        }
    }
    void set_step(double dt, const std::string& change) {
        const bindings::Use use(in_use_, run_in_use);
        if (change != "keep" && change != "restart")
            throw py::value_error("set_step: change is '" + change + "'; there are 'keep', 'restart'");
        const py::gil_scoped_release release;
        memm_.set_step(dt, change == "keep" ? dynamics::StepChange::keep : dynamics::StepChange::restart);
    }
    void set_traction(const std::string& group, const py::object& traction) {
        const bindings::Use use(in_use_, run_in_use);
        solid_.set_traction(group, vectors_of<Dim>(traction, "traction"));
    }
    [[nodiscard]] py::dict faces(const std::string& group) {
        const bindings::Use use(in_use_, run_in_use);
        return faces_of<Dim>(solid::outside_faces<Dim>(memm_, solid_, group),
                             solid_.face_motion(group, memm_.q(), memm_.next_q(), memm_.time(), memm_.dt()));
    }
    [[nodiscard]] py::dict outside_work() const {
        const bindings::Use use(in_use_, run_in_use);
        const solid::OutsideWork work = solid_.outside_work(memm_.q());
        return py::dict("steps"_a = work.steps, "changes"_a = work.changes, "held"_a = work.held);
    }
    void record() {
        const bindings::Use use(in_use_, run_in_use);
        ledger_.record(dynamics::measure(memm_, solid_, restart_ ? restart_->report() : dynamics::RestartReport{}));
        const auto& entry = ledger_.entries().back();
        if (!std::isfinite(entry.energy) || !std::isfinite(entry.pseudo_energy))
            throw Diverged(at_step(memm_.steps(), "the run has diverged: its energy is not finite. Take a shorter step."));
    }
    [[nodiscard]] py::object ledger() const {
        const bindings::Use use(in_use_, run_in_use);
        return table_of(ledger_);
    }
    [[nodiscard]] double dt() const { return memm_.dt(); }
    [[nodiscard]] double stable_dt() const { return stable_dt_; }
    [[nodiscard]] py::array_t<double> masses() const { return copy_of(solid_.masses()); }
    [[nodiscard]] py::list bodies() const {
        const bindings::Use use(in_use_, run_in_use);
        return motions_of(solid::body_motions<Dim>(view(), solid_));
    }
    [[nodiscard]] py::dict contact() const {
        const bindings::Use use(in_use_, run_in_use);
        return report_of(solid_.contact_report());
    }

    /// The present state, while somebody looks at it.
    struct Held {
        bindings::Use use;
        dynamics::RunView<Dim> view;
        State<Dim> state;
        explicit Held(Memm& run) : use(run.in_use_, run_in_use), view(run.memm_), state(view, run.solid_) {}
        const State<Dim>* operator->() const { return &state; }
    };

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
    void take_step() {
        try {
            memm_.step();
        } catch (const Error& error) {
            throw_again(error, at_step(memm_.steps() + 1, error.what()));
        }
    }
    [[nodiscard]] std::string at_step(std::int64_t step, const char* what) const {
        return "step " + std::to_string(step) + ", t = " + std::to_string(memm_.time()) + " s: " + what;
    }
    [[nodiscard]] dynamics::RunView<Dim> view() const { return memm_; }

    run::Scene<Dim> scene_;
    run::RunOptions options_;
    solid::Solid<Dim> solid_;
    double stable_dt_;  // [s]
    dynamics::Memm<solid::Solid<Dim>> memm_;
    dynamics::NeutralFilter<solid::Solid<Dim>> filter_;
    std::optional<dynamics::NeutralRestart<solid::Solid<Dim>>> restart_;
    dynamics::Ledger<Dim> ledger_;
    mutable std::atomic_flag in_use_{};
};

/// Whether an option has a meaning for steps that Python asks for one by one.
bool is_of_memm(const OptionFacts& option) {
    const auto is_among = [&](const std::vector<std::string>& words, const std::string& word) {
        return std::ranges::find(words, word) != words.end();
    };
    return option.table != "output" && !is_among({"time", "steps", "threads", "integrator"}, option.name) &&
           (option.schemes.empty() || is_among(option.schemes, "memm"));
}

template <int Dim>
std::unique_ptr<Memm<Dim>> make_memm(const mesh::Mesh<Dim>& mesh, const std::vector<solid::Material>& materials,
                                     const py::object& velocity, const py::object& acceleration,
                                     const std::map<std::string, py::object>& held, const std::vector<std::string>& rollers,
                                     const std::map<std::string, py::object>& traction, const py::object& displacement,
                                     const py::object& added_velocity, bool contact, const std::vector<std::string>& outside,
                                     const py::kwargs& given) {
    run::Scene<Dim> scene = scene_of<Dim>(
        {mesh, materials, velocity, acceleration, held, rollers, traction, displacement, added_velocity, contact, {}});
    for (const std::string& group : outside) scene.solid.boundary.traction.push_back({.group = group, .from_outside = true});
    for (const auto& option : run::run_options())
        if (given.contains(option.name.c_str()) && !is_of_memm(option))
            throw py::type_error("memm takes no '" + option.name + "', which is for simulate");
    const run::RunOptions options = options_of(given);
    const py::gil_scoped_release release;
    return std::make_unique<Memm<Dim>>(std::move(scene), options);
}

constexpr const char* scene_text =
    "mesh; materials: one per body; velocity: of each body at the start (n_bodies, dim) [m/s]; acceleration: of gravity, "
    "the "
    "same shape; held: {group: displacement [m]}; rollers: groups held along their normals; traction: {group: traction "
    "[Pa]}; "
    "displacement(x), added_velocity(x): at the start, by position; contact: False lets bodies pass through each other. "
    "Options, those of the command line of abut run with _ for -:\n";

template <int Dim>
void add_dimension(py::module_& module, const std::string& suffix) {
    auto glance = py::class_<Glance<Dim>, std::shared_ptr<Glance<Dim>>>(module, ("State" + suffix).c_str(),
                                                                        "A run at one moment; good while look is called.");
    add_state(glance, [](const Glance<Dim>& self) { return self.now(); });

    auto memm = py::class_<Memm<Dim>>(module, ("Memm" + suffix).c_str(), "A solid under MEMM, step by step; made by memm.");
    add_state(memm, [](Memm<Dim>& self) { return typename Memm<Dim>::Held(self); });
    memm.def("step", &Memm<Dim>::step, "n"_a = 1, "Takes n steps; Ctrl-C ends them.")
        .def("set_step", &Memm<Dim>::set_step, "dt"_a, "change"_a,
             "Another dt [s] from the next step on. change: 'keep', for slow and smooth changes, or 'restart', for abrupt "
             "ones.")
        .def("set_traction", &Memm<Dim>::set_traction, "group"_a, "traction"_a,
             "Tractions (n_faces, dim) [Pa] on a group of `outside`, from the next step on until they are set again.")
        .def("faces", &Memm<Dim>::faces, "group"_a,
             "Of a group of `outside`, a dict: position [m] and velocity [m/s] of the centroids, normal, area at rest, "
             "traction [Pa] as set last, motion [m]: how far the centroids go in the next step, whatever the traction.")
        .def_property_readonly("outside_work", &Memm<Dim>::outside_work,
                               "[J]: steps, sum of area traction . motion; changes, what the bodies take in where tractions "
                               "change; held, what H~ has less for the tractions that act.")
        .def("record", &Memm<Dim>::record,
             "Adds a row to the ledger; costs about two forces. Raises Diverged where the energy is not finite.")
        .def_property_readonly("ledger", &Memm<Dim>::ledger,
                               "The columns of energy.csv, a structured array; its first row is the start.")
        .def_property_readonly("dt", &Memm<Dim>::dt, "[s]")
        .def_property_readonly("stable_dt", &Memm<Dim>::stable_dt, "[s]")
        .def_property_readonly("masses", &Memm<Dim>::masses, "of the cells [kg]")
        .def_property_readonly("bodies", &Memm<Dim>::bodies, "mass [kg], velocity [m/s] and rotation [rad] of each")
        .def_property_readonly("contact", &Memm<Dim>::contact, "Counters since the start; missed_contacts must stay 0.");

    const std::map<std::string, py::object> none;
    module.def(
        "simulate", &simulate<Dim>, "mesh"_a, "materials"_a, "velocity"_a, py::kw_only(), "acceleration"_a = py::none(),
        "held"_a = none, "rollers"_a = std::vector<std::string>(), "traction"_a = none, "displacement"_a = py::none(),
        "added_velocity"_a = py::none(), "contact"_a = true, "energy_scale"_a = py::none(), "look"_a = py::none(),
        (std::string(
             "Runs a scene and returns a dict: ledger (structured array), displacement at the end [m], start and end (mass "
             "[kg], "
             "velocity [m/s], rotation [rad] of each body), steps, dt and stable_dt [s], complete, energy_scale [J], "
             "contact "
             "(counters), verdict (a text), good (whether it is), warnings (texts), seconds. "
             "look(state): called at the start and after each step; True makes the next one the last. energy_scale: [J], "
             "by default the largest energy in play so far. out: a folder for energy.csv, pictures and the VTU series. ") +
         scene_text + option_text())
            .c_str());
    module.def("memm", &make_memm<Dim>, "mesh"_a, "materials"_a, "velocity"_a, py::kw_only(), "acceleration"_a = py::none(),
               "held"_a = none, "rollers"_a = std::vector<std::string>(), "traction"_a = none, "displacement"_a = py::none(),
               "added_velocity"_a = py::none(), "contact"_a = true, "outside"_a = std::vector<std::string>(),
               (std::string("The same under MEMM, to be taken step by step; options of steps and files are for simulate. "
                            "outside: groups that set_traction loads. ") +
                scene_text + option_text())
                   .c_str());
}

}  // namespace

void add_runs(py::module_& module) {
    py::class_<solid::Material>(module, "Material", "Isotropic linear elasticity; plane strain in 2D.")
        .def(py::init([](double young, double poisson, double density, double eta) {
                 return solid::Material{young, poisson, density, eta};
             }),
             "young"_a = 1.0, "poisson"_a = 0.3, "density"_a = 1.0, "eta"_a = 0.0)
        .def_readwrite("young", &solid::Material::young, "E [Pa]")
        .def_readwrite("poisson", &solid::Material::poisson, "nu")
        .def_readwrite("density", &solid::Material::density, "rho [kg/m^3]")
        .def_readwrite("eta", &solid::Material::eta, "stabilisation of the jumps between cells [Pa]; 0 means E");
    add_dimension<2>(module, "2D");
    add_dimension<3>(module, "3D");
}

}  // namespace abut::python
