#include "solid_run.hpp"
#include "abut/solid/run_remedies.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/contact/option_table.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/dynamics/step_options.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/outside_faces.hpp"
#include "abut/solid/outside_view.hpp"
#include "arguments.hpp"

namespace abut::c_layer {
namespace {

/// Throws where arrays of a host have place for another number.
void require_size(std::int64_t given, std::int64_t n, const std::string& name, const std::string& items,
                  const char* function) {
    if (given != n)
        throw BadInput(name + " has place for " + std::to_string(given) + " " + items + ", there are " + std::to_string(n) +
                           ". " + function + " tells how many.",
                       {.value = static_cast<double>(given), .allowed = static_cast<double>(n)});
}

/// Numbers of one item after the other, into an array of the host if there is one.
void write_items(std::span<const double> values, int per_item, const abut_array& to) {
    if (to.data == nullptr) return;
    for (std::ptrdiff_t i = 0; i < to.count; ++i)
        for (int d = 0; d < per_item; ++d)
            to.data[i * to.item + d * to.component] = values[static_cast<std::size_t>(i * per_item + d)];
}

/// Throws BadInput for a step above the stable one. `whose`: "abut_solid_options.dt".
void require_stable(double dt, double stable_dt, const std::string& whose) {
    if (dt > stable_dt)
        throw BadInput(
            whose + " is " + number(dt) + " s, above the stable step of " + number(stable_dt) +
                " s, from which on vibrations grow. Give at most that (abut_solid_state.stable_dt), or a cfl of at "
                "most 1.",
            {.value = dt, .allowed = stable_dt});
}

template <int Dim>
std::span<const double> numbers_of(const std::vector<Vector<Dim>>& vectors) {
    return {vectors.empty() ? nullptr : vectors.front().data(), vectors.size() * Dim};
}

}  // namespace

template <int Dim>
void SolidRun<Dim>::add(mesh::Mesh<Dim> mesh, const abut_material& material, const double* velocity) {
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
        options_.materials.push_back({material.young, material.poisson, material.density});
        velocity_.push_back(vector_of(velocity));
    }
    meshes_.push_back(std::move(mesh));
}

template <int Dim>
void SolidRun<Dim>::set_values(const std::string& body, SetValues set) {
    BodyValues any;
    set(any);
    values_.push_back({body, std::move(set)});
}

template <int Dim>
std::int32_t SolidRun<Dim>::body_called(const std::string& name) const {
    const auto body = std::ranges::find(mesh_.body_names, name);
    if (body == mesh_.body_names.end())
        throw BadInput("there is no body '" + name +
                       "'. Give one that was added, with its file in front where several have it.");
    return static_cast<std::int32_t>(body - mesh_.body_names.begin());
}

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
void SolidRun<Dim>::take_values(solid::SolidOptions<Dim>& options) const {
    std::vector<BodyValues> values;
    for (const solid::Material& material : options.materials) values.push_back({.material = material});
    for (const auto& [body, set] : values_) set(values[static_cast<std::size_t>(body_called(body))]);
    for (std::size_t body = 0; body < values.size(); ++body) {
        options.materials[body] = material_of(values[body]);
        options.kinematics.push_back(values[body].kinematics);
        try {
            solid::check(options.materials[body], static_cast<int>(body));
        } catch (const BadInput& error) {
            std::string what = error.what();
            if (const std::string numbered = "material of body " + std::to_string(body) + ": "; what.starts_with(numbered))
                what.erase(0, numbered.size());
            throw BadInput("body '" + mesh_.body_names[body] + "': " + what, error.facts());
        }
    }
    if (!temperatures_.empty()) options.temperature_rise.resize(values.size());
    for (const auto& [body, rise] : temperatures_)
        options.temperature_rise[static_cast<std::size_t>(body_called(body))] = rise;
}

template <int Dim>
solid::SolidOptions<Dim> SolidRun<Dim>::options_of(const abut_solid_options& given) const {
    solid::SolidOptions<Dim> options = options_;
    take_values(options);
    options.friction.coefficient = given.friction;
    for (const NamedBond& bond : bonds_)
        options.bonds.push_back({.sides = {side_of_bond(bond.sides[0]), side_of_bond(bond.sides[1])},
                                 .strength = bond.strength,
                                 .fracture_energy = bond.fracture_energy});
    if (given.contact != 0) options.contact = contact::ContactOptions{};
    return options;
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
    solid::SolidOptions<Dim> options = options_of(given);
    if (options.contact) mesh::check_apart(mesh_, "", options.contact->search.broad_phase);
    auto solid = std::make_unique<solid::Solid<Dim>>(mesh_, std::move(options));
    stable_dt_ = dynamics::stable_step(*solid).dt;
    const double dt = given.dt > 0.0 ? given.dt : (given.cfl > 0.0 ? given.cfl : dynamics::StepOptions{}.cfl) * stable_dt_;
    require_stable(dt, stable_dt_, "abut_solid_options.dt");
    const bool rubs = given.contact != 0 && given.friction > 0.0;
    const int restart =
        given.restart == 0 ? solid::default_remedies(solid->options().kinematics, rubs).restart : given.restart;
    const std::vector<double> at_rest(solid->size(), 0.0), p = solid::uniform_momentum<Dim>(*solid, velocity_);
    run_.emplace(std::move(solid), at_rest, p, dt, solid::RunRemedies{.filter = rubs, .restart = restart});
    log_ = given.log;
    user_ = given.user;
}

template <int Dim>
void SolidRun<Dim>::set_step(double dt, dynamics::StepChange change) {
    require_stable(dt, stable_dt_, "abut_solid_set_step: dt");
    const std::string warning = run_->set_step(dt, change, "abut_solid_begin_clock and abut_solid_advance");
    if (!warning.empty() && log_ != nullptr) log_(ABUT_WARNING, warning.c_str(), user_);
}

template <int Dim>
void SolidRun<Dim>::set_traction(const std::string& group, const abut_array& traction) {
    const PointsView<Dim> view = view_of<Dim>(traction, "traction");
    std::vector<Vector<Dim>> values;
    for (std::int32_t i = 0; i < view.size(); ++i) values.push_back(view[i]);
    if (clock_)
        clock_->set_traction(group, values);
    else
        run_->solid().set_traction(group, values);
}

template <int Dim>
solid::ClockedRun<Dim>& SolidRun<Dim>::clock() {
    if (!clock_) throw Misuse("the clock of the solid has not begun: call abut_solid_begin_clock first.");
    return *clock_;
}

template <int Dim>
void SolidRun<Dim>::write_motion(const std::string& group, double d, const abut_array& motion) {
    const std::vector<Vector<Dim>> values = clock().motion(group, d);
    require_size(motion.count, std::ssize(values), "motion", "faces of the group", "abut_solid_n_faces");
    write_items(numbers_of<Dim>(values), Dim, motion);
}

template <int Dim>
void SolidRun<Dim>::go_back() {
    if (!kept_)
        throw Misuse("abut_solid_go_back: no state is kept. Call abut_solid_keep before the step that may be rejected.");
    clock().restore(*kept_);
}

template <int Dim>
void SolidRun<Dim>::write_faces(const std::string& group, const abut_solid_face_arrays& faces) {
    const solid::OutsideFaces<Dim> now =
        clock_ ? clock_->faces(group) : solid::outside_faces<Dim>(run_->memm(), run_->solid(), group);
    const auto n = std::ssize(now.area);
    const auto check_size = [n](std::int64_t given, const char* name) {
        require_size(given, n, name, "faces of the group", "abut_solid_n_faces");
    };
    check_size(faces.n_faces, "abut_solid_face_arrays");
    auto& memm = run_->memm();
    const std::vector<Vector<Dim>> motion =
        clock_ ? clock_->motion(group, clock_->time_to_node())
               : run_->solid().outside(group).motion(memm.q(), memm.next_q(), memm.time(), memm.dt());
    const std::pair<const abut_array&, const std::vector<Vector<Dim>>&> arrays[] = {
        {faces.position, now.position}, {faces.velocity, now.velocity}, {faces.normal, now.normal}, {faces.motion, motion}};
    for (const auto& [to, values] : arrays)
        if (to.data != nullptr) check_size(to.count, "an array of abut_solid_face_arrays");
    for (const auto& [to, values] : arrays) write_items(numbers_of<Dim>(values), Dim, to);
    if (faces.area != nullptr) std::ranges::copy(now.area, faces.area);
}

template <int Dim>
std::int64_t SolidRun<Dim>::n_cells(const std::string& body) const {
    return std::ranges::count(mesh_.cell_body, body_called(body));
}

template <int Dim>
void SolidRun<Dim>::write_cells(const std::string& body, const abut_solid_cell_arrays& cells) {
    const std::int32_t number = body_called(body);
    const auto n = std::ranges::count(mesh_.cell_body, number);
    const auto check_size = [n](std::int64_t given, const char* name) {
        require_size(given, n, name, "cells of the body", "abut_solid_n_cells");
    };
    check_size(cells.n_cells, "abut_solid_cell_arrays");
    for (const abut_array* to : {&cells.position, &cells.velocity, &cells.stress})
        if (to->data != nullptr) check_size(to->count, "an array of abut_solid_cell_arrays");

    auto& solid = run_->solid();
    const dynamics::RunView<Dim> now(run_->memm());
    static_cast<void>(solid.potential(now.q));  // leaves the stresses of this state behind
    std::vector<double> momentum(now.p_before.begin(), now.p_before.end());
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = 0.5 * (momentum[i] + now.p_after[i]);
    const std::vector<Vector<Dim>> displacement = solid.cells().displacement(now.q),
                                   velocity = solid.cells().velocity(momentum);
    std::vector<Vector<Dim>> position, of_body;
    std::vector<double> stress, plastic;
    for (std::int32_t c = 0; c < mesh_.n_cells(); ++c) {
        const auto at = static_cast<std::size_t>(c);
        if (mesh_.cell_body[at] != number) continue;
        position.push_back(mesh_.cell_centroid[at] + displacement[at]);
        of_body.push_back(velocity[at]);
        const Matrix<Dim> sigma = solid.cells().stress(c);
        stress.insert(stress.end(), sigma.data(), sigma.data() + sigma.size());
        plastic.push_back(solid.cells().plastic_strain(c));
    }
    write_items(numbers_of<Dim>(position), Dim, cells.position);
    write_items(numbers_of<Dim>(of_body), Dim, cells.velocity);
    write_items(stress, Dim * Dim, cells.stress);
    if (cells.plastic_strain != nullptr) std::ranges::copy(plastic, cells.plastic_strain);
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
             .broken_bonds = solid.bonds().broken_share(),
             .work_heat = work.heat};
}

template <int Dim>
double SolidRun<Dim>::ledger_value(const std::string& column) {
    const std::vector<std::string> columns = dynamics::ledger_columns<Dim>();
    const auto found = std::ranges::find(columns, column);
    if (found == columns.end()) {
        std::string all;
        for (const std::string& name : columns) all += (all.empty() ? "'" : ", '") + name + "'";
        throw BadInput("a ledger has no column '" + column + "'. There are " + all + ".");
    }
    const auto entry = dynamics::measure(run_->memm(), run_->solid());
    return dynamics::ledger_values(entry)[static_cast<std::size_t>(found - columns.begin())];
}

template class SolidRun<2>;
template class SolidRun<3>;

}  // namespace abut::c_layer
