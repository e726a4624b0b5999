#include "abut/run/option_table.hpp"

#include <algorithm>
#include <cmath>

#include "abut/contact/option_table.hpp"
#include "abut/dynamics/step_options.hpp"
#include "abut/solid/options/option_words.hpp"

namespace abut::run {
namespace {

using Of = RunOptions;
using List = OptionList<RunOptions>;

/// Where scenes and help texts show them, unless they say so themselves.
List in(const char* table, const char* group, List options) {
    for (Option<Of>& option : options) {
        option.table = option.depth == OptionDepth::laboratory ? "laboratory" : table;
        if (option.group.empty()) option.group = group;
    }
    return options;
}

List of_time() {
    const Limits a_time{.unit = "s", .above = 0.0};
    const auto of_step = [](const char* name) -> OptionTraits { return named(dynamics::step_options(), name); };
    const std::vector<std::string> memm{"memm"}, memm_async{"memm_async"}, bilbao{"bilbao"};
    const std::vector<std::string> single_step{"memm", "leapfrog"};
    return {
        option("time", &Of::time,
               {.help = "end of the run", .limits = a_time, .named = Named::never, .depth = OptionDepth::everyday}),
        option("steps", &Of::steps,
               {.help = "steps of the run where no time is given; 0: as many as the time takes", .named = Named::never}),
        option(
            "settle", &Of::settle,
            {.help = "bring the bodies to rest under the loads of t = 0 before the run begins, with their friction; their "
                     "velocities come after that",
             .named = Named::changed,
             .depth = OptionDepth::everyday}),
        option("cfl", &Of::cfl, of_step("cfl")),
        option("dt", &Of::dt, of_step("dt")),
        option("allow_unstable", &Of::allow_unstable, {.help = "take dt even above the stable step", .named = Named::never}),
        choice("integrator", &Of::integrator, integrator_words,
               {.help = "scheme in time (docs/integrators.md)", .depth = OptionDepth::everyday}),
        option("levels", &Of::levels,
               {.help = "of memm_async: different steps at most, each half the one before; 0: 8",
                .schemes = memm_async,
                .named = Named::with_scheme,
                .depth = OptionDepth::laboratory}),
        option("contact_margin", &Of::contact_margin,
               {.help = "of memm_async: how often the steps of cells in contact are halved more than they need, down to the "
                        "shortest",
                .schemes = memm_async,
                .named = Named::with_scheme,
                .depth = OptionDepth::laboratory}),
        option(
            "contact_levels", &Of::contact_levels,
            {.help = "of memm_async: how often the steps of cells in contact are halved beyond the shortest of the others",
             .schemes = memm_async,
             .named = Named::with_scheme,
             .depth = OptionDepth::laboratory}),
        option("gauge", &Of::gauge,
               {.help = "c of the Bilbao scheme; by default the energy at the start, from rest twice that of the fall",
                .limits = {.unit = "J", .above = 0.0},
                .schemes = bilbao,
                .named = Named::with_scheme,
                .depth = OptionDepth::laboratory}),
        choice("precision", &Of::precision, solid::precision_words,
               {.help = "of the bulk in steps of memm and leapfrog: single is less exact (docs/trade.md); contact is always "
                        "double",
                .schemes = single_step,
                .depth = OptionDepth::laboratory}),
        choice("device", &Of::device, solid::device_words,
               {.help = "of the bulk in steps of memm and leapfrog: kokkos is what Kokkos was built for, a GPU or the host "
                        "(docs/devices.md); the results are the same",
                .schemes = single_step,
                .free_on_resume = true}),
        choice("filter", &Of::filter, filter_words,
               {.help = "energy-neutral filter of the parasitic mode, after each step in contact", .schemes = memm}),
        option("restart", &Of::restart, of_step("restart")),
        choice(
            "kinematics", &Of::kinematics, kinematics_words,
            {.help = "of all bodies: small for those that do not turn, floating frames, finite (they bend), rigid, as the "
                     "scene says, or automatic: small, floating or rigid by what a run with rigid bodies shows",
             .group = "Contact",
             .depth = OptionDepth::everyday}),
        choice(
            "mean_force", &Of::mean_force, solid::mean_force_words,
            {.help =
                 "of a step inside finite bodies: automatic is closed_trapezoid, the mean of the forces at both ends with "
                 "what closes energy and moment of the body; trapezoid leaves that out; discrete_gradient is exact cell by "
                 "cell and feeds noise (docs/limits.md)",
             .schemes = memm,
             .named = Named::changed,
             .group = "Contact",
             .depth = OptionDepth::laboratory}),
        option("threads", &Of::threads,
               {.help = "threads, of each rank where there are several; 0: all. The results do not depend on it",
                .named = Named::never,
                .free_on_resume = true,
                .group = "Output",
                .depth = OptionDepth::everyday}),
        option("ranks", &Of::ranks,
               {.help = "ranks that the scene is shared out to, on this machine; 0: one, or those that mpirun has started. "
                        "The results do not depend on it",
                .named = Named::never,
                .places = {.scene = false, .python = false},
                .free_on_resume = true,
                .group = "Output",
                .depth = OptionDepth::everyday}),
        option("rebalance", &Of::rebalance,
               {.help = "of several ranks: steps from one look at what their cells cost each of them to the next; 0: each "
                        "keeps its cells. The results do not depend on it",
                .named = Named::never,
                .places = {.python = false},
                .free_on_resume = true,
                .group = "Output"}),
        option("rebalance_above", &Of::rebalance_above,
               {.help = "cells are shared out again where they cost one rank so many times the mean; 1: at each look",
                .limits = {.above = 1.0, .from = true},
                .named = Named::never,
                .places = {.python = false},
                .free_on_resume = true,
                .group = "Output"})};
}

List of_contact() {
    List options = {
        choice("law", &Of::law, solid::law_words,
               {.help = "of contact: the modified reconstruction for bodies that do not turn; the pair potential "
                        "for all, and by default",
                .depth = OptionDepth::everyday})};
    const auto append = [&](const List& more) { options.insert(options.end(), more.begin(), more.end()); };
    append(within(&Of::contact, contact::contact_options()));
    append(within(&Of::friction, contact::friction_options()));
    append(within(&Of::facing, contact::facing_options()));
    append(contact::path_options<Of>());
    append(
        {choice("free_faces", &Of::free_faces, solid::free_face_words,
                {.help = "displacement of free faces; extrapolate and adjacent are there for comparison",
                 .shapes_rest = true,
                 .depth = OptionDepth::laboratory}),
         choice("corners", &Of::corners, solid::corner_words,
                {.help = "free faces of a cell beside one in contact: relaxed keeps them in balance, fixed is for cavities "
                         "that press on two sides",
                 .shapes_rest = true,
                 .depth = OptionDepth::laboratory})});
    return options;
}

List of_output() {
    return {
        option("out", &Of::out,
               {.help = "folder of all results, from where the program is started; made if it is not there, refused while "
                        "another run has it",
                .by_default = "out/<scene>",
                .free_on_resume = true,
                .depth = OptionDepth::everyday}),
        option("interval", &Of::interval,
               {.help = "steps between two records of the energies; 0: as many as make 200 to 2,000, in 3D at least 10"}),
        option("frames", &Of::frames,
               {.help = "frames for ParaView, first and last included; 0: none", .depth = OptionDepth::everyday}),
        option("times", &Of::times,
               {.help = "of frames, in place of `frames`: exactly then, on the straight path inside a step, which stays as "
                        "it is",
                .limits = {.unit = "s", .above = 0.0, .from = true},
                .by_default = "none",
                .named = Named::changed,
                .free_on_resume = true,
                .depth = OptionDepth::everyday}),
        choice(
            "format", &Of::format, format_words,
            {.help = "of frames: vtu, a file for each, or xdmf, one .h5 file for all with .xmf beside it (not with pieces)",
             .named = Named::changed}),
        option("animation", &Of::animation,
               {.help = "frames of animation.html, the run as a film in a browser, first and last included; 0: no film",
                .named = Named::changed,
                .depth = OptionDepth::everyday}),
        option("pieces", &Of::pieces,
               {.help = "each rank writes its own cells of a frame (.pvtu names the pieces); else rank 0 writes the whole",
                .named = Named::changed}),
        option("checkpoint", &Of::checkpoint,
               {.help = "time from one checkpoint to the next; at SIGINT, SIGTERM and SIGHUP there is one, too; 0: none at "
                        "all",
                .limits = {.unit = "min", .above = 0.0, .zero = true, .remedy = "Give minutes, or 0 for no checkpoints."},
                .named = Named::never,
                .depth = OptionDepth::everyday}),
        option("checkpoint_steps", &Of::checkpoint_steps,
               {.help = "steps from one checkpoint to the next, beside that; 0: by minutes alone", .named = Named::never}),
        option("keep_last_checkpoint", &Of::keep_last_checkpoint,
               {.help = "a run that comes to its end keeps its last state: abut restart DIR --until TIME goes on from there",
                .named = Named::never}),
        option("resume", &Of::resume,
               {.help = "goes on from the last checkpoint in the folder of results; by default a run begins at its start",
                .named = Named::never,
                .places = {.scene = false},
                .depth = OptionDepth::everyday})};
}

}  // namespace

const OptionList<RunOptions>& run_options() {
    static const List options = [] {
        List all = in("run", "Time", of_time());
        for (List more : {in("contact", "Contact", of_contact()), in("output", "Output", of_output())})
            all.insert(all.end(), more.begin(), more.end());
        return all;
    }();
    return options;
}

Value value_of(const OptionFacts& option, const OptionValue& value) {
    if (option.is_switch) return abut::text_of(value);
    return std::visit([](const auto& held) { return Value(held); }, value);
}

bool is_named(const OptionFacts& option, const OptionValue& value, const OptionValue& by_default,
              const std::string& scheme) {
    const auto* number = std::get_if<double>(&value);
    switch (option.named) {
        case Named::always:
            return true;
        case Named::changed:
            return !is_same(value, by_default);
        case Named::with_scheme:
            return std::ranges::find(option.schemes, scheme) != option.schemes.end() && !(number && std::isnan(*number));
        case Named::never:
            return false;
    }
    return false;
}

NamedValues model_values(const RunOptions& options) {
    NamedValues values;
    for (const Option<RunOptions>& option : run_options())
        if (option.shapes_rest) values.push_back({option.name, value_of(option, option.get(options))});
    return values;
}

NamedValues named_values(const RunOptions& options) {
    NamedValues values;
    if (std::isnan(options.dt))
        values = {{"cfl", options.cfl}};
    else
        values = {{"dt", options.dt}, {"allow_unstable", options.allow_unstable}};
    const NamedValues more = named_values(run_options(), options, name_of(options.integrator));
    values.insert(values.end(), more.begin(), more.end());
    return values;
}

}  // namespace abut::run
