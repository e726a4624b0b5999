#include "studies/kinematics/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "abut/run/files.hpp"
#include "apps/support/csv.hpp"

namespace abut::studies::kinematics {
namespace {

using Json = nlohmann::ordered_json;

constexpr double drift_allowed = 1e-12;                // of H~, over the largest energy; per 10,000 steps
constexpr double momentum_allowed = 1e-13;             // over sum |p|
constexpr double angular_allowed = 1e-13;              // of J~, over sum |x × p|
constexpr double correction_allowed[] = {1e-5, 1e-4};  // over the forces, in two and three dimensions

const char* const incomplete = "not ended before its time";

std::string folder_name(std::string name) {
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

/// What every run has to meet.
std::vector<Quantity> asked_of(const Figures& run, int dim) {
    std::vector<Quantity> asked{
        at_most(incomplete, run.is_complete ? 0.0 : 1.0, 0.0),
        at_most("missed contacts", static_cast<double>(run.missed_contacts), 0.0),
        at_most("H~ drift", run.drift, drift_allowed * std::max(1.0, 1e-4 * static_cast<double>(run.steps)))};
    if (!std::isnan(run.correction))
        asked.push_back(at_most("corrections over forces", run.correction, correction_allowed[dim - 2]));
    if (!std::isnan(run.momentum)) asked.push_back(at_most("momentum drift", run.momentum, momentum_allowed));
    if (!std::isnan(run.pseudo_angular)) asked.push_back(at_most("J~ drift", run.pseudo_angular, angular_allowed));
    return asked;
}

std::string all_met(const Row& row) {
    const auto asked = std::ranges::count_if(row.quantities, &Quantity::has_target);
    const auto met = std::ranges::count_if(row.quantities, [](const Quantity& q) { return q.has_target() && q.is_met(); });
    return met == asked ? fmt::format("{} met", asked) : fmt::format("{} of {} MISSED", asked - met, asked);
}

bool is_column(const std::string& name) {
    for (const char* column :
         {incomplete, "missed contacts", "H~ drift", "corrections over forces", "momentum drift", "J~ drift"})
        if (name == column) return true;
    return false;
}

void print(const Quantity& quantity) {
    fmt::print("      {:<58}{:>12.6g}", quantity.name, quantity.value);
    if (quantity.reference != 0.0) fmt::print("  of {:.6g}, off by {:.2g}", quantity.reference, quantity.error());
    if (quantity.has_target()) fmt::print("  allowed {:.2g}: {}", quantity.allowed, quantity.is_met() ? "met" : "MISSED");
    fmt::print("\n");
}

Json to_json(const Figures& run) {
    return {{"steps", run.steps},
            {"dt", run.dt},
            {"largest_energy", run.largest_energy},
            {"pseudo_energy_drift", apps::json_number(run.drift)},
            {"energy_excess_max", apps::json_number(run.excess)},
            {"parasitic_max", apps::json_number(run.parasitic)},
            {"momentum_drift", apps::json_number(run.momentum)},
            {"pseudo_angular_momentum_drift", apps::json_number(run.pseudo_angular)},
            {"events", run.events},
            {"missed_contacts", run.missed_contacts},
            {"pair_steps", run.pair_steps},
            {"compression_max", apps::json_number(run.compression)},
            {"correction", apps::json_number(run.correction)},
            {"correction_max", apps::json_number(run.correction_max)},
            {"complete", run.is_complete},
            {"ending", run.ending},
            {"seconds", run.seconds},
            {"seconds_of_steps", run.seconds_of_steps}};
}

Json to_json(const Quantity& quantity) {
    Json json{{"name", quantity.name},
              {"unit", quantity.unit},
              {"value", apps::json_number(quantity.value)},
              {"reference", quantity.reference},
              {"error", apps::json_number(quantity.error())}};
    if (quantity.has_target()) json.update({{"allowed", quantity.allowed}, {"met", quantity.is_met()}});
    return json;
}

Json to_json(const Row& row) {
    Json json{{"name", row.scene + ", " + row.setting}, {"scene", row.scene}, {"setting", row.setting}};
    json["quantities"] = Json::array();
    for (const Quantity& quantity : row.quantities) json["quantities"].push_back(to_json(quantity));
    json["run"] = to_json(row.run);
    return json;
}

std::string csv_text(const std::vector<Row>& rows) {
    std::string text = "scene,setting,quantity,value,reference,error,allowed\n";
    for (const Row& row : rows)
        for (const Quantity& quantity : row.quantities)
            text += fmt::format("{},{},{},{},{},{},{}\n", apps::quoted(row.scene), apps::quoted(row.setting),
                                apps::quoted(quantity.name), apps::all_digits(quantity.value),
                                apps::all_digits(quantity.reference), apps::all_digits(quantity.error()),
                                quantity.has_target() ? apps::all_digits(quantity.allowed) : "");
    return text;
}

}  // namespace

Quantity at_most(const std::string& name, double value, double allowed) {
    return {.name = name, .unit = "", .value = value, .reference = 0.0, .scale = 1.0, .allowed = allowed};
}

Quantity near(const std::string& name, double value, double reference, double allowed) {
    return {.name = name,
            .unit = "",
            .value = value,
            .reference = reference,
            .scale = reference == 0.0 ? 1.0 : std::abs(reference),
            .allowed = allowed};
}

template <int Dim>
Row row_of(const Case<Dim>& one, const std::string& setting, const Options& options, CaseResult<Dim>* result,
           const Watch<Dim>& watch) {
    Case<Dim> with_files = one;
    with_files.run.frames = options.frames;
    CaseResult<Dim> done = run_case<Dim>(with_files, options.out / folder_name(one.name + " " + setting), watch);
    Row row{.scene = one.name, .setting = setting, .run = done.figures};
    row.quantities = asked_of(done.figures, Dim);
    if (result != nullptr) *result = std::move(done);
    return row;
}

void print_head(const Part& part) {
    fmt::print("{}: {}\n", part.name, part.question);
    fmt::print("  {:<20}{:<28}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}{:>9}{:>9}\n", "", "", "steps", "dt",
               "H~", "H - H~", "|e|/m", "P", "J~", "events", "pairs", "missed", "|g|/D", "corr", "largest");
}

void print(const Row& row) {
    const Figures& run = row.run;
    fmt::print("  {:<20}{:<28}{:>8}{:>9.2g}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}{:>9}{:>9}  {} ({:.2g} s)\n",
               row.scene, row.setting, run.steps, run.dt, apps::two_digits(run.drift), apps::two_digits(run.excess),
               apps::two_digits(run.parasitic), apps::two_digits(run.momentum), apps::two_digits(run.pseudo_angular),
               run.events, run.pair_steps, run.missed_contacts, apps::two_digits(run.compression),
               apps::two_digits(run.correction), apps::two_digits(run.correction_max), all_met(row), run.seconds);
    for (const Quantity& quantity : row.quantities)
        if (!is_column(quantity.name) || !quantity.is_met()) print(quantity);
    if (!run.ending.empty()) fmt::print("      {}\n", run.ending);
    std::fflush(stdout);
}

void write_report(const apps::Program& program, const Options& options, const std::vector<Row>& rows) {
    Json json{{"program", program.name}, {"version", ABUT_VERSION}};
    json["options"] = {{"only", options.only}, {"quick", options.quick}, {"steps", options.steps}};
    json["levels"] = Json::array();
    for (const Row& row : rows) json["levels"].push_back(to_json(row));
    run::write_whole(options.out / "summary.json", json.dump(2) + "\n");
    run::write_whole(options.out / "kinematics.csv", csv_text(rows));
    const auto missed = std::ranges::count_if(rows, [](const Row& row) {
        return std::ranges::any_of(row.quantities, [](const Quantity& one) { return one.has_target() && !one.is_met(); });
    });
    fmt::print("{} rows, {} of them with a target that is missed\n", rows.size(), missed);
    fmt::print("files: {}\n", options.out.string());
}

template Row row_of<2>(const Case<2>&, const std::string&, const Options&, CaseResult<2>*, const Watch<2>&);
template Row row_of<3>(const Case<3>&, const std::string&, const Options&, CaseResult<3>*, const Watch<3>&);

}  // namespace abut::studies::kinematics
