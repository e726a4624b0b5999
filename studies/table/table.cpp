#include "studies/table/table.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>

namespace abut::studies {
namespace {

using Json = nlohmann::ordered_json;

constexpr double drift_allowed = 1e-12;  // of H~
constexpr double momentum_allowed = 1e-13;
constexpr double correction_allowed[] = {1e-5, 1e-4};  // in two and three dimensions

constexpr std::array asked{"not ended before its time", "missed contacts", "H~ drift",
                           "corrections over forces",   "momentum drift",  "J~ drift",
                           "angular momentum drift"};

bool is_missed(const Quantity& quantity) { return quantity.has_target() && !quantity.is_met(); }

void print(const Quantity& quantity) {
    fmt::print("      {:<58}{:>12.6g}", quantity.name + (quantity.unit.empty() ? "" : " [" + quantity.unit + "]"),
               quantity.value);
    if (quantity.reference != 0.0) fmt::print("  of {:.6g}, off by {:.2g}", quantity.reference, quantity.error());
    if (quantity.has_target()) fmt::print("  allowed {:.2g}: {}", quantity.allowed, quantity.is_met() ? "met" : "MISSED");
    fmt::print("\n");
}

/// "7 met", "2 of 7 MISSED", nothing without a target.
std::string all_met(const std::vector<Quantity>& quantities) {
    const auto targets = std::ranges::count_if(quantities, &Quantity::has_target);
    const auto missed = std::ranges::count_if(quantities, is_missed);
    if (targets == 0) return "";
    return missed == 0 ? fmt::format("{} met", targets) : fmt::format("{} of {} MISSED", missed, targets);
}

/// A quantity of a row.
struct QuantityLine {
    const Row* row;
    const Quantity* quantity;
};

const Columns<QuantityLine> quantity_columns{
    {"scene", "", 0, [](const QuantityLine& line) { return line.row->scene; }, "", true},
    {"setting", "", 0, [](const QuantityLine& line) { return line.row->setting; }, "", true},
    {"quantity", "", 0, [](const QuantityLine& line) { return line.quantity->name; }, "", true},
    {"value", "", 0, [](const QuantityLine& line) { return line.quantity->value; }},
    {"reference", "", 0, [](const QuantityLine& line) { return line.quantity->reference; }},
    {"error", "", 0, [](const QuantityLine& line) { return line.quantity->error(); }},
    {"allowed", "", 0, [](const QuantityLine& line) { return line.quantity->target_or_nan(); }}};

Json to_json(const Row& row, const Columns<Figures>& columns) {
    Json json{{"name", row.scene + ", " + row.setting}, {"scene", row.scene}, {"setting", row.setting}};
    json["quantities"] = Json::array();
    for (const Quantity& quantity : row.quantities) json["quantities"].push_back(to_json(quantity));
    json.update({{"seconds", row.seconds}, {"remark", row.remark}});
    if (row.run) json["run"] = studies::to_json(members(columns, *row.run));
    return json;
}

}  // namespace

bool asks_for(const std::vector<std::string>& only, const std::string& name) {
    return only.empty() || std::ranges::find(only, name) != only.end();
}

void add_part_options(Flags& flags, const apps::Program& program, const std::vector<std::string>& parts,
                      PartOptions& options) {
    flags.group("Parts");
    flags.names("--only", options.only, "parts to run", parts);
    flags.flag("--quick", options.quick, "coarse meshes and short runs");
    options.out = "out/" + program.name;
    flags.out(options.out);
}

std::string folder_name(std::string name) {
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
}

Row row_of(const std::string& scene, const std::string& setting, const Figures& run, int dim, const Laws& laws) {
    Row row{.scene = scene, .setting = setting, .run = run, .remark = run.unseen_edges, .seconds = run.seconds};
    if (!run.ending.empty()) row.remark += (row.remark.empty() ? "" : "\n      ") + run.ending;
    const auto ask = [&](std::size_t i, double value, double allowed) { row.quantities.at_most(asked[i], value, allowed); };
    ask(0, run.is_complete ? 0.0 : 1.0, 0.0);
    ask(1, static_cast<double>(run.missed_contacts), 0.0);
    if (laws.pseudo) ask(2, run.drift, drift_allowed);
    if (laws.pseudo && !std::isnan(run.correction)) ask(3, run.correction, correction_allowed[dim - 2]);
    if (!std::isnan(run.momentum)) ask(4, run.momentum, momentum_allowed);
    const std::size_t turning = laws.pseudo ? 5 : 6;
    const double angular = laws.pseudo ? run.pseudo_angular : run.angular;
    if (laws.turns && !std::isnan(angular)) ask(turning, angular, laws.angular);
    return row;
}

Columns<Figures> RowTable::columns() const {
    Columns<Figures> all{{"steps", "steps", 8, &Figures::steps},
                         {"dt", "dt", dt, &Figures::dt},
                         {"largest_energy", "", 0, [](const Figures& run) { return run.scale.value; }},
                         {"pseudo_energy_drift", "H~", 9, &Figures::drift},
                         {"energy_drift", "H", 9, &Figures::energy_drift},
                         {"energy_excess_max", "H - H~", 9, &Figures::excess},
                         {"parasitic_max", "|e|/m", 9, &Figures::parasitic},
                         {"momentum_drift", "P", 9, &Figures::momentum},
                         {"angular_momentum_drift", "", 0, &Figures::angular},
                         {"pseudo_angular_momentum_drift", "J~", 9, &Figures::pseudo_angular},
                         {"rest_angular_momentum_drift", "", 0, &Figures::rest_angular},
                         {"events", "events", 9, &Figures::events},
                         {"pair_steps", "pairs", 9, &Figures::pair_steps},
                         {"missed_contacts", "missed", 7, &Figures::missed_contacts},
                         {"compression_max", "|g|/D", 8, &Figures::compression},
                         {"correction", "corr", 9, &Figures::correction},
                         {"correction_max", "largest", 9, &Figures::correction_max},
                         {"complete", "", 0, &Figures::is_complete},
                         {"ending", "", 0, &Figures::ending},
                         {"unseen_edges", "", 0, &Figures::unseen_edges},
                         {"seconds", "", 0, &Figures::seconds},
                         {"seconds_of_steps", "", 0, &Figures::seconds_of_steps}};
    std::erase_if(all, [&](const Column<Figures>& column) { return std::ranges::count(without, column.key) > 0; });
    return all;
}

void print(const Row& row, const RowTable& table) {
    fmt::print("  {}{}{}  {} ({:.2g} s)\n", shown(row.scene, -table.scene), shown(row.setting, -table.setting),
               row.run ? line(table.columns(), *row.run) : "", all_met(row.quantities), row.seconds);
    for (const Quantity& quantity : row.quantities)  // the table has the others already
        if (std::ranges::find(asked, quantity.name) == asked.end() || !quantity.is_met()) print(quantity);
    if (!row.remark.empty()) fmt::print("      {}\n", row.remark);
}

void write_rows(const apps::Program& program, const std::filesystem::path& out, const run::NamedValues& options,
                const std::vector<Row>& rows, const RowTable& table) {
    Json json = begun_summary(program);
    json["options"] = apps::to_json(options);
    json["levels"] = Json::array();
    std::vector<QuantityLine> lines;
    for (const Row& row : rows) {
        json["levels"].push_back(to_json(row, table.columns()));
        for (const Quantity& quantity : row.quantities) lines.push_back({&row, &quantity});
    }
    apps::write_json(out / "summary.json", json);
    run::write_whole(out / (program.name + ".csv"), csv_text(quantity_columns, lines));
    const auto missed =
        std::ranges::count_if(rows, [](const Row& row) { return std::ranges::any_of(row.quantities, is_missed); });
    fmt::print("{} rows, {} of them with a target that is missed\n", rows.size(), missed);
    fmt::print("files: {}\n", out.string());
}

}  // namespace abut::studies
