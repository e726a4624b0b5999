#include "studies/extremes/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "abut/run/files/files.hpp"
#include "abut/run/option_table.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/run_options.hpp"

namespace abut::studies::extremes {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<Number>& numbers) {
    Json json = Json::object();
    for (const Number& number : numbers) json[number.name] = apps::json_number(number.value);
    return json;
}

const Columns<Row> table{{"family", "", 0, &Row::family},
                         {"value", "", -38, &Row::value, "", true},
                         {"outcome", "outcome", -9, [](const Row& row) { return name_of(row.verdict); }},
                         {"finite", "", 0, &Row::is_finite},
                         {"pseudo_energy_drift", "drift", 9, &Row::drift},
                         {"energy_excess_max", "H - H~", 9, &Row::excess},
                         {"parasitic_max", "|e|/m v", 9, &Row::parasitic},
                         {"events", "events", 9, &Row::events},
                         {"momentum_drift", "momentum", 9, &Row::momentum},
                         {"missed_contacts", "missed", 8, &Row::missed_contacts},
                         {"compression_max", "|g|/D", 8, &Row::compression},
                         {"sliding_ratio_max", "sliding", 9, &Row::sliding},
                         {"slipped_compression_max", "slipped", 9, &Row::slipped},
                         {"deviation", "units", 9, &Row::deviation},
                         {"cells", "", 0, &Row::cells},
                         {"steps", "", 0, &Row::steps},
                         {"active_pairs_max", "", 0, &Row::active_pairs_max},
                         {"blind_corners", "", 0, &Row::blind_corners},
                         {"message", "", 0, &Row::message, "", true}};
constexpr std::size_t of_refused = 3;  // columns that are printed of a run that gave no numbers

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
    Json json = begun_summary(program);
    json["options"] = apps::to_json(run::named_values(options.run));
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
    for (const Row& row : rows) {
        json["rows"].push_back(studies::to_json(members(table, row)));
        json["rows"].back()["numbers"] = to_json(row.numbers);
    }
    return json;
}

}  // namespace

std::string table_heads() { return heads(table); }

void print(const Row& row) {
    fmt::print("  {}\n", line(table, row, row.verdict == Verdict::refused ? of_refused : table.size()));
    if (!row.message.empty()) fmt::print("      {}\n", row.message);
}

void write_report(const apps::Program& program, const std::filesystem::path& out, const SweepOptions& options,
                  const std::vector<Row>& rows) {
    run::write_whole(out / "extremes.csv", csv_text(table, rows));
    apps::write_json(out / "summary.json", summary(program, options, rows));
    const auto count = [&](Verdict verdict) { return std::ranges::count(rows, verdict, &Row::verdict); };
    fmt::print("{} runs: {} held, {} refused, {} failed\n", rows.size(), count(Verdict::held), count(Verdict::refused),
               count(Verdict::failed));
    fmt::print("files: {}\n", out.string());
}

}  // namespace abut::studies::extremes
