#pragma once
// A run at one moment, as Python sees it.
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/run/files/frames.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "meshes.hpp"
#include "vectors.hpp"

namespace abut::python {

/// A run at one moment.
template <int Dim>
class State {
public:
    State(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) : view_(view), solid_(solid) {}

    [[nodiscard]] std::int64_t steps() const { return view_.steps; }
    [[nodiscard]] double time() const { return view_.time; }
    [[nodiscard]] py::array_t<double> displacement() const {
        return copy_of_vectors<Dim>(solid_.cells().displacement(view_.q));
    }
    [[nodiscard]] py::array_t<double> velocity() const {
        std::vector<double> momentum(view_.p_before.begin(), view_.p_before.end());
        for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = 0.5 * (momentum[i] + view_.p_after[i]);
        return copy_of_vectors<Dim>(solid_.cells().velocity(momentum));
    }
    [[nodiscard]] py::array_t<double> stress() const {
        static_cast<void>(solid_.potential(view_.q));  // leaves the stresses of this state behind
        const py::ssize_t n = solid_.mesh().n_cells();
        py::array_t<double> stress({n, py::ssize_t{Dim}, py::ssize_t{Dim}});
        for (py::ssize_t c = 0; c < n; ++c)  // symmetric: the order of rows and columns is free
            std::ranges::copy(solid_.cells().stress(static_cast<std::int32_t>(c)), stress.mutable_data(c));
        return stress;
    }
    [[nodiscard]] py::array_t<double> von_mises() const {
        static_cast<void>(solid_.potential(view_.q));
        std::vector<double> equivalent;
        for (std::int32_t c = 0; c < solid_.mesh().n_cells(); ++c)
            equivalent.push_back(run::von_mises<Dim>(solid_.cells().stress(c), solid_.cells().out_of_plane_stress(c)));
        return copy_of(equivalent);
    }
    [[nodiscard]] py::array_t<double> plastic_strain() const {
        std::vector<double> of_cells;
        for (std::int32_t c = 0; c < solid_.mesh().n_cells(); ++c) of_cells.push_back(solid_.cells().plastic_strain(c));
        return copy_of(of_cells);
    }
    [[nodiscard]] py::array_t<double> contact_pressure() const {
        return copy_of(solid_.contact_at(view_.q).field().pressure);
    }
    /// As files show it: a body that turns is not where the mean displacement of its cells takes it.
    [[nodiscard]] py::array_t<double> point_displacement() const {
        if (solid_.moment_arms() == dynamics::MomentArms::mid_step)
            return copy_of_vectors<Dim>(solid_.cells().vertex_displacement(view_.q));
        return at_points(solid_.mesh(), Packed<double>(displacement()));
    }

private:
    const dynamics::RunView<Dim>& view_;
    solid::Solid<Dim>& solid_;
};

/// Adds the properties of a state to whatever has one.
template <class Class, class StateOf>
void add_state(Class& made, StateOf state_of) {
    using Self = typename Class::type;
    made.def_property_readonly(
            "steps", [=](Self& self) { return state_of(self)->steps(); }, "Steps taken so far.")
        .def_property_readonly(
            "time", [=](Self& self) { return state_of(self)->time(); }, "Time [s].")
        .def_property_readonly(
            "displacement", [=](Self& self) { return state_of(self)->displacement(); },
            "Displacement of the cells (n_cells, dim) [m].")
        .def_property_readonly(
            "point_displacement", [=](Self& self) { return state_of(self)->point_displacement(); },
            "Displacement of the points (n_points, dim) [m].")
        .def_property_readonly(
            "velocity", [=](Self& self) { return state_of(self)->velocity(); },
            "Velocity of the cells (n_cells, dim) [m/s].")
        .def_property_readonly(
            "stress", [=](Self& self) { return state_of(self)->stress(); }, "Stress of the cells (n_cells, dim, dim) [Pa].")
        .def_property_readonly(
            "von_mises", [=](Self& self) { return state_of(self)->von_mises(); },
            "Von Mises stress of the cells (n_cells,) [Pa].")
        .def_property_readonly(
            "plastic_strain", [=](Self& self) { return state_of(self)->plastic_strain(); },
            "Plastic strain of the cells (n_cells,) [-].")
        .def_property_readonly(
            "contact_pressure", [=](Self& self) { return state_of(self)->contact_pressure(); },
            "Contact pressure of the boundary faces (n_faces,) [Pa], in the order of `surface`.");
}

/// Argument with which `look` is called; good for that call alone.
template <int Dim>
struct Glance {
    std::optional<State<Dim>> state;
    [[nodiscard]] const State<Dim>* now() const {
        if (!state)
            throw Misuse("the state of a run is there while look is called, and not after. Copy what you need of it.");
        return &*state;
    }
};

/// Shows a state to a function of Python while it is called, and returns its answer. Needs the interpreter's lock.
template <int Dim>
py::object shown_to(const py::object& function, const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) {
    auto glance = std::make_shared<Glance<Dim>>();
    glance->state.emplace(view, solid);
    struct Close {
        Glance<Dim>& glance;
        ~Close() { glance.state.reset(); }
    } close{*glance};
    return function(glance);
}

/// Hands each state to Python, and ends a run that Python or Ctrl-C wants ended.
template <int Dim>
class Look : public run::Observer<Dim> {
public:
    explicit Look(py::object look) : look_(std::move(look)) {}

    void begin(const run::Scene<Dim>&, const run::RunResult<Dim>& result) override { result_ = &result; }
    void look(const dynamics::RunView<Dim>& view, solid::Solid<Dim>& solid) override {
        if (view.steps == result_->run.steps) final_displacement = solid.cells().displacement(view.q);
        if (!has_look_) return;
        const py::gil_scoped_acquire lock;
        const py::object answer = shown_to<Dim>(look_, view, solid);
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

}  // namespace abut::python
