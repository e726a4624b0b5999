#include "abut_solid.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "abut/contact/option_table.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/dynamics/step_options.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/outside_faces.hpp"
#include "abut/solid/outside_view.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/stepped_run.hpp"
#include "arguments.hpp"
#include "in_use.hpp"

using namespace abut;
using namespace abut::c_layer;

namespace {

/// What has been added so far, and then the run.
template <int Dim>
class SolidRun {
public:
    void add(mesh::Mesh<Dim> mesh, const abut_material& material, const double* velocity) {
        for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
            options_.materials.push_back({material.young, material.poisson, material.density});
            velocity_.push_back(vector_of(velocity));
        }
        meshes_.push_back(std::move(mesh));
    }
    void hold(const char* group, solid::Constraint constraint) {
        options_.boundary.dirichlet.push_back({.group = group, .constraint = constraint});
    }
    void load(const char* group, const double* traction) {
        options_.boundary.traction.push_back({.group = group, .value = vector_of(traction), .from_outside = true});
    }
    void bond(const char* side_1, const char* side_2, double strength, double fracture_energy) {
        bonds_.push_back({{side_1, side_2}, strength, fracture_energy});
    }
    void begin(const abut_solid_options& given);
    void write_faces(const std::string& group, const abut_solid_face_arrays& faces);
    void set_traction(const std::string& group, const abut_array& traction) {
        const PointsView<Dim> view = view_of<Dim>(traction, "traction");
        std::vector<Vector<Dim>> values;
        for (std::int32_t i = 0; i < view.size(); ++i) values.push_back(view[i]);
        run_->solid().set_traction(group, values);
    }
    [[nodiscard]] std::int64_t n_faces(const std::string& group) const {
        return std::ssize(run_->solid().outside(group).traction());
    }
    [[nodiscard]] bool has_begun() const { return run_.has_value(); }
    [[nodiscard]] solid::SteppedRun<Dim>& run() { return *run_; }
    void write_state(abut_solid_state& state);

private:
    static Vector<Dim> vector_of(const double* given) {
        return given == nullptr ? Vector<Dim>(Vector<Dim>::Zero()) : Vector<Dim>(Eigen::Map<const Vector<Dim>>(given));
    }

    struct NamedBond {
        std::array<std::string, 2> sides;
        double strength, fracture_energy;
    };
    [[nodiscard]] std::int32_t side_of_bond(const std::string& name) const;

    std::vector<mesh::Mesh<Dim>> meshes_;
    std::vector<NamedBond> bonds_;
    solid::SolidOptions<Dim> options_;
    std::vector<Vector<Dim>> velocity_;
    mesh::Mesh<Dim> mesh_;
    std::optional<solid::SteppedRun<Dim>> run_;
    double stable_dt_ = 0.0;
};

template <int Dim>
std::int32_t SolidRun<Dim>::side_of_bond(const std::string& name) const {
    if (const auto body = std::ranges::find(mesh_.body_names, name); body != mesh_.body_names.end())
        return static_cast<std::int32_t>(body - mesh_.body_names.begin());
    const auto group = std::ranges::find(mesh_.groups, name, &mesh::BoundaryGroup::name);
    if (group == mesh_.groups.end())
        throw BadInput("abut_solid_bond: there is no body and no group '" + name +
                       "'. Give one that was added, with its body in front where several have it.");
    return mesh_.n_bodies() + static_cast<std::int32_t>(group - mesh_.groups.begin());
}

template <int Dim>
void SolidRun<Dim>::begin(const abut_solid_options& given) {
    if (meshes_.empty()) throw Misuse("abut_solid_begin: there is no body. Add one by abut_solid_add_box or _add_file.");
    const std::string whose = "abut_solid_options: ";
    check_value(whose, named(dynamics::step_options(), "dt"), given.dt, 0.0);
    check_value(whose, named(dynamics::step_options(), "cfl"), given.cfl, 0.0);
    check_value(whose, named(dynamics::step_options(), "restart"), std::int64_t{given.restart}, std::int64_t{0});
    check_value(whose, named(contact::friction_options(), "friction"), given.friction, 0.0);
    mesh_ = mesh::combine<Dim>(std::span<const mesh::Mesh<Dim>>(meshes_));
    solid::SolidOptions<Dim> options = options_;
    options.friction.coefficient = given.friction;
    for (const NamedBond& bond : bonds_)
        options.bonds.push_back({.sides = {side_of_bond(bond.sides[0]), side_of_bond(bond.sides[1])},
                                 .strength = bond.strength,
                                 .fracture_energy = bond.fracture_energy});
    if (given.contact != 0) {
        options.contact = contact::ContactOptions{};
        mesh::check_apart(mesh_, "", options.contact->search.broad_phase);
    }
    auto solid = std::make_unique<solid::Solid<Dim>>(mesh_, std::move(options));
    stable_dt_ = dynamics::stable_step(*solid).dt;
    const double dt = given.dt > 0.0 ? given.dt : (given.cfl > 0.0 ? given.cfl : dynamics::StepOptions{}.cfl) * stable_dt_;
    const bool rubs = given.contact != 0 && given.friction > 0.0;
    const int restart = given.restart == 0 && rubs ? solid::restart_with_friction : given.restart;
    const std::vector<double> at_rest(solid->size(), 0.0), p = solid::uniform_momentum<Dim>(*solid, velocity_);
    run_.emplace(std::move(solid), at_rest, p, dt, solid::RunRemedies{.filter = rubs, .restart = restart});
}

template <int Dim>
void SolidRun<Dim>::write_faces(const std::string& group, const abut_solid_face_arrays& faces) {
    const solid::OutsideFaces<Dim> now = solid::outside_faces<Dim>(run_->memm(), run_->solid(), group);
    const auto n = std::ssize(now.area);
    const auto require_size = [n](std::int64_t given, const std::string& name) {
        if (given != n)
            throw BadInput(name + " has place for " + std::to_string(given) + " faces, the group has " + std::to_string(n) +
                               ". abut_solid_n_faces tells how many.",
                           {.value = static_cast<double>(given), .allowed = static_cast<double>(n)});
    };
    require_size(faces.n_faces, "abut_solid_face_arrays");
    auto& memm = run_->memm();
    const std::vector<Vector<Dim>> motion =
        run_->solid().outside(group).motion(memm.q(), memm.next_q(), memm.time(), memm.dt());
    const std::pair<const abut_array&, const std::vector<Vector<Dim>>&> arrays[] = {
        {faces.position, now.position}, {faces.velocity, now.velocity}, {faces.normal, now.normal}, {faces.motion, motion}};
    for (const auto& [to, values] : arrays)
        if (to.data != nullptr) require_size(to.count, "an array of abut_solid_face_arrays");
    for (const auto& [to, values] : arrays)
        for (std::ptrdiff_t i = 0; to.data != nullptr && i < n; ++i)
            for (int d = 0; d < Dim; ++d) to.data[i * to.item + d * to.component] = values[static_cast<std::size_t>(i)][d];
    if (faces.area != nullptr) std::ranges::copy(now.area, faces.area);
}

template <int Dim>
void SolidRun<Dim>::write_state(abut_solid_state& state) {
    auto& memm = run_->memm();
    auto& solid = run_->solid();
    const dynamics::LedgerEntry<Dim> entry = dynamics::measure(memm, solid);
    const solid::OutsideWork work = solid.outside_work(memm.q());
    state = {.struct_size = sizeof(abut_solid_state),
             .steps = memm.steps(),
             .time = memm.time(),
             .dt = memm.dt(),
             .stable_dt = stable_dt_,
             .pseudo_energy = entry.pseudo_energy,
             .energy = entry.energy,
             .kinetic = entry.kinetic,
             .work_steps = work.steps,
             .work_changes = work.changes,
             .work_held = work.held,
             .restart_jumps = entry.restart_jumps,
             .parasitic = entry.parasitic,
             .active_pairs = entry.active_pairs,
             .missed_contacts = solid.contact().report().missed_contacts,
             .dissipated = entry.dissipated,
             .friction_energy = entry.friction_energy,
             .sticking_faces = entry.sticking_faces,
             .sliding_faces = entry.sliding_faces,
             .broken_bonds = solid.bonds().broken_share()};
}

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
        run.add(mesh::structured_box<dim>(Eigen::Map<const Vector<dim>>(lower), Eigen::Map<const Vector<dim>>(upper), cells,
                                          shape, name),
                material, velocity);
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

int abut_solid_set_step(abut_solid* solid, double dt, int32_t change, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        if (change != ABUT_KEEP && change != ABUT_RESTART)
            throw BadInput("change is " + std::to_string(change) + "; ABUT_KEEP and ABUT_RESTART are allowed.");
        run.run().memm().set_step(dt, change == ABUT_KEEP ? dynamics::StepChange::keep : dynamics::StepChange::restart);
    });
}

int abut_solid_step(abut_solid* solid, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) { run.run().step(); });
}

int abut_solid_get_state(abut_solid* solid, abut_solid_state* state, abut_error* error) {
    return with_run(solid, true, error, [&](auto& run, auto) {
        check_struct(state, "abut_solid_state");
        run.write_state(*state);
    });
}
