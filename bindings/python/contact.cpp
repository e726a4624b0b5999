// The Python package `abut`: contact on nodes for numpy, over the C layer. Arrays of float64 are read and written where they
// lie, whatever their strides; the interpreter's lock is released while contact computes.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "abut.h"
#include "contact_arguments.hpp"
#include "docstrings.hpp"
#include "option_fields.hpp"

using namespace abut::python;

namespace {

/// The entries that `ask` writes, in as many calls as it takes to find room for them.
template <class Entry, class Ask>
py::array_t<Entry> entries_of(const Ask& ask, std::int64_t expected = 0) {
    for (std::int64_t capacity = expected;;) {
        py::array_t<Entry> entries(static_cast<py::ssize_t>(capacity));
        Entry* const first = capacity > 0 ? entries.mutable_data() : nullptr;
        std::int64_t n = 0;
        call_unlocked([&](abut_error* error) { return ask(first, capacity, &n, error); });
        if (n <= capacity) {
            entries.resize({static_cast<py::ssize_t>(n)});
            return entries;
        }
        capacity = n;
    }
}

using abut::c_layer::option_fields;
using abut::c_layer::OptionField;

bool is_of_friction(const std::string& name) {
    static constexpr const char* names[] = {"friction",   "sliding_friction", "decay_speed",
                                            "decay_slip", "shear_strength",   "relaxation_time"};
    return std::ranges::find(names, name) != std::end(names);
}

void take_option(abut_options& options, const std::string& name, const py::handle& value) {
    std::string names;
    for (const OptionField& field : option_fields) {
        names += (names.empty() ? "" : ", ") + std::string(field.name);
        if (name != field.name) continue;
        try {
            std::visit(
                [&](auto member) {
                    using Field = std::remove_reference_t<decltype(options.*member)>;
                    if constexpr (std::is_same_v<Field, std::int32_t>)
                        options.*member = py::cast<bool>(value) ? 1 : 0;
                    else
                        options.*member = py::cast<Field>(value);
                },
                field.field);
        } catch (const py::cast_error&) {
            throw py::type_error(name + " cannot be " + std::string(py::str(py::repr(value))));
        }
        return;
    }
    throw py::type_error("there is no option '" + name + "'; there are " + names +
                         ", wanted, law_of, laws, own_coefficient, interference_time, interferes, cancel, log");
}

/// A law of friction from a dict with the names of the options; what is not there is as the defaults have it.
abut_friction_law law_from(const py::dict& given) {
    abut_options options;
    abut_options_init(&options);
    for (const auto& [key, value] : given) {
        const auto name = py::cast<std::string>(key);
        if (!is_of_friction(name)) throw py::type_error("laws: there is no '" + name + "' in a law of friction");
        take_option(options, name, value);
    }
    return {options.friction,   options.sliding_friction, options.decay_speed,
            options.decay_slip, options.shear_strength,   options.relaxation_time};
}

/// "skin=0.0, largest_motion=1.0, ..."
std::string defaults_of_options() {
    abut_options defaults;
    abut_options_init(&defaults);
    std::string text;
    for (const OptionField& field : option_fields) {
        const py::object value = std::visit(
            [&](auto member) {
                using Field = std::remove_reference_t<decltype(defaults.*member)>;
                if constexpr (std::is_same_v<Field, std::int32_t>)
                    return py::object(py::bool_(defaults.*member != 0));
                else
                    return py::object(py::cast(defaults.*member));
            },
            field.field);
        if (!text.empty()) text += ", ";
        text.append(field.name).append("=").append(std::string(py::str(py::repr(value))));
    }
    return text;
}

class NodalContact {
public:
    NodalContact(const py::array& nodes, const py::object& faces, const py::object& body, const Packed<double>& depth,
                 const Packed<double>& stiffness, const py::object& offsets, const py::object& shear_stiffness,
                 py::object wanted, py::object cancel, py::object log, py::object law_of, const std::vector<py::dict>& laws,
                 py::object own_coefficient, double interference_time, py::object interferes, const py::kwargs& given)
        : dim_(dimension_of(nodes)),
          callbacks_(new Callbacks{std::move(wanted),
                                   std::move(cancel),
                                   std::move(log),
                                   std::move(law_of),
                                   std::move(own_coefficient),
                                   std::move(interferes),
                                   std::nullopt,
                                   {}}) {
        const Faces of_host(faces, body, depth, stiffness, offsets, shear_stiffness, dim_);
        abut_options options;
        abut_options_init(&options);
        for (const auto& [name, value] : given) take_option(options, py::cast<std::string>(name), value);
        std::vector<abut_friction_law> more_laws;
        for (const py::dict& law : laws) more_laws.push_back(law_from(law));
        options.laws = more_laws.data();
        options.n_laws = std::ssize(more_laws);
        options.interference_time = interference_time;
        callbacks_->put_into(options);
        const abut_array rest = view_of(nodes, dim_, "nodes");
        abut_contact* handle = nullptr;
        call_unlocked([&](abut_error* error) { return abut_create(dim_, rest, &of_host.view, &options, &handle, error); });
        handle_.reset(handle);
        callbacks_->after_call();
    }

    py::dict step(double dt, const py::array& x_0, const py::array& x_1, const py::object& out, const std::string& mode) {
        if (mode != "mean" && mode != "end") throw py::value_error("mode is '" + mode + "'; 'mean' and 'end' are allowed");
        const abut_array from = view_of(x_0, dim_, "x_0"), to = view_of(x_1, dim_, "x_1");
        const abut_array force = writable_view_of(out, dim_, "out");
        abut_step_result result = ABUT_STEP_RESULT_INIT;
        call_unlocked([&](abut_error* error) {
            return abut_step(handle_.get(), dt, from, to, mode == "mean" ? ABUT_MEAN : ABUT_END, force, &result, error);
        });
        callbacks_->after_call();
        using namespace py::literals;
        return py::dict("energy_0"_a = result.energy_0, "energy"_a = result.energy, "work"_a = result.work,
                        "active_pairs"_a = result.active_pairs, "events"_a = result.events,
                        "compression"_a = result.compression, "correction"_a = result.correction,
                        "friction_energy"_a = result.friction_energy, "dissipated"_a = result.dissipated,
                        "sticking_faces"_a = result.sticking_faces, "sliding_faces"_a = result.sliding_faces,
                        "interference_work"_a = result.interference_work);
    }

    double evaluate(const py::array& x, const py::object& out) {
        const abut_array at = view_of(x, dim_, "x"), force = writable_view_of(out, dim_, "out");
        double energy = 0.0;
        call_unlocked([&](abut_error* error) { return abut_evaluate(handle_.get(), at, force, &energy, error); });
        return energy;
    }

    [[nodiscard]] py::array_t<abut_pair> pairs() const {
        return entries_of<abut_pair>([&](abut_pair* entries, std::int64_t capacity, std::int64_t* n, abut_error* error) {
            return abut_pairs(handle_.get(), entries, sizeof(abut_pair), capacity, n, error);
        });
    }
    [[nodiscard]] py::array_t<abut_body> bodies() const {
        return entries_of<abut_body>([&](abut_body* entries, std::int64_t capacity, std::int64_t* n, abut_error* error) {
            return abut_bodies(handle_.get(), entries, sizeof(abut_body), capacity, n, error);
        });
    }
    [[nodiscard]] py::array_t<abut_body_pair> body_pairs() const {
        return entries_of<abut_body_pair>(
            [&](abut_body_pair* entries, std::int64_t capacity, std::int64_t* n, abut_error* error) {
                return abut_body_pairs(handle_.get(), entries, sizeof(abut_body_pair), capacity, n, error);
            });
    }

    [[nodiscard]] py::array_t<abut_face_friction> friction() const {
        return entries_of<abut_face_friction>(
            [&](abut_face_friction* entries, std::int64_t capacity, std::int64_t* n, abut_error* error) {
                return abut_friction(handle_.get(), entries, sizeof(abut_face_friction), capacity, n, error);
            });
    }

    [[nodiscard]] py::dict report() const {
        abut_report report = ABUT_REPORT_INIT;
        abut_error error = ABUT_ERROR_INIT;
        require_ok(abut_get_report(handle_.get(), &report, &error), error);
        using namespace py::literals;
        return py::dict(
            "candidates"_a = report.candidates, "candidates_max"_a = report.candidates_max,
            "active_pairs"_a = report.active_pairs, "active_pairs_max"_a = report.active_pairs_max,
            "events"_a = report.events, "rebuilds"_a = report.rebuilds, "missed_contacts"_a = report.missed_contacts,
            "inadmissible_overlaps"_a = report.inadmissible_overlaps, "compressed_steps"_a = report.compressed_steps,
            "tilted_pairs_max"_a = report.tilted_pairs_max, "compression_max"_a = report.compression_max,
            "correction_max"_a = report.correction_max, "friction_dissipated"_a = report.friction_dissipated,
            "least_dissipated"_a = report.least_dissipated, "friction_ratio_max"_a = report.friction_ratio_max,
            "sliding_force"_a = report.sliding_force, "sliding_limit"_a = report.sliding_limit,
            "sticking_faces"_a = report.sticking_faces, "sliding_faces"_a = report.sliding_faces,
            "sticking_faces_max"_a = report.sticking_faces_max, "sliding_faces_max"_a = report.sliding_faces_max);
    }

    [[nodiscard]] py::dict stable_step(const Packed<double>& mass, double omega_free) const {
        abut_stable stable = ABUT_STABLE_INIT;
        abut_error error = ABUT_ERROR_INIT;
        require_ok(abut_stable_step(handle_.get(), mass.data(), mass.size(), omega_free, &stable, &error), error);
        using namespace py::literals;
        return py::dict("dt"_a = stable.dt, "omega"_a = stable.omega, "omega_free"_a = stable.omega_free,
                        "node"_a = stable.node, "reason"_a = text_of(stable.reason));
    }

    [[nodiscard]] py::bytes state() const {
        std::int64_t n = 0;
        abut_error error = ABUT_ERROR_INIT;
        require_ok(abut_save(handle_.get(), nullptr, 0, &n, &error), error);
        std::string bytes(static_cast<std::size_t>(n), '\0');
        require_ok(abut_save(handle_.get(), bytes.data(), n, &n, &error), error);
        return py::bytes(bytes);
    }
    void restore(const py::bytes& state) {
        const std::string bytes = state;
        abut_error error = ABUT_ERROR_INIT;
        require_ok(abut_restore(handle_.get(), bytes.data(), static_cast<std::int64_t>(bytes.size()), &error), error);
    }

    void surface_replaced(const py::array& nodes, const py::object& faces, const py::object& body,
                          const Packed<double>& depth, const Packed<double>& stiffness, const py::object& old_face_of,
                          const py::object& offsets, const py::object& shear_stiffness) {
        const Faces of_host(faces, body, depth, stiffness, offsets, shear_stiffness, dim_);
        const Packed<std::int32_t> old = integers_of(old_face_of, "old_face_of");
        if (old.size() != of_host.body.size()) throw py::value_error("old_face_of must have one entry per face");
        const abut_array rest = view_of(nodes, dim_, "nodes");
        call_unlocked(
            [&](abut_error* error) { return abut_replace_surface(handle_.get(), rest, &of_host.view, old.data(), error); });
        callbacks_->after_call();
    }

private:
    struct Destroy {
        void operator()(abut_contact* contact) const { abut_destroy(contact); }
    };
    int dim_;
    std::unique_ptr<Callbacks> callbacks_;  // outlives the handle
    std::unique_ptr<abut_contact, Destroy> handle_;
};

py::array_t<abut_overlap> find_overlaps(const py::array& nodes, const py::object& faces, const py::object& body,
                                        double distance, const py::object& offsets) {
    const int dim = dimension_of(nodes);
    const Faces of_host(faces, body, offsets, dim);
    const abut_array x = view_of(nodes, dim, "nodes");
    return entries_of<abut_overlap>(
        [&](abut_overlap* entries, std::int64_t capacity, std::int64_t* n, abut_error* error) {
            return abut_find_overlaps(dim, x, &of_host.view, distance, entries, sizeof(abut_overlap), capacity, n, error);
        },
        4 * of_host.view.n_faces);
}

/// Tables of cells: one array, the arrays of a dict, of pairs, or of blocks with `type` and `data`.
std::vector<Packed<std::int32_t>> tables_of(const py::object& cells) {
    std::vector<Packed<std::int32_t>> tables;
    const auto take = [&](const py::handle& given) {
        tables.push_back(integers_of(py::reinterpret_borrow<py::object>(given), "cells"));
        if (tables.back().ndim() != 2) throw py::value_error("cells must have the shape (n, corners)");
    };
    if (py::isinstance<py::array>(cells)) {
        take(cells);
        return tables;
    }
    const py::object blocks = py::isinstance<py::dict>(cells) ? py::object(cells.attr("items")()) : cells;
    for (const py::handle block : blocks) {
        if (py::hasattr(block, "type") && py::hasattr(block, "data"))
            take(block.attr("data"));
        else if (py::isinstance<py::sequence>(block) && py::len(block) == 2 && py::isinstance<py::str>(block[py::int_(0)]))
            take(block[py::int_(1)]);
        else {
            tables.clear();
            take(cells);  // lists of corners
            break;
        }
    }
    return tables;
}

py::dict surface_of(const py::array& points, const py::object& given, const py::object& body, bool with_cells) {
    const int dim = dimension_of(points);
    std::vector<std::int32_t> nodes, offsets{0};
    for (const auto& table : tables_of(given)) {
        nodes.insert(nodes.end(), table.data(), table.data() + table.size());
        for (py::ssize_t i = 0; i < table.shape(0); ++i)
            offsets.push_back(offsets.back() + static_cast<std::int32_t>(table.shape(1)));
    }
    abut_cells cells = ABUT_CELLS_INIT;
    cells.n_cells = std::ssize(offsets) - 1;
    cells.nodes = nodes.data();
    cells.n_nodes = std::ssize(nodes);
    cells.offsets = offsets.data();
    Packed<std::int32_t> of_cells;
    if (!body.is_none()) {
        of_cells = integers_of(body, "body");
        if (of_cells.size() != cells.n_cells)
            throw py::value_error("body has " + std::to_string(of_cells.size()) + " entries for " +
                                  std::to_string(cells.n_cells) + " cells; give one each");
        cells.body = of_cells.data();
    }
    const abut_array rest = view_of(points, dim, "points");
    abut_surface* handle = nullptr;
    call_unlocked([&](abut_error* error) { return abut_surface_of(dim, rest, &cells, &handle, error); });
    const std::unique_ptr<abut_surface, decltype(&abut_surface_destroy)> surface(handle, abut_surface_destroy);
    abut_faces faces = ABUT_FACES_INIT;
    const std::int32_t* cell = nullptr;
    abut_error error = ABUT_ERROR_INIT;
    require_ok(abut_surface_faces(handle, &faces, &cell, &error), error);
    const auto copied = [](const auto* data, std::int64_t n) {
        return copy_of(std::span(data, static_cast<std::size_t>(n)));
    };
    py::dict found;
    found["faces"] = copied(faces.nodes, faces.n_nodes);
    found["offsets"] = copied(faces.offsets, faces.n_faces + 1);
    found["body"] = copied(faces.body, faces.n_faces);
    found["depth"] = copied(faces.depth, faces.n_faces);
    if (with_cells) found["cell"] = copied(cell, faces.n_faces);
    return found;
}

double skin_stiffness(double modulus, const Packed<double>& depth) {
    double stiffness = 0.0;
    abut_error error = ABUT_ERROR_INIT;
    require_ok(abut_skin_stiffness(modulus, depth.data(), depth.size(), &stiffness, &error), error);
    return stiffness;
}

void limit_threads(int n) {
    abut_error error = ABUT_ERROR_INIT;
    require_ok(abut_limit_threads(n, &error), error);
}

py::object exception(py::module_& module, const char* name, const py::object& base, const char* text) {
    const std::string full = std::string("abut.") + name;
    py::object made = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(full.c_str(), text, base.ptr(), nullptr));
    module.attr(name) = made;
    return made;
}

}  // namespace

PYBIND11_MODULE(_contact, module) {
    module.doc() = "Contact between deformable solids whose surfaces are made of nodes. docs/languages.md walks through it.";
    module.attr("__version__") = abut_version();
    PYBIND11_NUMPY_DTYPE(abut_pair, face_1, face_2, normal, gap_0, gap_1, area, normal_force, force, events, active_share,
                         compression, friction, slip, point);
    PYBIND11_NUMPY_DTYPE(abut_face_friction, face, normal_force, force, limit, slip, dissipated);
    PYBIND11_NUMPY_DTYPE(abut_body, body, force, moment, work);
    PYBIND11_NUMPY_DTYPE(abut_body_pair, body_1, body_2, active_pairs, force, normal_force);
    PYBIND11_NUMPY_DTYPE(abut_overlap, face_1, face_2, area, normal, gap, distance);

    exceptions = new Exceptions;
    const py::object plain = py::reinterpret_borrow<py::object>(PyExc_Exception);
    exceptions->base = exception(module, "Error", plain,
                                 "Base of all errors of Abut: status, face_1, face_2, value and allowed beside the text; "
                                 "cell in those of abut.solid.");
    const py::object& base = exceptions->base;
    const py::object value_error = py::reinterpret_borrow<py::object>(PyExc_ValueError);
    exceptions->bad_input = exception(module, "BadInput", py::make_tuple(base, value_error),
                                      "A surface, an option or an array that cannot be used. It is a ValueError, too.");
    exceptions->misuse = exception(module, "Misuse", base, "A call out of order.");
    exceptions->diverged = exception(module, "Diverged", base, "A position is not finite, or moves too far in a step.");
    exceptions->too_deep = exception(module, "TooDeep", base, "Faces are pressed in deeper than allowed.");
    exceptions->limit_exceeded = exception(module, "LimitExceeded", base, "A search would take more than its limits allow.");
    exceptions->cancelled = exception(module, "Cancelled", base, "The host has cancelled a step.");
    exceptions->internal = exception(module, "InternalError", base, "A fault of Abut, or of a callback.");

    using namespace py::literals;
    const std::string contact_text = docs::nodal_contact + defaults_of_options() + docs::nodal_contact_end;
    py::class_<NodalContact>(module, "NodalContact", contact_text.c_str())
        .def(py::init<const py::array&, const py::object&, const py::object&, const Packed<double>&, const Packed<double>&,
                      const py::object&, const py::object&, py::object, py::object, py::object, py::object,
                      const std::vector<py::dict>&, py::object, double, py::object, const py::kwargs&>(),
             "nodes"_a, "faces"_a, "body"_a, "depth"_a, "stiffness"_a, "offsets"_a = py::none(), py::kw_only(),
             "shear_stiffness"_a = py::none(), "wanted"_a = py::none(), "cancel"_a = py::none(), "log"_a = py::none(),
             "law_of"_a = py::none(), "laws"_a = std::vector<py::dict>(), "own_coefficient"_a = py::none(),
             "interference_time"_a = 0.0, "interferes"_a = py::none())
        .def("step", &NodalContact::step, "dt"_a, "x_0"_a, "x_1"_a, "out"_a = py::none(), "mode"_a = "mean",
             docs::contact_step)
        .def("evaluate", &NodalContact::evaluate, "x"_a, "out"_a = py::none(), docs::contact_evaluate)
        .def_property_readonly(
            "pairs", &NodalContact::pairs,
            "Active pairs of the last step or evaluation, a structured array.\n\n"
            "face_1, face_2; normal from the first into the second; gap_0 and gap_1 [m] at both ends; area [m^(dim-1)]; "
            "normal_force, force on the second and friction [N]; events; active_share; compression; slip and point [m]. "
            "Vectors have three components.")
        .def_property_readonly("bodies", &NodalContact::bodies,
                               "Force [N], moment [N m] and work [J] by body, a structured array.")
        .def_property_readonly("body_pairs", &NodalContact::body_pairs, "Forces [N] by pair of bodies, a structured array.")
        .def_property_readonly("friction", &NodalContact::friction,
                               "Friction of each face in the last step, a structured array.\n\n"
                               "face; normal_force, force and limit [N]; slip [m]; dissipated [J]. A face with four corners "
                               "appears by halves. After an evaluation: faces and their slip, all else 0.")
        .def_property_readonly("report", &NodalContact::report, "Counters since the start; missed_contacts must stay 0.")
        .def("stable_step", &NodalContact::stable_step, "mass"_a, "omega_free"_a, docs::contact_stable_step)
        .def("state", &NodalContact::state, docs::contact_state)
        .def("restore", &NodalContact::restore, "state"_a, docs::contact_restore)
        .def("surface_replaced", &NodalContact::surface_replaced, "nodes"_a, "faces"_a, "body"_a, "depth"_a, "stiffness"_a,
             "old_face_of"_a, "offsets"_a = py::none(), py::kw_only(), "shear_stiffness"_a = py::none(),
             docs::contact_surface_replaced);
    module.def("find_overlaps", &find_overlaps, "nodes"_a, "faces"_a, "body"_a, "distance"_a, "offsets"_a = py::none(),
               docs::find_overlaps);
    module.def("surface_of", &surface_of, "points"_a, "cells"_a, "body"_a = py::none(), py::kw_only(),
               "with_cells"_a = false, docs::surface_of);
    module.def("skin_stiffness", &skin_stiffness, "modulus"_a, "depth"_a, docs::skin_stiffness);
    module.def("limit_threads", &limit_threads, "n"_a, docs::limit_threads);
}
