#include "abut/run/report/report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "abut/run/body_names.hpp"
#include "abut/run/drawing/style.hpp"
#include "abut/run/option_table.hpp"
#include "abut/run/report/body_pictures.hpp"
#include "abut/run/report/curves.hpp"
#include "abut/run/report/figures.hpp"
#include "abut/run/report/watched.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/verdict.hpp"
#include "abut/run/words/warnings.hpp"
#include "abut/solid/fragments.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/material/material_numbers.hpp"

namespace abut::run {
namespace {

Markup section(const std::string& heading, const Markup& content) {
    return content.empty() ? Markup() : element("section", element("h2", heading) + "\n" + content) + "\n";
}

template <int Dim>
Markup heading(const std::string& program, const Figures& figures, const RunResult<Dim>& result) {
    const Markup line = "Abut " + figures.at("version") + ", " + figures.at("dim") + "D: " + figures.at("cells") +
                        " cells, " + figures.at("boundary_faces") + " boundary faces; " + figures.at("steps") +
                        " steps of " + figures.at("dt") + " s, " + figures.at("dt_over_stable_dt") +
                        " of the stable one, to t = " + figures.at("time") + " s; " + name_of(result.options.integrator) +
                        ".";
    const auto now = std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
    const Markup comment = figures.summary().contains("comment")
                               ? element("p", {{"class", "comment"}}, figures.at("comment")) + "\n"
                               : Markup();
    return element("h1", figures.summary().contains("title") ? figures.at("title") : program) + "\n" + comment +
           element("p", {{"class", "faint"}}, line) + "\n" +
           element("p", {{"class", "faint"}}, fmt::format("Ended {:%Y-%m-%d %H:%M} UTC.", fmt::gmtime(now))) + "\n";
}

template <int Dim>
Markup verdict_part(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const Verdict said = verdict(scene, result);
    return element("p", {{"class", said.good ? "good" : "attention"}}, said.text) + "\n";
}

Markup warnings_part(const std::vector<Warning>& warnings) {
    Markup serious, notes;
    for (const Warning& warning : warnings) {
        const Markup item = element("li", warning.text) + "\n";
        (warning.severity == Severity::warning ? serious : notes) += item;
    }
    const auto list = [](const Markup& items) { return items.empty() ? items : element("ul", items) + "\n"; };
    return section("Warnings", list(serious)) + section("Good to know", list(notes));
}

Markup pictures_part(const BodyPictures& pictures) {
    const Markup drawn = body_pictures(pictures);
    if (drawn.empty()) return {};
    return section(
        "Pictures",
        drawn + element("p", {{"class", "faint"}},
                        "Bodies are where they were, displacements to scale, all in the same view and the same colours; "
                        "what is above the end of the colours has the last one. Obstacles, and rigid bodies among others, "
                        "are grey. Faces that are held have orange edges; those under a traction have pink ones, and arrows "
                        "whose length shows how large it is. Springs are zigzags, hinges rings."));
}

/// A row of a table of figures with units.
Markup figure_row(const Figures& figures, const char* what, const char* path, const char* unit) {
    return row({what, figures.at(path) + " " + unit});
}

template <int Dim>
Markup energies_part(const Figures& figures, const RunResult<Dim>& result) {
    const auto energy = [&](const char* what, const char* path) {
        return row({what, figures.at(path) + " J", figures.over(path, result.energy.scale)});
    };
    const Markup numbers = table(
        {"greatest of the run", "", "over " + result.energy.scale.name},
        {row({"kinetic energy at the start", figures.at("kinetic_initial") + " J", ""}),
         row({"scale of energies, " + result.energy.scale.name, figures.at("energy_scale.value") + " J", ""}),
         energy("drift of the pseudo-energy, |H~ - H~0 - W|", "pseudo_energy_drift"),
         energy("error of the energy, |H - H0 - W|", "energy_drift"), energy("excess H - H~", "energy_excess_max"),
         row({"parasitic mode, |e|/m", figures.at("parasitic_max") + " m/s", ""}),
         row({"drift of momentum", figures.at("momentum_drift_max") + " kg m/s", momentum_note(result)}),
         row({"drift of angular momentum", figures.at("angular_momentum_drift_max") + " kg m²/s", moment_note(result)}),
         row({"the same of J~, as MEMM has it", figures.at("pseudo_angular_momentum_drift_max") + " kg m²/s",
              moment_note(result)})});
    return section("Energies", energy_pictures(result) + numbers);
}

template <int Dim>
Markup erosion_part(const Figures& figures) {
    const char *mass = Dim == 2 ? "kg/m" : "kg", *energy = Dim == 2 ? "J/m" : "J";
    if (!figures.summary().contains("erosion")) return {};
    return section("Erosion",
                   table({"", ""}, {figure_row(figures, "cells that left", "erosion.cells", ""),
                                    figure_row(figures, "their mass", "erosion.mass", mass),
                                    figure_row(figures, "share of the mass at the start", "erosion.mass_share", ""),
                                    figure_row(figures, "kinetic energy that they took along", "erosion.kinetic", energy),
                                    figure_row(figures, "change of V as they left", "erosion.potential", energy),
                                    figure_row(figures, "share of the energy in play", "erosion.energy_share", ""),
                                    figure_row(figures, "the first left at", "erosion.first_time", "s"),
                                    figure_row(figures, "the last left at", "erosion.last_time", "s")}));
}

template <int Dim>
Markup bodies_part(const Figures& figures, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::vector<Markup> rows;
    for (std::size_t body = 0; body < result.bodies.start.size(); ++body) {
        const auto at = [&](const char* key) { return figures.at(fmt::format("bodies.{}.{}", body, key)); };
        const auto cells = std::ranges::count(scene.mesh.cell_body, static_cast<std::int32_t>(body));
        rows.push_back(row({at("name"), name_of(kinematics_of(scene, result, body)), fmt::format("{}", cells), at("mass"),
                            at("velocity_initial"), at("velocity_final"), at("spin_initial"), at("spin_final"),
                            at("rotation_final"), at("inertia_share")}));
    }
    return section("Bodies", table({"body", "moves as", "cells", Dim == 2 ? "mass [kg/m]" : "mass [kg]",
                                    "velocity at the start [m/s]", "at the end [m/s]", "spin at the start [rad/s]",
                                    "at the end [rad/s]", "turned by [rad]", "I of its points over I, least"},
                                   rows));
}

/// Figures of a material, and its law where the body has it.
std::vector<std::string> said_of(const solid::Material& material, bool is_finite) {
    const bool yields = material.law == solid::MaterialLaw::j2;
    std::string law =
        is_finite || yields || !material.is_isotropic() ? word_of(solid::material_law_words, material.law) : "";
    if (is_finite && material.law == solid::MaterialLaw::mooney_rivlin)
        law += fmt::format(", share {:g}", material.second_share);
    if (const solid::Orthotropy& of = material.orthotropic; !material.is_isotropic())
        law +=
            fmt::format(", E {:g}, {:g}, {:g}, nu {:g}, {:g}, {:g}, G {:g}, {:g}, {:g}", material.young, of.young_2,
                        of.young_3, material.poisson, of.poisson_13, of.poisson_23, of.shear_12, of.shear_13, of.shear_23);
    if (yields)
        law += fmt::format(", yields at {:g} Pa{}", material.flow.yield_stress,
                           material.flow.knows_rates() ? ", faster flow at more" : "");
    const auto add = [&law](double value, const char* format) {
        if (value > 0.0) law += fmt::format(fmt::runtime(law.empty() ? format + 2 : format), value);
    };
    add(material.damping.mass, ", drag {:g} 1/s");
    add(material.damping.stiffness, ", damped by {:g} s");
    add(material.damping.linear_viscosity, ", linear viscosity {:g}");
    add(material.damping.quadratic_viscosity, ", quadratic viscosity {:g}");
    return {fmt::format("{:g}", material.young), fmt::format("{:g}", material.poisson),
            fmt::format("{:g}", material.density),
            fmt::format("{:.4g}", std::sqrt(material.wave_modulus() / material.density)), law};
}

/// Bodies of one material in one row.
template <int Dim>
Markup materials_part(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::vector<std::pair<std::vector<std::string>, std::string>> of_bodies;
    for (std::size_t body = 0; body < result.bodies.start.size(); ++body) {
        const bool is_finite = solid::properties_of(kinematics_of(scene, result, body)).finite_strains;
        const std::vector<std::string> said = said_of(scene.solid.materials[body], is_finite);
        const auto known = std::ranges::find_if(of_bodies, [&](const auto& other) { return other.first == said; });
        if (known == of_bodies.end())
            of_bodies.emplace_back(said, scene.mesh.body_names[body]);
        else
            known->second += ", " + scene.mesh.body_names[body];
    }
    std::vector<Markup> rows;
    for (const auto& [said, names] : of_bodies) {
        std::vector<Markup> cells{names};
        cells.insert(cells.end(), said.begin(), said.end());
        rows.push_back(row(cells));
    }
    return section("Materials", table({"bodies", "Young's modulus [Pa]", "Poisson's ratio", "density [kg/m³]",
                                       "speed of waves of compression [m/s]", "at large strains"},
                                      rows));
}

template <int Dim>
Markup contact_part(const Figures& figures, const Scene<Dim>& scene, const RunResult<Dim>& result,
                    const ReportSources& sources) {
    if (!scene.contact) return section("Contact", element("p", "Bodies pass through each other: contact is off."));
    const std::int64_t interval = scene.outputs.interval > 0 ? scene.outputs.interval : result.options.interval;
    const Markup forces =
        sources.forces.empty()
            ? Markup()
            : force_pictures(sources.forces, {.steps = result.run.steps, .interval = interval, .dt = result.run.dt});
    return section("Contact",
                   contact_picture(result) + forces +
                       table({"", ""}, {figure_row(figures, "openings, closings and slips within steps", "events", ""),
                                        figure_row(figures, "pairs in contact, at most", "active_pairs_max", ""),
                                        figure_row(figures, "pairs in contact, at the end", "active_pairs_final", ""),
                                        figure_row(figures, "missed contacts: 0 is right", "missed_contacts", ""),
                                        figure_row(figures, "deepest contact, |g|/D of its cells", "compression_max", ""),
                                        figure_row(figures, "steps that were strongly compressed", "compressed_steps", ""),
                                        figure_row(figures, "sliding over pressing, at most", "sliding_ratio_max", ""),
                                        figure_row(figures, "pairs that slid off each other", "slipped_pairs", ""),
                                        figure_row(figures, "candidates, at most", "candidates", ""),
                                        figure_row(figures, "lists of candidates", "rebuilds", "")}));
}

template <int Dim>
Markup probes_part(const Scene<Dim>& scene, const ReportSources& sources) {
    if (sources.probes.empty()) return {};
    std::vector<std::string> names;
    for (const Probe<Dim>& probe : scene.outputs.probes) names.push_back(probe.name);
    return section("Probes", probe_pictures(sources.probes, names));
}

/// A law of friction in words.
std::string in_words(const contact::Friction& law) {
    if (law.own_coefficient) return "a coefficient of its own";
    std::string text;
    if (law.coefficient > 0.0 || law.sliding_coefficient > 0.0) text = fmt::format("coefficient {:g}", law.coefficient);
    if (std::isfinite(law.sliding_coefficient)) text += fmt::format(", {:g} when sliding", law.sliding_coefficient);
    if (std::isfinite(law.decay_speed)) text += fmt::format(", where that falls by 1/e per {:g} m/s", law.decay_speed);
    if (std::isfinite(law.decay_slip)) text += fmt::format(", where that falls over a path of {:g} m", law.decay_slip);
    if (law.strength > 0.0) text += fmt::format("{}strength {:g} Pa", text.empty() ? "" : ", ", law.strength);
    if (std::isfinite(law.relaxation_time)) text += fmt::format(", relaxes in {:g} s", law.relaxation_time);
    return text.empty() ? "none" : text;
}

/// Who rubs on whom, and how.
template <int Dim>
Markup friction_laws(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const contact::Friction& of_all = result.options.friction;
    std::vector<Markup> rows;
    for (const solid::BodyFriction& pair : scene.solid.body_friction)
        rows.push_back(
            row({quoted_side(scene, pair.bodies[0]) + ", " + quoted_side(scene, pair.bodies[1]), in_words(pair.law)}));
    if (of_all.acts()) rows.push_back(row({rows.empty() ? "all" : "all others", in_words(of_all)}));
    return table({"between", "friction"}, rows);
}

/// Nothing without friction.
template <int Dim>
Markup friction_part(const Figures& figures, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    if (!figures.summary().contains("friction")) return {};
    return section(
        "Friction",
        friction_laws(scene, result) +
            table({"", ""}, {figure_row(figures, "dissipated", "friction.dissipated", "J"),
                             figure_row(figures, "held by faces that stick", "friction.energy", "J"),
                             figure_row(figures, "faces that stick, at most", "friction.sticking_faces_max", ""),
                             figure_row(figures, "faces that slide, at most", "friction.sliding_faces_max", ""),
                             figure_row(figures, "force of sliding faces over its limit", "friction.sliding_share", ""),
                             figure_row(figures, "the least of a part of the run", "friction.least_sliding_share", "")}));
}

/// Nothing without a material that flows.
Markup plasticity_part(const Figures& figures) {
    if (!figures.summary().contains("plasticity")) return {};
    return section(
        "Plastic flow",
        table({"", ""}, {figure_row(figures, "dissipated", "plasticity.dissipated", "J"),
                         figure_row(figures, "in jumps between cells", "plasticity.dissipated_in_jumps", "J"),
                         figure_row(figures, "by free faces that flow along", "plasticity.dissipated_on_faces", "J"),
                         figure_row(figures, "largest plastic strain", "plasticity.strain_max", "")}));
}

/// Nothing without a material that is damped.
Markup damping_part(const Figures& figures) {
    std::vector<Markup> rows;
    if (figures.summary().contains("damping"))
        rows = {figure_row(figures, "dissipated by damping", "damping.dissipated", "J"),
                figure_row(figures, "held in the lag of a step", "damping.lagged", "J")};
    if (figures.summary().contains("viscosity"))
        rows.push_back(figure_row(figures, "dissipated by viscosity", "viscosity.dissipated", "J"));
    return rows.empty() ? Markup() : section("Damping and viscosity", table({"", ""}, rows));
}

/// Nothing without bonds.
template <int Dim>
Markup bonds_part(const Figures& figures, const Scene<Dim>& scene) {
    std::vector<Markup> rows;
    for (std::size_t i = 0; i < scene.solid.bonds.size(); ++i) {
        const solid::Bond& bond = scene.solid.bonds[i];
        const auto figure = [&](const char* key) { return figures.at(fmt::format("bonds.made.{}.{}", i, key)); };
        rows.push_back(row({quoted_side(scene, bond.sides[0]) + ", " + quoted_side(scene, bond.sides[1]),
                            std::isfinite(bond.strength) ? fmt::format("{:g} Pa", bond.strength) : "for ever",
                            figure("area"), figure("share"), figure("share_of_smaller_side"), figure("largest_gap")}));
    }
    if (rows.empty()) return {};
    Markup bonds = table({"bond between", "holds up to", Dim == 2 ? "bonded [m]" : "bonded [m^2]", "of what lies opposite",
                          "of the smaller side", "largest gap [m]"},
                         rows);
    if (figures.summary().at("bonds").contains("dissipated"))
        bonds += table({"", ""}, {figure_row(figures, "dissipated by those that opened or broke", "bonds.dissipated", "J")});
    if (figures.summary().at("bonds").contains("beyond_fracture_energy"))
        bonds += table({"", ""},
                       {figure_row(figures, "of this beyond their fracture energy", "bonds.beyond_fracture_energy", "J")});
    return section("Bonds", bonds);
}

/// Nothing where no bond may break.
template <int Dim>
Markup fragments_part(const Figures& figures, const RunResult<Dim>& result) {
    std::vector<Markup> rows;
    for (std::size_t i = 0; i < result.bonds.fragments.size(); ++i) {
        const auto figure = [&](const char* key) { return figures.at(fmt::format("fragments.{}.{}", i, key)); };
        rows.push_back(row({figure("body"), figure("bodies"), figure("cells"), figure("mass"), figure("centre"),
                            figure("velocity"), figure("spin")}));
    }
    if (rows.empty()) return {};
    return section("Fragments",
                   table({"", ""}, {figure_row(figures, "share of bonds that is broken", "bonds.broken_share", "")}) +
                       table({"first body", "bodies", "cells", Dim == 2 ? "mass [kg/m]" : "mass [kg]", "centre [m]",
                              "velocity [m/s]", "spin [rad/s]"},
                             rows));
}

Markup findings_part(const Figures& figures, const std::vector<Finding>& findings) {
    std::vector<Markup> rows;
    for (const Finding& finding : findings) rows.push_back(row({finding.text, figures.at(finding.key)}));
    return section("Found by the scene", table({"", ""}, rows));
}

/// Settings in three parts: those of the scene and this run alone, those that are not as by default, and the rest.
template <int Dim>
Markup settings_part(const Figures& figures, const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const Json by_default = to_json(named_values(with_defaults<Dim>(with_restart<Dim>({}, scene))));
    const Json own = to_json(scene.options);
    std::vector<Markup> of_scene, changed, plain;
    for (const auto& [name, value] : figures.summary().at("options").items()) {
        const Markup shown_value = figures.at("options." + name);
        const bool chosen_by_run =
            (name == "skin" && result.options.contact.search.skin == 0.0) ||
            (name == "interval" &&
             result.options.interval == records_interval<Dim>(result.run.steps, result.options.restart)) ||
            (name == "threads" && result.options.threads == 0) ||
            (name == "law" && result.contact.asked_law == solid::ContactLaw::automatic);
        if (own.contains(name) || name == "time" || name == "steps" || name == "out")
            of_scene.push_back(row({name, shown_value}));
        else if (chosen_by_run || (by_default.contains(name) && by_default.at(name) == value))
            plain.push_back(row({name, shown_value}));
        else
            changed.push_back(row({name, shown_value, by_default.contains(name) ? shown(by_default.at(name)) : ""}));
    }
    return section("Settings", table({"of the scene", "value"}, of_scene) +
                                   table({"not as by default", "value", "by default"}, changed) +
                                   element("details", element("summary", "As by default, or chosen by the run") +
                                                          table({"setting", "value"}, plain)));
}

Markup seconds_part(const Figures& figures) {
    const double total = figures.number("seconds.total");
    std::vector<Markup> rows;
    for (const auto& [name, value] : figures.summary().at("seconds").items()) {
        if (name == "total") continue;
        const double share = 100.0 * value.get<double>() / total;
        const Markup bar = element(
            "span", {{"class", "bar"}, {"style", fmt::format("width:{:.1f}em", 0.15 * std::clamp(share, 0.0, 100.0))}});
        rows.push_back(row({name, figures.at("seconds." + name, true), fmt::format("{:.1f} %", share), bar}));
    }
    rows.push_back(row({"total", figures.at("seconds.total", true), "", ""}));
    return section("Time of the run", table({"part", "seconds", "share", ""}, rows));
}

/// A name as an address within the folder: everything that means something there by its number.
std::string address(const std::string& name) {
    std::string result = "./";
    for (const char c : name) {
        const bool plain =
            (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
        result += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return result;
}

Markup files_part(const std::vector<ReportFile>& files) {
    std::vector<Markup> rows;
    for (const auto& [name, meaning] : files) rows.push_back(row({element("a", {{"href", address(name)}}, name), meaning}));
    return section("Files", table({"file", ""}, rows));
}

Markup page(const std::string& title, const Markup& body) {
    const Markup head = element("meta", Attributes{{"charset", "utf-8"}}) +
                        element("meta", Attributes{{"name", "viewport"}, {"content", "width=device-width"}}) +
                        element("title", title) + element("style", report_style);
    return element("html", {{"xmlns", "http://www.w3.org/1999/xhtml"}, {"lang", "en"}},
                   element("head", head) + "\n" + element("body", "\n" + body));
}

}  // namespace

template <int Dim>
std::string report_html(const std::string& program, const Scene<Dim>& scene, const RunResult<Dim>& result,
                        const std::vector<ReportFile>& files, const ReportSources& sources) {
    const Figures figures(Json::parse(summary_json(program, scene, result)));
    const std::vector<Warning> warnings = all_warnings(scene, result);
    const Markup body = heading(program, figures, result) + verdict_part(scene, result) +
                        (sources.pictures ? pictures_part(*sources.pictures) : Markup()) + warnings_part(warnings) +
                        energies_part(figures, result) + bodies_part(figures, scene, result) +
                        materials_part(scene, result) + contact_part(figures, scene, result, sources) +
                        friction_part(figures, scene, result) + plasticity_part(figures) + damping_part(figures) +
                        erosion_part<Dim>(figures) + bonds_part(figures, scene) + fragments_part(figures, result) +
                        probes_part(scene, sources) + findings_part(figures, result.watch.findings) +
                        settings_part(figures, scene, result) + seconds_part(figures) + files_part(files);
    return "<!DOCTYPE html>\n" + page((scene.title.empty() ? program : scene.title) + ": report of a run", body).html() +
           "\n";
}

std::string failure_html(const std::string& program, const BodyPictures& pictures) {
    const Markup body =
        element("h1", program) + "\n" +
        element("p", {{"class", "attention"}},
                "The run failed, for the reason that its message gives. Below are its bodies until the last sound state, "
                "that of the last record at which H - H~ was at most half the energy in play.") +
        "\n" + pictures_part(pictures);
    return "<!DOCTYPE html>\n" + page(program + ": a run that failed", body).html() + "\n";
}

#define ABUT_INSTANTIATE(Dim)                                                                           \
    template std::string report_html<Dim>(const std::string&, const Scene<Dim>&, const RunResult<Dim>&, \
                                          const std::vector<ReportFile>&, const ReportSources&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
