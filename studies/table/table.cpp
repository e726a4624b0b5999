#include "studies/table/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "abut/run/files.hpp"
#include "apps/support/csv.hpp"
#include "studies/program/flags.hpp"

namespace abut::studies {
namespace {

using Json = nlohmann::ordered_json;

bool is_missed(const Quantity& quantity) { return quantity.has_target() && !quantity.is_met(); }

void print(const Quantity& quantity) {
    fmt::print("      {:<58}{:>12.6g}", quantity.name + (quantity.unit.empty() ? "" : " [" + quantity.unit + "]"),
               quantity.value);
    if (quantity.reference != 0.0) fmt::print("  of {:.6g}, off by {:.2g}", quantity.reference, quantity.error());
    if (quantity.has_target()) fmt::print("  allowed {:.2g}: {}", quantity.allowed, quantity.is_met() ? "met" : "MISSED");
    fmt::print("\n");
}

Json to_json(const RowRecord& row) {
    Json json{{"name", row.scene + ", " + row.setting}, {"scene", row.scene}, {"setting", row.setting}};
    json["quantities"] = Json::array();
    for (const Quantity& quantity : row.quantities) json["quantities"].push_back(to_json(quantity));
    json.update(row.more);
    return json;
}

std::string csv_text(std::span<const RowRecord> rows) {
    std::string text = "scene,setting,quantity,value,reference,error,allowed\n";
    for (const RowRecord& row : rows)
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

bool PartOptions::asks_for(const std::string& part) const {
    return only.empty() || std::ranges::find(only, part) != only.end();
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

std::string all_met(std::span<const Quantity> quantities) {
    const auto asked = std::ranges::count_if(quantities, &Quantity::has_target);
    const auto missed = std::ranges::count_if(quantities, is_missed);
    if (asked == 0) return "";
    return missed == 0 ? fmt::format("{} met", asked) : fmt::format("{} of {} MISSED", missed, asked);
}

void print_rest(std::span<const Quantity> quantities, std::span<const char* const> columns) {
    for (const Quantity& quantity : quantities)
        if (std::ranges::find(columns, quantity.name) == columns.end() || !quantity.is_met()) print(quantity);
}

void write_table(const apps::Program& program, const std::filesystem::path& out, const Json& options,
                 std::span<const RowRecord> rows) {
    Json json{{"program", program.name}, {"version", ABUT_VERSION}, {"options", options}};
    json["levels"] = Json::array();
    for (const RowRecord& row : rows) json["levels"].push_back(to_json(row));
    apps::write_json(out / "summary.json", json);
    run::write_whole(out / (program.name + ".csv"), csv_text(rows));
    const auto missed =
        std::ranges::count_if(rows, [](const RowRecord& row) { return std::ranges::any_of(row.quantities, is_missed); });
    fmt::print("{} rows, {} of them with a target that is missed\n", rows.size(), missed);
    fmt::print("files: {}\n", out.string());
}

}  // namespace abut::studies
