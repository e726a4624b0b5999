#include "abut_solid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "arguments.hpp"
#include "in_use.hpp"
#include "solid_run.hpp"

using namespace abut;
using namespace abut::c_layer;

namespace {

template <int Dim>
using RunOf = std::unique_ptr<SolidRun<Dim>>;

}  // namespace

struct abut_solid {
    std::variant<RunOf<2>, RunOf<3>> run;
    mutable std::atomic_flag in_use{};
};

namespace {

/// Calls `call(run, dim)` where the run has begun, or has not.
template <class Handle, class Call>
int with_run(Handle* handle, bool begun, abut_error* error, const Call& call) {
    return guarded(error, 0, [&] {
        check_pointer(handle, "the handle `solid`");
        const bindings::Use use(handle->in_use, "this solid is in use by another thread. Use one thread at a time.");
        std::visit(
            [&](const auto& run) {
                if (run->has_begun() != begun)
                    throw Misuse(begun ? "the solid has not begun. Call abut_solid_begin first."
                                       : "the solid has begun, and nothing can be added. Make another one.");
                call(*run, std::integral_constant < int, std::is_same_v<decltype(run), const RunOf<2>&> ? 2 : 3 > {});
            },
            handle->run);
    });
}

}  // namespace

int abut_solid_create(int32_t dim, abut_solid** solid, abut_error* error) {
    return guarded(error, 0, [&] {
        check_pointer(solid, "solid");
        *solid = nullptr;
        check_dim(dim);
        auto made = std::make_unique<abut_solid>();
        if (dim == 2)
            made->run = std::make_unique<SolidRun<2>>();
        else
            made->run = std::make_unique<SolidRun<3>>();
        *solid = made.release();
    });
}

void abut_solid_destroy(abut_solid* solid) { delete solid; }

int abut_solid_add_box(abut_solid* solid, const char* name, const double* lower, const double* upper, const int32_t* counts,
                       abut_material material, const double* velocity, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto dim) {
        check_pointer(name, "name");
        check_pointer(lower, "lower");
        check_pointer(upper, "upper");
        check_pointer(counts, "counts");
        std::array<int, dim> cells;
        std::copy_n(counts, static_cast<int>(dim), cells.begin());
        const auto shape = dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron;
        run.add(mesh::structured_box<dim>(Vector<dim>(lower), Vector<dim>(upper), cells, shape, name), material, velocity);
    });
}

int abut_solid_add_file(abut_solid* solid, const char* path, abut_material material, const double* velocity,
                        abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto dim) {
        check_pointer(path, "path");
        run.add(mesh::read_mesh<dim>(path), material, velocity);
    });
}

int abut_solid_clamp(abut_solid* solid, const char* group, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(group, "group");
        run.hold(group, solid::Constraint::full);
    });
}

int abut_solid_roller(abut_solid* solid, const char* group, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(group, "group");
        run.hold(group, solid::Constraint::normal);
    });
}

int abut_solid_load(abut_solid* solid, const char* group, const double* traction, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(group, "group");
        run.load(group, traction);
    });
}

int abut_solid_bond(abut_solid* solid, const char* side_1, const char* side_2, double strength, double fracture_energy,
                    abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(side_1, "side_1");
        check_pointer(side_2, "side_2");
        run.bond(side_1, side_2, strength, fracture_energy);
    });
}

int abut_solid_set_fracture(abut_solid* solid, const char* body, const abut_fracture* fracture, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(body, "body");
        check_struct(fracture, "abut_fracture");
        run.set_fracture(body, *fracture);
    });
}

int abut_solid_set_number(abut_solid* solid, const char* body, const char* key, double value, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(body, "body");
        check_pointer(key, "key");
        run.set_values(body, [key = std::string(key), value](BodyValues& values) { set_number(values, key, value); });
    });
}

int abut_solid_set_text(abut_solid* solid, const char* body, const char* key, const char* text, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(body, "body");
        check_pointer(key, "key");
        check_pointer(text, "text");
        run.set_values(
            body, [key = std::string(key), text = std::string(text)](BodyValues& values) { set_text(values, key, text); });
    });
}

int abut_solid_set_numbers(abut_solid* solid, const char* body, const char* key, const double* numbers, int64_t n,
                           abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        check_pointer(body, "body");
        check_pointer(key, "key");
        const auto given = span_of(numbers, n, "numbers");
        run.set_values(body, [key = std::string(key), copy = std::vector<double>(given.begin(), given.end())](
                                 BodyValues& values) { set_numbers(values, key, copy); });
    });
}

int abut_solid_set_temperature(abut_solid* solid, const char* body,
                               double (*rise)(double time, const double* position, void* user), int32_t varies, void* user,
                               abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto dim) {
        check_pointer(body, "body");
        check_pointer(reinterpret_cast<const void*>(rise), "rise");
        const auto value = [rise, user](double time, const Vector<dim>& position) {
            return call_host([&] { return rise(time, position.data(), user); });
        };
        run.set_temperature(body, {.value = value, .varies = varies != 0});
    });
}

int abut_solid_begin(abut_solid* solid, const abut_solid_options* options, abut_error* error) {
    return with_run(solid, false, error, [&](auto& run, auto) {
        if (options != nullptr) check_struct(options, "abut_solid_options");
        run.begin(options != nullptr ? *options : abut_solid_options ABUT_SOLID_OPTIONS_INIT);
    });
}

int abut_solid_n_faces(const abut_solid* solid, const char* group, int64_t* n, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(group, "group");
        check_pointer(n, "n");
        *n = run.n_faces(group);
    });
}

int abut_solid_faces(abut_solid* solid, const char* group, const abut_solid_face_arrays* faces, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(group, "group");
        check_struct(faces, "abut_solid_face_arrays");
        run.write_faces(group, *faces);
    });
}

int abut_solid_set_traction(abut_solid* solid, const char* group, abut_array traction, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(group, "group");
        run.set_traction(group, traction);
    });
}

int abut_solid_n_cells(const abut_solid* solid, const char* body, int64_t* n, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(body, "body");
        check_pointer(n, "n");
        *n = run.n_cells(body);
    });
}

int abut_solid_cells(abut_solid* solid, const char* body, const abut_solid_cell_arrays* cells, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(body, "body");
        check_struct(cells, "abut_solid_cell_arrays");
        run.write_cells(body, *cells);
    });
}

int abut_solid_n_fragments(const abut_solid* solid, int64_t* n, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(n, "n");
        *n = run.n_fragments();
    });
}

int abut_solid_fragments(abut_solid* solid, const abut_solid_fragment_arrays* fragments, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_struct(fragments, "abut_solid_fragment_arrays");
        run.write_fragments(*fragments);
    });
}

int abut_solid_set_step(abut_solid* solid, double dt, int32_t change, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        if (change != ABUT_KEEP && change != ABUT_RESTART)
            throw BadInput("change is " + std::to_string(change) + "; ABUT_KEEP and ABUT_RESTART are allowed.");
        run.set_step(dt, change == ABUT_KEEP ? dynamics::StepChange::keep : dynamics::StepChange::restart);
    });
}

int abut_solid_step(abut_solid* solid, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) { run.run().step(); });
}

int abut_solid_begin_clock(abut_solid* solid, int32_t impulse, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        if (impulse != ABUT_AS_GIVEN && impulse != ABUT_TRAPEZOID)
            throw BadInput("impulse is " + std::to_string(impulse) + "; ABUT_AS_GIVEN and ABUT_TRAPEZOID are allowed.");
        run.begin_clock(impulse == ABUT_AS_GIVEN ? solid::LoadImpulse::as_given : solid::LoadImpulse::trapezoid);
    });
}

int abut_solid_clock(abut_solid* solid, double* time, double* time_to_node, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(time, "time");
        check_pointer(time_to_node, "time_to_node");
        *time = run.clock().time();
        *time_to_node = run.clock().time_to_node();
    });
}

int abut_solid_motion(abut_solid* solid, const char* group, double d, abut_array motion, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(group, "group");
        run.write_motion(group, d, motion);
    });
}

int abut_solid_advance(abut_solid* solid, double d, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) { run.clock().advance(d); });
}

int abut_solid_keep(abut_solid* solid, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) { run.keep(); });
}

int abut_solid_go_back(abut_solid* solid, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) { run.go_back(); });
}

int abut_solid_get_state(abut_solid* solid, abut_solid_state* state, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_struct(state, "abut_solid_state");
        run.write_state(*state);
    });
}

int abut_solid_get_number(abut_solid* solid, const char* column, double* value, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_pointer(column, "column");
        check_pointer(value, "value");
        *value = run.ledger_value(column);
    });
}
