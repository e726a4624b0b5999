#include "studies/extremes/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "abut/run/files.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/run_options.hpp"

namespace abut::studies::extremes {
namespace {

using Json = nlohmann::ordered_json;

std::string csv_text(const std::vector<Row>& rows) {
    std::string text =
        "family,value,outcome,finite,pseudo_energy_drift,energy_excess_max,parasitic_max,events,momentum_drift,"
        "missed_contacts,compression_max,sliding_ratio_max,slipped_compression_max,deviation,cells,steps,active_pairs_max,"
        "blind_corners,message\n";
    for (const Row& row : rows)
        text +=
            fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.family, apps::quoted(row.value),
                        name_of(row.verdict), row.is_finite ? 1 : 0, apps::all_digits(row.drift),
                        apps::all_digits(row.excess), apps::all_digits(row.parasitic), row.events,
                        apps::all_digits(row.momentum), row.missed_contacts, apps::all_digits(row.compression),
                        apps::all_digits(row.sliding), apps::all_digits(row.slipped), apps::all_digits(row.deviation),
                        row.cells, row.steps, row.active_pairs_max, row.blind_corners, apps::quoted(row.message));
    return text;
}

Json to_json(const std::vector<Number>& numbers) {
    Json json = Json::object();
    for (const Number& number : numbers) json[number.name] = apps::json_number(number.value);
    return json;
}

Json to_json(const Row& row) {
    return {{"family", row.family},
            {"value", row.value},
            {"outcome", name_of(row.verdict)},
            {"finite", row.is_finite},
            {"pseudo_energy_drift", apps::json_number(row.drift)},
            {"energy_excess_max", apps::json_number(row.excess)},
            {"parasitic_max", apps::json_number(row.parasitic)},
            {"events", row.events},
            {"momentum_drift", apps::json_number(row.momentum)},
            {"missed_contacts", row.missed_contacts},
            {"compression_max", apps::json_number(row.compression)},
            {"sliding_ratio_max", apps::json_number(row.sliding)},
            {"slipped_compression_max", apps::json_number(row.slipped)},
            {"deviation", apps::json_number(row.deviation)},
            {"cells", row.cells},
            {"steps", row.steps},
            {"active_pairs_max", row.active_pairs_max},
            {"blind_corners", row.blind_corners},
            {"numbers", to_json(row.numbers)},
            {"message", row.message}};
}

/// The largest of a number over all rows that have one.
Json worst(const std::vector<Row>& rows, double Row::*number) {
    double largest = run::not_given;
    for (const Row& row : rows) largest = std::fmax(largest, row.*number);
    return apps::json_number(largest);
}

Json family_json(const Family& family, const std::vector<Row>& rows) {
    Json json{{"question", family.question}};
    for (const Verdict verdict : {Verdict::held, Verdict::refused, Verdict::failed})
        json[name_of(verdict)] = std::ranges::count(rows, verdict, &Row::verdict);
    json["pseudo_energy_drift"] = worst(rows, &Row::drift);
    json["energy_excess_max"] = worst(rows, &Row::excess);
    json["parasitic_max"] = worst(rows, &Row::parasitic);
    json["momentum_drift"] = worst(rows, &Row::momentum);
    json["deviation"] = worst(rows, &Row::deviation);
    return json;
}

Json summary(const apps::Program& program, const SweepOptions& options, const std::vector<Row>& rows) {
    Json json{{"program", program.name}, {"version", ABUT_VERSION}, {"options", apps::to_json(options.run)}};
    json["options"].update({{"steps", options.steps}, {"quick", options.quick}});
    json["asked"] = {{"pseudo_energy_drift", largest_drift},
                     {"momentum_drift", largest_momentum_drift},
                     {"energy_excess_max", largest_excess},
                     {"deviation", largest_deviation}};
    json["families"] = Json::object();
    for (const Family& family : families()) {
        std::vector<Row> of_family;
        std::ranges::copy_if(rows, std::back_inserter(of_family), [&](const Row& row) { return row.family == family.name; });
        if (!of_family.empty()) json["families"][family.name] = family_json(family, of_family);
    }
    json["rows"] = Json::array();
    for (const Row& row : rows) json["rows"].push_back(to_json(row));
    return json;
}

}  // namespace

void print_head(const Family& family) {
    fmt::print("{}: {}\n", family.name, family.question);
    fmt::print("  {:<38}{:<9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>8}{:>9}{:>9}{:>9}\n", "", "outcome", "drift", "H - H~",
               "|e|/m v", "events", "momentum", "missed", "|g|/D", "sliding", "slipped", "units");
}

void print(const Row& row) {
    fmt::print("  {:<38}{:<9}", row.value, name_of(row.verdict));
    if (row.verdict != Verdict::refused)
        fmt::print("{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>8}{:>9}{:>9}{:>9}", apps::two_digits(row.drift),
                   apps::two_digits(row.excess), apps::two_digits(row.parasitic), row.events, apps::two_digits(row.momentum),
                   row.missed_contacts, apps::two_digits(row.compression), apps::two_digits(row.sliding),
                   apps::two_digits(row.slipped), apps::two_digits(row.deviation));
    fmt::print("\n");
    if (!row.message.empty()) fmt::print("      {}\n", row.message);
    std::fflush(stdout);
}

void write_report(const apps::Program& program, const std::filesystem::path& out, const SweepOptions& options,
                  const std::vector<Row>& rows) {
    run::write_whole(out / "extremes.csv", csv_text(rows));
    apps::write_json(out / "summary.json", summary(program, options, rows));
    const auto count = [&](Verdict verdict) { return std::ranges::count(rows, verdict, &Row::verdict); };
    fmt::print("{} runs: {} held, {} refused, {} failed\n", rows.size(), count(Verdict::held), count(Verdict::refused),
               count(Verdict::failed));
    fmt::print("files: {}\n", out.string());
}

}  // namespace abut::studies::extremes
