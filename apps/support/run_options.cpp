#include "apps/support/run_options.hpp"

#include <type_traits>
#include <variant>

#include "apps/support/command_line.hpp"
#include "apps/support/contact_choices.hpp"

namespace abut::apps {
namespace {

const auto overlap_modes = choices_of(run::overlap_words);
const auto weights = choices_of(run::weighting_words);
const auto kinematics = choices_of(run::kinematics_words);
const auto laws = choices_of(run::law_words);
const auto integrators = choices_of(run::integrator_words);
const auto precisions = choices_of(run::precision_words);
const auto devices = choices_of(run::device_words);
const auto switches = choices_of(run::event_words);
const auto filters = choices_of(run::filter_words);
const auto free_face_rules = choices_of(run::free_face_words);
const auto corner_rules = choices_of(run::corner_words);
const Choices<int> quadratures = {{"1", 1}, {"2", 2}, {"3", 3}};

nlohmann::ordered_json to_json(const run::NamedValues& values) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const run::NamedValue& value : values) json[value.name] = apps::to_json(value.value);
    return json;
}

}  // namespace

void add_time_options(CLI::App& app, run::RunOptions& options, const std::string& default_of_time) {
    const Limits positive{.unit = "s", .above = 0.0};
    auto* time = add_number(app, "--time", options.time, "end of the run; by default " + default_of_time, positive);
    time->group("Time");
    add_count(app, "--steps", options.steps, "steps of the run, instead of --time; 0: as many as the time takes", 0)
        ->excludes(time)
        ->group("Time");
    const char* cfl_help = "time step over the stable step, at most 1 (the margin for contact is in the stable step)";
    auto* cfl = add_number(app, "--cfl", options.cfl, cfl_help,
                           {.above = 0.0,
                            .below = 1.0,
                            .closed = true,
                            .remedy = "Give a time step above the stable one with --dt and --allow-unstable."});
    cfl->group("Time");
    const char* dt_help = "time step, refused above the stable step; by default --cfl decides";
    auto* dt = add_number(app, "--dt", options.dt, dt_help, positive)->excludes(cfl)->group("Time");
    app.add_flag("--allow-unstable", options.allow_unstable, "take --dt even above the stable step")
        ->needs(dt)
        ->default_str("off")
        ->group("Time");
    add_choice(app, "--integrator", options.integrator, "scheme in time (docs/integrators.md)", integrators)->group("Time");
    add_choice(app, "--precision", options.precision,
               "of the bulk in steps of memm and leapfrog: single is less exact (docs/trade.md); contact is always "
               "double",
               precisions)
        ->group("Time");
    add_choice(app, "--device", options.device,
               "of the bulk in steps of memm and leapfrog: kokkos is what Kokkos was built for, a GPU or the host "
               "(docs/devices.md); the results are the same",
               devices)
        ->group("Time");
    add_count(app, "--levels", options.levels, "of memm_async: different steps at most, each half the one before; 0: 8", 0)
        ->group("Time");
    add_count(app, "--contact-margin", options.contact_margin,
              "of memm_async: how often the steps of cells in contact are halved more than they need, down to the shortest",
              0)
        ->group("Time");
    add_count(app, "--contact-levels", options.contact_levels,
              "of memm_async: how often the steps of cells in contact are halved beyond the shortest of the others", 0)
        ->group("Time");
    add_number(app, "--gauge", options.gauge,
               "c of the Bilbao scheme; by default the energy at the start, from rest twice that of the fall",
               {.unit = "J", .above = 0.0})
        ->group("Time");
    add_choice(app, "--filter", options.filter, "energy-neutral filter of the parasitic mode, after each step in contact",
               filters)
        ->group("Time");
    add_count(
        app, "--restart", options.restart,
        "of memm: steps between neutral restarts, which clear the parasitic mode of whole bodies; 0: none; by default 50 "
        "where a body is finite, else 0",
        0)
        ->default_str("")
        ->group("Time");
}

void add_model_options(CLI::App& app, run::RunOptions& options) {
    auto& contact = options.contact;
    const auto grouped = [](CLI::Option* option) { option->group("Contact"); };
    grouped(add_choice(app, "--weights", contact.weighting,
                       "share of a correction between two faces: halves or by their stiffness", weights));
    grouped(add_choice(app, "--area", contact.area, "arithmetic of overlap areas: filtered doubles or CGAL's exact numbers",
                       areas));
    grouped(add_choice(app, "--neumann", options.neumann,
                       "displacement of free faces; extrapolate and adjacent are there for comparison", free_face_rules));
    grouped(
        add_choice(app, "--corners", options.corners,
                   "free faces of a cell beside one in contact: relaxed keeps them in balance, fixed is for cavities that "
                   "press on two sides",
                   corner_rules));
}

void add_contact_options(CLI::App& app, run::RunOptions& options) {
    add_model_options(app, options);
    auto& contact = options.contact;
    const auto grouped = [](CLI::Option* option) { option->group("Contact"); };
    grouped(add_choice(app, "--kinematics", options.kinematics,
                       "of all bodies: small for those that do not turn, floating frames, finite (they bend), rigid, as the "
                       "scene says, or automatic: small, floating or rigid by what a run with rigid bodies shows",
                       kinematics));
    grouped(add_choice(
        app, "--law", options.law,
        "of contact: the modified reconstruction for bodies that do not turn; the pair potential for all, and by default",
        laws));
    grouped(add_choice(app, "--broad-phase", contact.search.broad_phase,
                       "what finds faces that are near; all give the same bits", broad_phases));
    grouped(add_choice(app, "--self-contact", contact.search.self_contact,
                       "contact acts between parts of one body, too, by the modified reconstruction", switches));
    grouped(add_choice(app, "--overlap", contact.overlap,
                       "area that follows the motion in a step (energy exact) or is frozen (cheaper)", overlap_modes));
    grouped(add_choice(app, "--events", contact.events,
                       "cut steps where a pair opens, closes or changes its overlap (energy exact)", switches));
    grouped(add_choice(app, "--quadrature", contact.quadrature,
                       "Gauss points on each part of a step; by default the exact number: 2 in 2D, 3 in 3D", quadratures));
    grouped(add_number(
        app, "--facing-cosine", contact.search.facing_cosine,
        "faces look at each other where the cosine between their normals is below it; nearer to 0 sharper tips are seen",
        {.above = -1.0, .below = 0.0}));
    grouped(add_number(app, "--facing-full", options.facing.full,
                       "of the pair potential: cosine between the normals of two faces up to which their pair has its whole "
                       "weight",
                       {.above = -1.0, .below = 0.0}));
    grouped(
        add_number(app, "--facing-none", options.facing.none,
                   "of the pair potential: cosine from which on a pair has no weight; nearer to 0 sharper tips and edges "
                   "are seen",
                   {.above = -1.0, .below = 0.0, .closed = true}));
    grouped(add_number(app, "--skin", contact.search.skin,
                       "how far faces move before the list of near faces is rebuilt; 0: chosen from the number of faces "
                       "and pairs and the motion",
                       {.unit = "m", .above = 0.0, .zero = true}));
    add_compression_limit(app, options);
}

void add_compression_limit(CLI::App& app, run::RunOptions& options) {
    const char* help =
        "how deep faces may be pressed into each other, over D, the depth of their cells, before the run stops";
    add_number(app, "--compression-limit", options.contact.compression_limit, help, {.above = 0.0})->group("Contact");
}

void add_ranks_options(CLI::App& app, run::RunOptions& options) {
    const auto grouped = [](CLI::Option* option) { option->group("Output"); };
    grouped(add_count(
        app, "--ranks", options.ranks,
        "ranks that the scene is shared out to, on this machine; 0: one, or those that mpirun has started. The results "
        "do not depend on it",
        0));
    grouped(
        add_count(app, "--rebalance", options.rebalance,
                  "of several ranks: steps from one look at what their cells cost each of them to the next; 0: each keeps "
                  "its cells. The results do not depend on it",
                  0));
    grouped(add_number(app, "--rebalance-above", options.rebalance_above,
                       "cells are shared out again where they cost one rank so many times the mean; 1: at each look",
                       {.above = 0.0}));
}

void add_output_options(CLI::App& app, run::RunOptions& options) {
    app.add_option("--out", options.out, "folder of all results; made if it is not there, refused while another run has it")
        ->type_name("DIR")
        ->capture_default_str()
        ->group("Output");
    const auto grouped = [](CLI::Option* option) { option->group("Output"); };
    grouped(add_count(app, "--interval", options.interval,
                      "steps between two records of the energies; 0: as many as make about 2,000, in 3D at least 10", 0));
    grouped(add_count(app, "--frames", options.frames, "frames for ParaView, first and last included; 0: none", 0));
    app.add_flag("--pieces", options.pieces,
                 "each rank writes its own cells of a frame (.pvtu names the pieces); by default rank 0 writes the whole")
        ->group("Output");
    grouped(add_number(
        app, "--checkpoint", options.checkpoint,
        "minutes from one checkpoint to the next; at SIGINT, SIGTERM and SIGHUP there is one, too; 0: none at all",
        {.unit = "min", .above = 0.0, .zero = true, .remedy = "Give minutes, or 0 for no checkpoints."}));
    grouped(add_count(app, "--checkpoint-steps", options.checkpoint_steps,
                      "steps from one checkpoint to the next, beside that; 0: by minutes alone", 0));
    app.add_flag("--keep-last-checkpoint", options.keep_last_checkpoint,
                 "of a run that comes to its end, too: abut restart DIR --until TIME goes on from there")
        ->default_str("off")
        ->group("Output");
    app.add_flag("--resume", options.resume,
                 "goes on from the last checkpoint in the folder of --out; by default a run begins at its start")
        ->group("Output");
    grouped(add_count(app, "--threads", options.threads,
                      "threads, of each rank where there are several; 0: all. The results do not depend on it", 0));
    add_ranks_options(app, options);
}

nlohmann::ordered_json to_json(const run::Value& value) {
    return std::visit(
        [](const auto& held) {
            if constexpr (std::is_same_v<std::decay_t<decltype(held)>, std::monostate>)
                return nlohmann::ordered_json();
            else
                return nlohmann::ordered_json(held);
        },
        value);
}

nlohmann::ordered_json to_json(const run::RunOptions& options) { return to_json(run::named_values(options)); }
nlohmann::ordered_json model_json(const run::RunOptions& options) { return to_json(run::model_values(options)); }

}  // namespace abut::apps
