#include "solid_run.hpp"
#include "abut/solid/run_remedies.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/given_value.hpp"
#include "abut/base/messages.hpp"
#include "abut/contact/option_table.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/dynamics/step_options.hpp"
#include "abut/mesh/grains.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/split_body.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/fragments.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/options/number_tables.hpp"
#include "abut/solid/outside_faces.hpp"
#include "abut/solid/outside_view.hpp"
#include "abut/solid/step_of_breaking.hpp"
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

constexpr const char* stable_remedy = "Give at most that (abut_solid_state.stable_dt), or a cfl of at most 1.";

/// "is 'bar'", "are 'block_1.block', 'block_2.block'"; of many the first ones.
std::string names_in_words(const std::vector<std::string>& names) {
    constexpr std::size_t most = 6;
    std::string text = names.size() == 1 ? "is '" : "are '";
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i > 0 ? "', '" : "") + names[i];
    return text + (names.size() > most ? "' and " + std::to_string(names.size() - most) + " more" : "'");
}

template <int Dim>
std::span<const double> numbers_of(const std::vector<Vector<Dim>>& vectors) {
    return {vectors.empty() ? nullptr : vectors.front().data(), vectors.size() * Dim};
}

solid::Bond bond_of(const abut_fracture& fracture) {
    solid::Bond bond{.strength = fracture.strength, .fracture_energy = fracture.fracture_energy};
    bond.of_grains = true;
    if (fracture.weibull != 0.0) bond.weibull_modulus = fracture.weibull;
    bond.seed = static_cast<std::uint32_t>(fracture.seed);
    return bond;
}

/// The body of a mesh of one, cut into grains "<body>.1", "<body>.2", ...
template <int Dim>
mesh::Mesh<Dim> in_grains(const mesh::Mesh<Dim>& mesh, const std::string& body, const abut_fracture& fracture) {
    const std::vector<std::int32_t> grains =
        mesh::grains_of<Dim>(mesh, {.size = fracture.grain, .seed = static_cast<std::uint32_t>(fracture.seed)});
    std::vector<std::string> names;
    for (std::int32_t grain = 0; grain <= std::ranges::max(grains); ++grain)
        names.push_back(body + "." + std::to_string(grain + 1));
    return mesh::split_body<Dim>(mesh, grains, std::move(names));
}

}  // namespace

template <int Dim>
void SolidRun<Dim>::add(mesh::Mesh<Dim> mesh, const abut_material& material, const double* velocity) {
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
        options_.materials.push_back({material.young, material.poisson, material.density});
        velocity_.push_back(vector_of(velocity));
        fracture_of_body_.push_back(-1);
    }
    meshes_.push_back(std::move(mesh));
}

template <int Dim>
void SolidRun<Dim>::set_fracture(const std::string& body, const abut_fracture& fracture) {
    require_allowed("abut_fracture.grain", mesh::grain_size, fracture.grain);
    require_allowed("abut_fracture.", solid::bond_numbers, bond_of(fracture));
    const auto has_it = [&](const auto& mesh) { return std::ranges::count(mesh.body_names, body) > 0; };
    if (std::ranges::count_if(meshes_, has_it) + std::ranges::count(fractures_, body, &Fracture::body) > 1)
        throw BadInput("abut_solid_set_fracture: several bodies are called '" + body +
                       "', and their pieces could not be told apart. Give them different names.");
    std::size_t first = 0, at = 0;  // bodies before those of the mesh
    while (at < meshes_.size() && meshes_[at].body_names != std::vector{body})
        first += static_cast<std::size_t>(meshes_[at++].n_bodies());
    if (at == meshes_.size())
        throw BadInput("abut_solid_set_fracture: there is no body '" + body +
                       "' that is whole and the only one of its box or file. Add it first, and call this once.");
    meshes_[at] = in_grains<Dim>(meshes_[at], body, fracture);
    const auto more = static_cast<std::size_t>(meshes_[at].n_bodies() - 1);
    const auto repeat = [&](auto& of_bodies) {
        const auto value = of_bodies[first];
        of_bodies.insert(of_bodies.begin() + static_cast<std::ptrdiff_t>(first), more, value);
    };
    fracture_of_body_[first] = static_cast<std::int32_t>(fractures_.size());
    repeat(options_.materials), repeat(velocity_), repeat(fracture_of_body_);
    fractures_.push_back({body, bond_of(fracture)});
}

template <int Dim>
void SolidRun<Dim>::set_values(const std::string& body, SetValues set) {
    BodyValues any;
    set(any);
    values_.push_back({body, std::move(set)});
}

template <int Dim>
std::vector<std::int32_t> SolidRun<Dim>::bodies_called(const std::string& name) const {
    std::vector<std::int32_t> bodies;
    for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body) {
        const std::int32_t fracture = fracture_of_body_[static_cast<std::size_t>(body)];
        if (mesh_.body_names[static_cast<std::size_t>(body)] == name ||
            (fracture >= 0 && fractures_[static_cast<std::size_t>(fracture)].body == name))
            bodies.push_back(body);
    }
    if (bodies.empty()) throw BadInput("there is no body '" + name + "'. There " + names_in_words(mesh_.body_names) + ".");
    return bodies;
}

template <int Dim>
std::int32_t SolidRun<Dim>::side_of_bond(const std::string& name) const {
    if (const auto body = std::ranges::find(mesh_.body_names, name); body != mesh_.body_names.end())
        return static_cast<std::int32_t>(body - mesh_.body_names.begin());
    const auto group = std::ranges::find(mesh_.groups, name, &mesh::BoundaryGroup::name);
    if (std::ranges::count(fractures_, name, &Fracture::body) > 0)
        throw BadInput("abut_solid_bond: body '" + name + "' may break: it is in the grains '" + name + ".1', '" + name +
                       ".2' and so on. Give one of these, or a group of its faces, \"" + name + ".<group>\".");
    if (group == mesh_.groups.end())
        throw BadInput("abut_solid_bond: there is no body and no group '" + name +
                       "'. Give one that was added, with its body in front where several have it.");
    return mesh_.n_bodies() + static_cast<std::int32_t>(group - mesh_.groups.begin());
}

template <int Dim>
void SolidRun<Dim>::take_values(solid::SolidOptions<Dim>& options) const {
    std::vector<BodyValues> values;
    for (const solid::Material& material : options.materials) values.push_back({.material = material});
    for (const auto& [name, set] : values_)
        for (const std::int32_t body : bodies_called(name)) set(values[static_cast<std::size_t>(body)]);
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
    for (const auto& [name, rise] : temperatures_)
        for (const std::int32_t body : bodies_called(name)) options.temperature_rise[static_cast<std::size_t>(body)] = rise;
}

template <int Dim>
void SolidRun<Dim>::bond_grains(solid::SolidOptions<Dim>& options) const {
    for (const auto& sides : mesh_.report.joined_bodies) {
        const auto body = static_cast<std::size_t>(sides[0]);
        if (fracture_of_body_[body] < 0) continue;
        const Fracture& fracture = fractures_[static_cast<std::size_t>(fracture_of_body_[body])];
        if (!options.contact)
            throw BadInput("body '" + fracture.body +
                           "' may break, and without contact its pieces pass through each other. Let contact act "
                           "(abut_solid_options.contact), or leave its fracture out.");
        if (!solid::properties_of(options.kinematics[body]).turns)
            throw BadInput("body '" + fracture.body +
                           "' may break, and pieces that come off turn. Set its \"kinematics\" to \"floating\", or to "
                           "\"finite\" where it bends far (abut_solid_set_text).");
        options.bonds.push_back(fracture.bond);
        options.bonds.back().sides = sides;
    }
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
    bond_grains(options);
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
    stable_dt_ = solid::step_of_breaking(*solid).dt;
    const double dt = given.dt > 0.0 ? given.dt : (given.cfl > 0.0 ? given.cfl : dynamics::StepOptions{}.cfl) * stable_dt_;
    dynamics::require_stable("abut_solid_options.dt", dt, stable_dt_, stable_remedy);
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
    dynamics::require_stable("abut_solid_set_step: dt", dt, stable_dt_, stable_remedy);
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
    if (faces.bonded != nullptr) std::ranges::copy(now.bonded, faces.bonded);
}

template <int Dim>
std::int64_t SolidRun<Dim>::n_cells(const std::string& body) const {
    const std::vector<std::int32_t> bodies = bodies_called(body);
    return std::ranges::count_if(mesh_.cell_body, [&](std::int32_t of) { return std::ranges::binary_search(bodies, of); });
}

template <int Dim>
void SolidRun<Dim>::write_cells(const std::string& body, const abut_solid_cell_arrays& cells) {
    const std::vector<std::int32_t> bodies = bodies_called(body);
    const std::int64_t n = n_cells(body);
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
        if (!std::ranges::binary_search(bodies, mesh_.cell_body[at])) continue;
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
    if (cells.fragment == nullptr) return;
    const std::vector<std::int32_t> fragment = solid::fragment_of_bodies<Dim>(solid);
    std::int32_t* to = cells.fragment;
    for (const std::int32_t of : mesh_.cell_body)
        if (std::ranges::binary_search(bodies, of)) *to++ = fragment[static_cast<std::size_t>(of)];
}

template <int Dim>
std::int64_t SolidRun<Dim>::n_fragments() const {
    return std::ranges::max(solid::fragment_of_bodies<Dim>(run_->solid())) + 1;
}

template <int Dim>
void SolidRun<Dim>::write_fragments(const abut_solid_fragment_arrays& fragments) {
    const auto found = solid::fragments<Dim>(dynamics::RunView<Dim>(run_->memm()), run_->solid());
    const auto check_size = [&](std::int64_t given, const char* name) {
        require_size(given, std::ssize(found), name, "fragments", "abut_solid_n_fragments");
    };
    check_size(fragments.n_fragments, "abut_solid_fragment_arrays");
    for (const abut_array* to : {&fragments.centre, &fragments.velocity, &fragments.spin})
        if (to->data != nullptr) check_size(to->count, "an array of abut_solid_fragment_arrays");
    const auto write = [&](const auto& member, const abut_array& to) {
        std::vector<double> values;
        for (const auto& fragment : found) values.insert(values.end(), (fragment.*member).begin(), (fragment.*member).end());
        write_items(values, static_cast<int>((solid::Fragment<Dim>{}.*member).size()), to);
    };
    write(&solid::Fragment<Dim>::centre, fragments.centre);
    write(&solid::Fragment<Dim>::velocity, fragments.velocity);
    write(&solid::Fragment<Dim>::spin, fragments.spin);
    if (fragments.mass != nullptr) std::ranges::transform(found, fragments.mass, &solid::Fragment<Dim>::mass);
    if (fragments.n_cells != nullptr) std::ranges::transform(found, fragments.n_cells, &solid::Fragment<Dim>::n_cells);
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
             .work_heat = work.heat,
             .beyond_fracture_energy = solid.bonds().beyond_fracture_energy()};
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
