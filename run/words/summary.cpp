#include "abut/run/words/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/contact/report.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/files/json.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/words/bond_text.hpp"
#include "abut/run/words/erosion_text.hpp"
#include "abut/run/words/table_line.hpp"
#include "abut/run/words/verdict.hpp"
#include "abut/solid/fragments.hpp"

namespace abut::run {
namespace {

template <int Dim>
std::vector<double> numbers(const Vector<Dim>& vector) {
    return {vector.begin(), vector.end()};
}

/// Time in contact, search included, over the time of the bulk [-].
template <int Dim>
double contact_share(const RunResult<Dim>& result) {
    return (result.seconds.solid.contact + result.seconds.solid.search) / result.seconds.solid.bulk;
}

template <int Dim>
Json bodies_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    Json bodies = Json::array();
    for (std::size_t body = 0; body < result.bodies.start.size(); ++body)
        bodies.push_back(
            {{"name", scene.mesh.body_names[body]},
             {"mass", result.bodies.start[body].mass},
             {"velocity_initial", numbers<Dim>(result.bodies.start[body].velocity)},
             {"velocity_final", numbers<Dim>(result.bodies.end[body].velocity)},
             {"rotation_final", result.bodies.end[body].rotation},
             {"spin_initial",
              std::vector<double>(result.bodies.start[body].spin.begin(), result.bodies.start[body].spin.end())},
             {"spin_final", std::vector<double>(result.bodies.end[body].spin.begin(), result.bodies.end[body].spin.end())},
             {"local_rotation_final", result.bodies.local_rotations[body]},
             {"inertia_share", body < result.bodies.inertia.size() ? result.bodies.inertia[body].least() : 1.0}});
    return bodies;
}

Json pilot_json(const PilotReport& pilot) {
    Json bodies = Json::array();
    for (const PilotBody& body : pilot.bodies)
        bodies.push_back(
            {{"kinematics", name_of(body.picked)}, {"rotation", body.rotation}, {"strain_share", body.strain_share}});
    const auto seconds = [](double value) { return std::isnan(value) ? Json() : Json(value); };
    return {{"bodies", bodies},
            {"steps", pilot.steps},
            {"seconds", pilot.seconds},
            {"seconds_small", seconds(pilot.small)},
            {"seconds_floating", seconds(pilot.floating)},
            {"seconds_rigid", seconds(pilot.rigid)}};
}

Json settling_json(const SettlingReport& settling) {
    return {{"steps", settling.steps},
            {"rests", settling.rests},
            {"speed", settling.speed},
            {"dissipated", settling.dissipated},
            {"seconds", settling.seconds}};
}

template <int Dim>
Json seconds_json(const RunResult<Dim>& result) {
    const auto& seconds = result.seconds;
    return {{"total", seconds.total},
            {"mesh", seconds.mesh},
            {"setup", seconds.setup},
            {"bulk", result.seconds.solid.bulk},
            {"contact", result.seconds.solid.contact},
            {"search", result.seconds.solid.search},
            {"ledger", seconds.ledger},
            {"output", seconds.output},
            {"looks", seconds.looks}};
}

/// Nothing where parts stay as they are.
Json rebalancing_json(const Rebalancing& rebalancing) {
    if (rebalancing.looks == 0) return Json::object();
    Json done = Json::array();
    const auto number = [](double value) { return std::isnan(value) ? Json() : Json(value); };
    for (const Rebalance& one : rebalancing.done)
        done.push_back({{"step", one.step},
                        {"cells_moved", one.cells_moved},
                        {"imbalance_before", number(one.imbalance_before)},
                        {"imbalance_after", number(one.imbalance_after)},
                        {"seconds", one.seconds}});
    return {{"rebalancing", {{"looks", rebalancing.looks}, {"done", done}}}};
}

template <int Dim>
Json options_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const RunOptions& options = result.options;
    Json all = to_json(scene.options);
    if (std::isnan(options.time) && options.steps > 0)
        all["steps"] = options.steps;
    else
        all["time"] = std::isnan(options.time) ? scene.time : options.time;
    all.update(to_json(named_values(options)));
    all["skin"] = result.contact.skin;
    all["threads"] = result.run.threads;
    return all;
}

template <int Dim>
Json run_json(const RunResult<Dim>& result) {
    const auto& last = result.ledger.entries().back();
    return {{"steps", result.run.steps},
            {"complete", result.run.complete},
            {"resumed_after", result.run.resumed_after},
            {"dt", result.run.dt},
            {"stable_dt", result.run.stable.dt},
            {"dt_over_stable_dt", result.run.dt / result.run.stable.dt},
            {"finest_dt", result.run.finest_dt},
            {"level_cells", result.run.level_cells},
            {"force_evaluations", result.run.evaluations},
            {"time", last.time}};
}

template <int Dim>
Json energies_json(const RunResult<Dim>& result) {
    const auto& ledger = result.ledger;
    const auto number = [](double value) { return std::isnan(value) ? Json() : Json(value); };
    const auto if_kept = [&](double drift) { return result.energy.moments_from_outside.empty() ? Json(drift) : Json(); };
    return {{"kinetic_initial", ledger.entries().front().kinetic},
            {"energy_scale", {{"name", result.energy.scale.name}, {"value", result.energy.scale.value}}},
            {"pseudo_energy_drift", ledger.pseudo_energy_drift()},
            {"energy_drift", ledger.energy_drift()},
            {"energy_excess_max", ledger.energy_excess()},
            {"parasitic_max", ledger.parasitic()},
            {"fine_energy_max", result.energy.fine_max},
            {"energy_in_play", result.energy.accounts.energy_in_play},
            {"speed_max", result.energy.accounts.speed},
            {"forces_from_outside", result.energy.forces_from_outside},
            {"moments_from_outside", result.energy.moments_from_outside},
            {"momentum_drift_max", number(momentum_drift(result))},
            {"angular_momentum_drift_max", if_kept(ledger.angular_momentum_drift())},
            {"rest_angular_momentum_drift_max", if_kept(ledger.rest_angular_momentum_drift())},
            {"pseudo_angular_momentum_drift_max", if_kept(ledger.pseudo_angular_momentum_drift())},
            {"rotation_max", ledger.rotation()}};
}

Json mesh_json(const mesh::BuildReport& report, const mesh::UnjoinedFaces& unjoined) {
    return {{"unused_vertices", report.n_unused_vertices},
            {"ignored_elements", report.n_ignored_elements},
            {"coincident_vertices", report.n_coincident_vertices},
            {"unjoined_faces", unjoined.n_faces},
            {"non_planar_faces", report.n_non_planar_faces},
            {"cut_cells", report.n_cut_cells},
            {"turned_cells", report.n_turned_cells},
            {"worst_planarity", report.worst_planarity},
            {"warnings", report.warnings}};
}

template <int Dim>
Json restarts_json(const RunResult<Dim>& result) {
    const dynamics::RestartReport& restarts = result.ledger.entries().back().restarts;
    return {{"restarts", restarts.restarts},
            {"restarts_shortened", restarts.shortened},
            {"restarts_skipped", restarts.skipped},
            {"restart_paid", restarts.paid}};
}

template <int Dim>
Json counts_json(const RunResult<Dim>& result) {
    const auto& contact = result.contact.report;
    return {{"events", contact.events},
            {"active_pairs_max", contact.active_pairs_max},
            {"active_pairs_final", result.ledger.entries().back().active_pairs},
            {"missed_contacts", contact.missed_contacts},
            {"not_admitted_max", result.contact.inadmissible_overlaps_max},
            {"candidates", contact.candidates_max},
            {"rebuilds", contact.rebuilds},
            {"blind_corners", result.contact.blind_corners.size()},
            {"compression_max", contact.compression_max},
            {"sliding_ratio_max", contact.sliding_ratio_max},
            {"slipped_pairs", contact.slipped_pairs},
            {"slipped_compression_max", contact.slipped_compression_max},
            {"compressed_steps", contact.compressed_steps},
            {"tilted_pairs_max", contact.tilted_pairs_max},
            {"stencil_faces", result.bodies.stencils.faces},
            {"stencil_extrapolations", result.bodies.stencils.extrapolated},
            {"stencil_worst_weight", result.bodies.stencils.worst_weight},
            {"stencil_lowered_floor", result.bodies.stencils.lowered_floor},
            {"boundary_stencil_extrapolations", result.bodies.boundary_stencils.extrapolated},
            {"boundary_stencil_worst_weight", result.bodies.boundary_stencils.worst_weight}};
}

/// Nothing without friction.
template <int Dim>
Json friction_json(const RunResult<Dim>& result) {
    const contact::ContactReport& contact = result.contact.report;
    if (contact.sticking_faces_max + contact.sliding_faces_max == 0) return Json::object();
    const auto& last = result.ledger.entries().back();
    return {{"friction",
             {{"dissipated", last.losses.by_friction},
              {"energy", last.friction_energy},
              {"least_dissipated", contact.least_dissipated},
              {"sticking_faces_max", contact.sticking_faces_max},
              {"sliding_faces_max", contact.sliding_faces_max},
              {"force_over_limit_max", contact.friction_ratio_max},
              {"sliding_share", contact.sliding_limit > 0.0 ? Json(contact.sliding_force / contact.sliding_limit) : Json()},
              {"least_sliding_share", contact.sliding_limit > 0.0 ? Json(result.contact.sliding.least_share()) : Json()}}}};
}

/// Nothing where no material flows or is damped.
template <int Dim>
Json material_json(const RunResult<Dim>& result) {
    const dynamics::Losses& loss = result.energy.dissipated;
    Json json = Json::object();
    if (loss.in_cells + loss.in_jumps != 0.0)
        json["plasticity"] = {{"dissipated", loss.in_cells},
                              {"dissipated_in_jumps", loss.in_jumps},
                              {"dissipated_on_faces", loss.on_faces},
                              {"strain_max", result.bodies.finite.plastic_strain}};
    if (loss.by_damping != 0.0) json["damping"] = {{"dissipated", loss.by_damping}, {"lagged", loss.lagged}};
    if (loss.by_viscosity != 0.0) json["viscosity"] = {{"dissipated", loss.by_viscosity}};
    return json;
}

/// Nothing where no cell has left.
template <int Dim>
Json erosion_json(const RunResult<Dim>& result) {
    const ErosionReport<Dim>& erosion = result.erosion;
    if (erosion.cells.empty()) return Json::object();
    Json by = Json::object();
    for (const ErodedCount& count : eroded_counts(erosion.cells)) by[count.reason] = count.cells;
    const ErodedShares shares = eroded_shares(result);
    return {{"erosion",
             {{"cells", erosion.cells.size()},
              {"by", std::move(by)},
              {"mass", erosion.left.mass},
              {"kinetic", erosion.left.kinetic},
              {"potential", erosion.left.potential},
              {"momentum", numbers<Dim>(erosion.left.momentum)},
              {"mass_share", shares.mass},
              {"energy_share", shares.energy},
              {"first_time", erosion.cells.front().time},
              {"last_time", erosion.cells.back().time}}}};
}

/// Nothing without bonds.
template <int Dim>
Json bond_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    if (result.bonds.coverage.empty()) return Json::object();
    Json made = Json::array();
    for (std::size_t i = 0; i < result.bonds.coverage.size(); ++i) {
        const solid::BondCoverage& coverage = result.bonds.coverage[i];
        const auto& sides = scene.solid.bonds[i].sides;
        made.push_back({{"sides", {quoted_side(scene, sides[0]), quoted_side(scene, sides[1])}},
                        {"area", coverage.area},
                        {"opposite_area", coverage.opposite},
                        {"share", coverage.share()},
                        {"share_of_smaller_side", coverage.share_of_side()},
                        {"largest_gap", coverage.largest_gap}});
    }
    Json bonds = {{"made", std::move(made)}};
    if (result.energy.dissipated.in_bonds != 0.0) bonds["dissipated"] = result.energy.dissipated.in_bonds;
    if (result.energy.dissipated.at_splits != 0.0) bonds["dissipated_at_splits"] = result.energy.dissipated.at_splits;
    if (const double least = cohesive_length(result.bonds.coverage); std::isfinite(least)) bonds["cohesive_length"] = least;
    if (!result.bonds.fragments.empty()) bonds["broken_share"] = result.bonds.broken_share;
    if (const double beyond = result.bonds.beyond_fracture_energy; beyond != 0.0) bonds["beyond_fracture_energy"] = beyond;
    return {{"bonds", std::move(bonds)}};
}

/// Nothing where no bond may break.
template <int Dim>
Json fragments_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    if (result.bonds.fragments.empty()) return Json::object();
    Json rows = Json::array();
    for (const solid::Fragment<Dim>& fragment : result.bonds.fragments)
        rows.push_back({{"body", scene.mesh.body_names[static_cast<std::size_t>(fragment.bodies.front())]},
                        {"bodies", fragment.bodies.size()},
                        {"cells", fragment.n_cells},
                        {"mass", fragment.mass},
                        {"centre", numbers<Dim>(fragment.centre)},
                        {"velocity", numbers<Dim>(fragment.velocity)},
                        {"spin", std::vector<double>(fragment.spin.begin(), fragment.spin.end())}});
    return {{"fragments", std::move(rows)}};
}

/// Nothing where no bodies overlap on purpose.
template <int Dim>
Json interference_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    Json pairs = Json::array();
    for (std::size_t i = 0; i < result.contact.overlaps.size(); ++i) {
        const solid::BodyInterference& one = scene.solid.interference[i];
        pairs.push_back({{"bodies", {quoted_side(scene, one.bodies[0]), quoted_side(scene, one.bodies[1])}},
                         {"overlap", result.contact.overlaps[i]},
                         {"time", one.time}});
    }
    return pairs.empty() ? Json::object() : Json{{"interference", pairs}};
}

Json encounter_json(const Encounter& met) {
    if (met.body_1.empty()) return {};
    return {{"body_1", met.body_1},
            {"body_2", met.body_2},
            {"distance", met.distance},
            {"ratio", met.ratio},
            {"time", met.time}};
}

template <int Dim>
Json verdict_json(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const Verdict said = verdict(scene, result);
    Json warnings = Json::array();
    for (const Warning& warning : all_warnings(scene, result))
        warnings.push_back({{"severity", warning.severity == Severity::note ? "note" : "warning"}, {"text", warning.text}});
    return {{"verdict", {{"good", said.good}, {"text", said.text}}},
            {"warnings", warnings},
            {"surfaces",
             {{"looks", result.watch.looks.looks},
              {"deepest", encounter_json(result.watch.looks.deepest)},
              {"remote_contact", encounter_json(result.watch.looks.remote)},
              {"sliding_pressure", encounter_json(result.watch.looks.pressed)},
              {"nearest", encounter_json(result.watch.looks.nearest)}}}};
}

template <int Dim>
std::string velocity_text(const Vector<Dim>& velocity) {
    std::vector<std::string> parts;
    for (const double v : velocity) parts.push_back(fmt::format("{:+.6f}", v));
    return fmt::format("({})", fmt::join(parts, ", "));
}

std::string value_text(const Value& value) {
    const double* number = std::get_if<double>(&value);
    return number ? fmt::format("{:.6g}", *number) : text_of(to_json(value));
}

template <int Dim>
std::string energy_lines(const RunResult<Dim>& result) {
    const std::string& name = result.energy.scale.name;
    const dynamics::Ledger<Dim>& ledger = result.ledger;
    const auto over_scale = [&](double energy) { return fmt::format("{:.2e}", result.energy.scale.over(energy)); };
    const double momentum = momentum_drift(result);
    return table_line(fmt::format("drift of pseudo-energy, / {}", name), over_scale(ledger.pseudo_energy_drift())) +
           table_line(fmt::format("energy excess H - H~, / {}", name), over_scale(ledger.energy_excess())) +
           table_line("drift of linear momentum",
                      (std::isnan(momentum) ? "" : fmt::format("{:.2e} kg m/s", momentum)) + momentum_note(result)) +
           table_line("drift of angular momentum J~",
                      result.energy.moments_from_outside.empty()
                          ? fmt::format("{:.2e} kg m^2/s", ledger.pseudo_angular_momentum_drift())
                          : moment_note(result));
}

template <int Dim>
std::string contact_lines(const RunResult<Dim>& result) {
    const auto& contact = result.contact.report;
    return table_line("contact events, missed contacts", fmt::format("{}, {}", contact.events, contact.missed_contacts)) +
           table_line("compression of the skin, max |g|/D", fmt::format("{:.3g}", contact.compression_max));
}

/// Nothing where nothing is lost.
template <int Dim>
std::string loss_line(const RunResult<Dim>& result) {
    const dynamics::Losses& loss = result.energy.dissipated;
    std::vector<std::string> parts;
    const auto add = [&](const char* by, double energy) {
        if (energy != 0.0) parts.push_back(fmt::format("{} {:.3g}", by, result.energy.scale.over(energy)));
    };
    add("friction", result.ledger.entries().back().losses.by_friction);
    add("plastic flow", loss.in_cells + loss.in_jumps);
    add("damping", loss.by_damping);
    add("viscosity", loss.by_viscosity);
    add("broken bonds", loss.in_bonds);
    if (parts.empty()) return "";
    return table_line(fmt::format("dissipated, / {}", result.energy.scale.name), fmt::format("{}", fmt::join(parts, ", ")));
}

/// Nothing where bonds dissipated what they should.
template <int Dim>
std::string fracture_error_line(const RunResult<Dim>& result) {
    const double error = fracture_error(result.energy.dissipated.in_bonds, result.bonds.beyond_fracture_energy);
    if (!(error > large_fracture_error)) return "";
    return table_line("off their fracture energy",
                      fmt::format("bonds dissipated {} by {:.2g} of it",
                                  result.bonds.beyond_fracture_energy > 0.0 ? "more" : "less", error));
}

/// Nothing where no bond may break.
template <int Dim>
std::string fragment_line(const RunResult<Dim>& result) {
    if (result.bonds.fragments.empty()) return "";
    std::size_t bodies = 0;
    double all = 0.0, largest = 0.0;
    for (const solid::Fragment<Dim>& fragment : result.bonds.fragments) {
        bodies += fragment.bodies.size();
        all += fragment.mass;
        largest = std::max(largest, fragment.mass);
    }
    const double cohesive = cohesive_length(result.bonds.coverage);
    return table_line("fragments",
                      fmt::format("{} of {} bonded bodies, the largest {:.3g} of their mass; {:.3g} of the bonds broken",
                                  result.bonds.fragments.size(), bodies, largest / all, result.bonds.broken_share)) +
           (std::isfinite(cohesive) ? table_line("cohesive length of bonds", fmt::format("{:.3g} cells", cohesive)) : "") +
           fracture_error_line(result);
}

/// Bodies that were never bonded come first: those of fragments are many, and have their table in the summary.
template <int Dim>
std::vector<std::size_t> bodies_to_show(const RunResult<Dim>& result) {
    std::vector<char> is_in_fragment(result.bodies.end.size(), 0);
    for (const solid::Fragment<Dim>& fragment : result.bonds.fragments)
        for (const std::int32_t body : fragment.bodies) is_in_fragment[static_cast<std::size_t>(body)] = 1;
    std::vector<std::size_t> order(result.bodies.end.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_partition(order, [&](std::size_t body) { return is_in_fragment[body] == 0; });
    return order;
}

template <int Dim>
std::string body_lines(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    constexpr std::size_t most = 5;
    std::string text;
    const std::vector<std::size_t> bodies = bodies_to_show(result);
    for (const std::size_t body : std::span(bodies).first(std::min(bodies.size(), most)))
        text += table_line(fmt::format("velocity of '{}'", scene.mesh.body_names[body]),
                           fmt::format("{} -> {} m/s", velocity_text<Dim>(result.bodies.start[body].velocity),
                                       velocity_text<Dim>(result.bodies.end[body].velocity)));
    if (bodies.size() > most)
        text += table_line("", "and of " + counted(static_cast<std::int64_t>(bodies.size() - most), "more body"));
    return text;
}

}  // namespace

template <int Dim>
std::string summary_json(const std::string& program, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    Json json = {{"program", program},
                 {"version", ABUT_VERSION},
                 {"dim", Dim},
                 {"cells", scene.mesh.n_cells()},
                 {"boundary_faces", scene.mesh.boundary_faces.size()}};
    if (!scene.title.empty()) json["title"] = scene.title;
    if (!scene.comment.empty()) json["comment"] = scene.comment;
    json.update(run_json(result));
    json.update(energies_json(result));
    json.update(restarts_json(result));
    json.update(counts_json(result));
    json.update(friction_json(result));
    json.update(material_json(result));
    json.update(erosion_json(result));
    json.update(bond_json(scene, result));
    json.update(fragments_json(scene, result));
    json.update(interference_json(scene, result));
    for (const Finding& finding : result.watch.findings) json[finding.key] = to_json(finding.value);
    if (result.run.pilot) json["pilot"] = pilot_json(*result.run.pilot);
    if (result.run.settling) json["settling"] = settling_json(*result.run.settling);
    json.update({{"mesh", mesh_json(scene.mesh.report, result.bodies.unjoined)},
                 {"bodies", bodies_json(scene, result)},
                 {"seconds", seconds_json(result)},
                 {"contact_share", contact_share(result)},
                 {"options", options_json(scene, result)}});
    json.update(rebalancing_json(result.rebalancing));
    json.update(verdict_json(scene, result));
    return text_of(json, 2) + "\n";
}

template <int Dim>
std::string closing_table(const std::string& program, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::string text = fmt::format("{}: {}\n", program, verdict(scene, result).text);
    text += table_line("steps", fmt::format("{} of {:.4g} s, {}{:.3g} of the stable step, in {:.1f} s", result.run.steps,
                                            result.run.dt, result.run.level_cells.empty() ? "" : "the finest ",
                                            result.run.finest_dt / result.run.stable.dt, result.seconds.total));
    if (!result.run.level_cells.empty())
        text += table_line("cells that step with dt, dt/2, ...", fmt::format("{}", fmt::join(result.run.level_cells, ", ")));
    if (!result.run.complete)
        text += table_line("asked to stop before the end", fmt::format("t = {:.4g} s", result.ledger.entries().back().time));
    if (result.run.settling)
        text += table_line(
            "brought to rest before the start",
            fmt::format("in {}, to {:.2g} m/s", counted(result.run.settling->steps, "step"), result.run.settling->speed));
    if (result.run.resumed_after > 0)
        text += table_line("gone on from a checkpoint", fmt::format("after step {}", result.run.resumed_after));
    text += energy_lines(result) + loss_line(result);
    if (const std::string eroded = erosion_text(result); !eroded.empty()) text += table_line("left by erosion", eroded);
    text += contact_lines(result);
    for (const Finding& finding : result.watch.findings) text += table_line(finding.text, value_text(finding.value));
    return text + fragment_line(result) + body_lines(scene, result);
}

#define ABUT_INSTANTIATE(Dim)                                                                             \
    template std::string summary_json<Dim>(const std::string&, const Scene<Dim>&, const RunResult<Dim>&); \
    template std::string closing_table<Dim>(const std::string&, const Scene<Dim>&, const RunResult<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
