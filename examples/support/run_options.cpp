#include "support/run_options.hpp"

#include <string>

#include "support/choices.hpp"

namespace abut::examples {
namespace {

using contact::OverlapMode;
using contact::Weights;
using dynamics::Neumann;
using geometry::AreaMethod;
using geometry::BroadPhase;

const Choices<BroadPhase> broad_phases = {{"embree", BroadPhase::embree}, {"fcl", BroadPhase::fcl}, {"brute_force", BroadPhase::brute_force}};
const Choices<OverlapMode> overlap_modes = {{"moving", OverlapMode::moving}, {"frozen", OverlapMode::frozen}};
const Choices<Weights> weights = {{"half", Weights::half}, {"stiffness", Weights::stiffness}};
const Choices<AreaMethod> areas = {{"fast", AreaMethod::fast}, {"exact", AreaMethod::exact}};
const Choices<bool> switches = {{"on", true}, {"off", false}};
const Choices<bool> filters = {{"none", false}, {"neutral", true}};
const Choices<int> quadratures = {{"1", 1}, {"2", 2}, {"3", 3}};
const Choices<Neumann> neumanns = {
    {"local_equilibrium", Neumann::local_equilibrium}, {"extrapolate", Neumann::extrapolate}, {"adjacent", Neumann::adjacent}};

void add_time_options(CLI::App& app, RunOptions& options, const std::string& default_of_time) {
    const Limits positive_time{.unit = "s", .above = 0.0};
    add_number(app, "--time", options.time, "end of the run; by default " + default_of_time, positive_time)->group("Time");
    add_number(app, "--cfl", options.cfl, "time step over the stable step, at most 1 (the margin for contact is in the stable step)",
               {.above = 0.0, .below = 1.0, .closed = true, .remedy = "Give a time step above the stable one with --dt and --allow-unstable."})
        ->group("Time");
    auto* dt = add_number(app, "--dt", options.dt, "time step, instead of --cfl; refused above the stable step", positive_time)->group("Time");
    app.add_flag("--allow-unstable", options.allow_unstable, "take --dt even above the stable step")->needs(dt)->group("Time");
    add_choice(app, "--filter", options.filter, "energy-neutral filter of the parasitic mode, after each step in contact", filters)->group("Time");
}

void add_contact_options(CLI::App& app, RunOptions& options) {
    auto& contact = options.contact;
    add_choice(app, "--broad-phase", contact.broad_phase, "what finds faces that are near; all give the same bits", broad_phases)->group("Contact");
    add_choice(app, "--overlap", contact.overlap, "area that follows the motion in a step (energy exact) or is frozen (cheaper)", overlap_modes)
        ->group("Contact");
    add_choice(app, "--weights", contact.weights, "share of a correction between two faces: halves or by their stiffness", weights)->group("Contact");
    add_choice(app, "--area", contact.area, "arithmetic of overlap areas: filtered doubles or CGAL's exact numbers", areas)->group("Contact");
    add_choice(app, "--events", contact.events, "cut steps where a pair opens, closes or changes its overlap (energy exact)", switches)
        ->group("Contact");
    add_choice(app, "--quadrature", contact.quadrature, "Gauss points on each part of a step; by default the exact number: 2 in 2D, 3 in 3D", quadratures)
        ->group("Contact");
    add_number(app, "--skin", contact.skin, "how far faces move before the list of near faces is made anew; 0: a fifth of a face",
               {.unit = "m", .above = 0.0, .zero = true})
        ->group("Contact");
    add_choice(app, "--neumann", options.neumann, "displacement of free faces; extrapolate and adjacent are there for comparison", neumanns)
        ->group("Contact");
}

void add_output_options(CLI::App& app, RunOptions& options) {
    app.add_option("--out", options.out, "folder of all results; made if it is not there")->type_name("DIR")->capture_default_str()->group("Output");
    add_count(app, "--interval", options.interval, "steps between two records of the energies; 0: 1 in 2D, 10 in 3D", 0)->group("Output");
    add_count(app, "--frames", options.frames, "frames for ParaView, first and last included; 0: none", 0)->group("Output");
    add_count(app, "--threads", options.threads, "threads; 0: all. The results do not depend on it", 0)->group("Output");
}

}  // namespace

void add_run_options(CLI::App& app, RunOptions& options, const std::string& default_of_time) {
    add_time_options(app, options, default_of_time);
    add_contact_options(app, options);
    add_output_options(app, options);
}

nlohmann::ordered_json to_json(const RunOptions& options) {
    const auto& contact = options.contact;
    return {{"cfl", options.cfl},
            {"allow_unstable", options.allow_unstable},
            {"filter", name_of(filters, options.filter)},
            {"broad_phase", name_of(broad_phases, contact.broad_phase)},
            {"overlap", name_of(overlap_modes, contact.overlap)},
            {"weights", name_of(weights, contact.weights)},
            {"area", name_of(areas, contact.area)},
            {"events", name_of(switches, contact.events)},
            {"quadrature", contact.quadrature},
            {"skin", contact.skin},
            {"neumann", name_of(neumanns, options.neumann)},
            {"out", options.out.string()},
            {"interval", options.interval},
            {"frames", options.frames},
            {"threads", options.threads}};
}

}  // namespace abut::examples
