#include "abut/run/steps/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/dynamics/mass.hpp"
#include "abut/dynamics/ranks.hpp"
#include "abut/run/steps/of_all_ranks.hpp"
#include "abut/run/steps/output_times.hpp"
#include "abut/run/steps/settling.hpp"
#include "abut/run/steps/start_contact.hpp"
#include "abut/run/values/gathered_cells.hpp"
#include "abut/run/watch/rest_energy.hpp"
#include "abut/solid/bond_view.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/boundary/boundary_face.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/local_steps.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/step_of_breaking.hpp"

namespace abut::run {
namespace {

std::int64_t choose_steps(const RunOptions& options, double time_of_scene, double dt) {
    if (std::isnan(options.time) && options.steps > 0) return options.steps;
    return steps_until(std::isnan(options.time) ? time_of_scene : options.time, dt);
}

/// With what the pilot run picked, if there was one.
template <int Dim>
solid::SolidOptions<Dim> solid_options(const Scene<Dim>& scene, RunOptions options,
                                       const std::optional<PilotReport>& pilot) {
    if (!pilot) return run::solid_options(scene, options);
    options.kinematics = BodyKinematics::scene;
    solid::SolidOptions<Dim> solid = run::solid_options(scene, options);
    solid.kinematics = pilot->kinematics();
    const bool any_turns = solid::any_body(solid.kinematics, &solid::KinematicsProperties::turns);
    if (any_turns && options.law == solid::ContactLaw::automatic) solid.law = solid::ContactLaw::automatic;
    return solid;
}

/// Parts of one piece are bonded by the faces that they have in common: nothing else of them is asked for.
template <int Dim>
std::vector<solid::BondCoverage> bond_coverage(const Scene<Dim>& scene, const solid::Solid<Dim>& solid) {
    const auto coverage = solid.bonds().coverage();
    std::vector<solid::BondCoverage> bonds(coverage.begin(), coverage.end());
    const auto& pieces = scene.mesh.report.joined_bodies;
    for (std::size_t i = 0; i < bonds.size(); ++i)
        if (std::ranges::find(pieces, scene.solid.bonds[i].sides) != pieces.end())
            bonds[i].opposite = bonds[i].smaller_side = bonds[i].area;
    return bonds;
}

/// The kinetic energy at the start. Throws BadInput where there is none.
double required_gauge(double kinetic) {
    if (kinetic > 0.0) return kinetic;
    throw BadInput(
        "--integrator bilbao: all is at rest at the start, and V + c must stay above 0 J. Give c with --gauge, or "
        "energy_scale "
        "of the scene: the energy of what is going to happen.",
        {.value = kinetic, .allowed = 0.0});
}

}  // namespace

template <int Dim>
EnergyScale known_scale(EnergyScale scale, const RunResult<Dim>& result) {
    constexpr double rounding = 1e-9;
    if (scale.name.empty())
        throw BadInput("Scene::energy_scale has no name. Give a letter and what stands below it, such as H0.");
    if (scale.value != 0.0) return scale;
    if (result.energy.accounts.energy_in_play <= result.energy.at_rest) return scale;
    scale.value = result.energy.accounts.energy_in_play;
    if (scale.name == EnergyScale{}.name && scale.value > (1.0 + rounding) * result.ledger.entries().front().kinetic)
        scale.name = "E";
    return scale;
}

solid::SolidTimes added(const solid::SolidTimes& sum, const solid::SolidTimes& a, const solid::SolidTimes& b) {
    return {sum.bulk + a.bulk - b.bulk, sum.contact + a.contact - b.contact, sum.search + a.search - b.search,
            sum.own_cells + a.own_cells - b.own_cells};
}

/// Faces of the whole mesh, on rank 0. A call of all ranks.
template <int Dim>
std::vector<std::array<std::int32_t, 2>> bonded_faces(const solid::Solid<Dim>& solid, const mesh::Mesh<Dim>& whole) {
    std::vector<solid::BoundaryFace> here;
    for (const solid::BondPlace<Dim>& place : solid.bonds().places())
        here.insert(here.end(), place.faces.begin(), place.faces.end());
    const std::vector<solid::BoundaryFace> faces = GatheredCells<Dim>(solid, whole).faces(here);
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (std::size_t i = 0; i < faces.size(); i += 2)
        pairs.push_back({solid::mesh_face(whole, faces[i]), solid::mesh_face(whole, faces[i + 1])});
    return pairs;
}

template <int Dim>
Start<Dim>::Start(const Scene<Dim>& of, const RunOptions& given, std::optional<PilotReport> pilot, const Share<Dim>& share,
                  Observer<Dim>& observer)
    : scene(of), options(given), first_share(share) {
    const solid::SolidOptions<Dim> chosen = solid_options<Dim>(scene, options, pilot);
    if (pilot) solid::require_together(scene.mesh, chosen, features_of(scene, options, chosen, share.ranks));
    solid = std::make_unique<solid::Solid<Dim>>(share.part, chosen, share.ranks);
    result.run.pilot = std::move(pilot);
    result.run.stable = solid::step_of_breaking(*solid);
    result.run.finest_dt = result.run.dt = choose_step(options, result.run.stable.dt);
    if (options.integrator == SolidIntegrator::memm_async) set_local_steps();
    result.run.steps = choose_steps(options, scene.time, result.run.dt);
    check_output_times(options, static_cast<double>(result.run.steps) * result.run.dt);
    const double shortest = std::min(result.run.finest_dt, result.run.stable.dt);
    result.energy.at_rest = values_of_first(share.ranks, [&] {
        return std::vector{rest_energy(scene.mesh, solid->options().materials, shortest, result.run.steps)};
    })[0];
    const solid::StencilReports stencils = solid->cells().stencils();
    result.bodies.stencils = stencils.interior;
    result.bodies.boundary_stencils = stencils.boundary;
    for (std::size_t body = 0; body < solid->options().materials.size(); ++body)
        if (solid::properties_of(solid->options().kinematics, body).finite_strains &&
            solid->options().materials[body].flow.kinematic_hardening > 0.0)
            result.bodies.finite_kinematic_hardening = true;
    result.bodies.all_may_turn = solid::all_bodies(solid->options().kinematics, &solid::KinematicsProperties::turns);
    for (std::size_t body = 0; body < solid->options().materials.size(); ++body)
        result.bodies.may_turn.push_back(solid::properties_of(solid->options().kinematics, body).turns);
    result.bodies.inertia = solid::inertia_of_bodies(*solid, scene.mesh);
    result.contact.blind_corners = solid->contact().blind_corners();
    result.contact.unseen_edges = solid->contact().unseen_edges();
    const auto bonded = bonded_faces(*solid, scene.mesh);
    if (share.ranks.rank() == 0) result.bodies.unjoined = mesh::find_unjoined_faces(scene.mesh, bonded);
    result.bonds.coverage = bond_coverage(scene, *solid);
    set_outside();
    set_state();
    if (options.settle) settle(observer);
}

/// Sets what changes momentum and angular momentum.
template <int Dim>
void Start<Dim>::set_outside() {
    const solid::SolidOptions<Dim>& given = solid->options();
    auto& forces = result.energy.forces_from_outside;
    const auto add_if = [](std::vector<std::string>& list, bool acts, const char* what) {
        if (acts) list.emplace_back(what);
    };
    const auto to_ground = [](const solid::Spring<Dim>& spring) {
        return spring.first.body == solid::ground || spring.second.body == solid::ground;
    };
    add_if(forces, !given.boundary.dirichlet.empty(), "supports");
    add_if(forces, !given.boundary.traction.empty(), "tractions");
    add_if(forces, bool(given.body_load), "loads on the volume");
    add_if(forces, std::ranges::any_of(given.springs, to_ground), "springs to the ground");
    add_if(forces, std::ranges::any_of(given.materials, [](const auto& one) { return one.damping.mass > 0.0; }),
           "mass_damping");
    const bool meets_obstacles = scene.contact && !given.obstacles.empty();
    // The filter holds momentum along what nothing holds, and an obstacle does.
    result.energy.accounts_for_outside =
        forces.empty() && !(options.filter && meets_obstacles) &&
        (options.integrator == SolidIntegrator::memm || options.integrator == SolidIntegrator::leapfrog);
    add_if(forces, std::ranges::any_of(given.acceleration, [](const auto& g) { return !g.isZero(0.0); }), "gravity");
    add_if(forces, meets_obstacles, "obstacles");
    result.energy.moments_from_outside = forces;
    add_if(result.energy.moments_from_outside, !given.moments.empty(), "moments");
    const bool keeps_moments = result.bodies.all_may_turn && given.springs.empty() &&
                               (!scene.contact || solid->contact().pair_potential() != nullptr) &&
                               options.integrator == SolidIntegrator::memm &&
                               options.precision == solid::Precision::double_precision;
    if (!keeps_moments || !result.energy.moments_from_outside.empty()) return;
    double sum = 0.0;
    for (std::size_t c = 0; c < scene.mesh.cell_measure.size(); ++c)
        sum += given.materials[static_cast<std::size_t>(scene.mesh.cell_body[c])].density * scene.mesh.cell_measure[c] *
               scene.mesh.cell_centroid[c].squaredNorm();
    result.energy.moment_scale = std::sqrt(2.0 * sum);
}

template <int Dim>
void Start<Dim>::set_state() {
    q = displacement_at_start(scene, *solid);
    momentum = momentum_at_start(scene, *solid);
}

/// Where it begins is looked at before: later bodies are pressed together, and the look could not tell why.
template <int Dim>
void Start<Dim>::settle(Observer<Dim>& observer) {
    const dynamics::Ranks& ranks = solid->ranks();
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        const double kinetic = 0.5 * dynamics::mass_product_over(ranks, momentum, solid->inverse_mass(), momentum);
        if (scene.contact)
            check_start_contact<Dim>(scene, *solid, q, std::max(kinetic, scene.energy_scale.value), result.energy.at_rest);
        Settled settled = run::settle(scene, solid->options(), first_share, q, result.run.stable.dt, observer);
        q = std::move(settled.q);
        solid->restore(settled.solid, q);
        result.run.settling = settled.report;
    }
    result.run.settling->seconds = seconds;
}

/// The solid before goes first: there is never more than one of them.
template <int Dim>
void Start<Dim>::take_part(const Share<Dim>& share) {
    solid.reset();
    solid = std::make_unique<solid::Solid<Dim>>(share.part, run::solid_options(scene, options), share.ranks);
    set_state();
}

/// The solid before goes first: its mesh is that of the rest before.
template <int Dim>
void Start<Dim>::take_rest(std::unique_ptr<const Scene<Dim>> of, std::unique_ptr<solid::Solid<Dim>> its_solid,
                           const dynamics::IntegratorState& motion) {
    solid = std::move(its_solid);
    rest = std::move(of);
    q = motion.q;
    momentum = motion.p_after;
}

template <int Dim>
void Start<Dim>::set_local_steps() {
    auto local =
        solid::local_steps(*solid, result.run.stable,
                           {.most_levels = options.levels == 0 ? solid::LocalStepOptions{}.most_levels : options.levels,
                            .contact_margin = options.contact_margin,
                            .contact_levels = options.contact_levels});
    local_steps = std::move(local.steps);
    result.run.level_cells = std::move(local.cells);
    result.run.dt *= local.dt / result.run.stable.dt;
    result.run.finest_dt = result.run.dt / local_steps.parts.back();
}

template <int Dim>
double gauge(const Start<Dim>& start) {
    if (!std::isnan(start.options.gauge)) return start.options.gauge;
    if (start.scene.energy_scale.value > 0.0) return 2.0 * start.scene.energy_scale.value;  // V may sink by that scale
    const std::vector<double>& p = start.momentum;
    const auto inverse_mass = start.solid->inverse_mass();
    return required_gauge(0.5 * dynamics::mass_product_over(start.solid->ranks(), p, inverse_mass, p));
}

#define ABUT_INSTANTIATE(Dim)                                                  \
    template EnergyScale known_scale<Dim>(EnergyScale, const RunResult<Dim>&); \
    template struct Start<Dim>;                                                \
    template double gauge<Dim>(const Start<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
