#include "studies/table/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "abut/run/files/files.hpp"
#include "studies/table/columns.hpp"

namespace abut::studies {
namespace {

using Json = nlohmann::ordered_json;

constexpr double round_off = 1e-13;  // errors below it tell nothing about an order

/// Names of the quantities, in the order in which they appear.
std::vector<std::string> quantity_names(const Study& study) {
    std::vector<std::string> names;
    for (const Level& level : study.levels)
        for (const Quantity& quantity : level.quantities)
            if (std::find(names.begin(), names.end(), quantity.name) == names.end()) names.push_back(quantity.name);
    return names;
}

std::string named(const Quantity& quantity) {
    return quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit);
}

/// A quantity of a level.
struct ValueLine {
    const Level* level;
    const Quantity* quantity;
};

const Columns<ValueLine> value_columns{
    {"level", "", 0, [](const ValueLine& line) { return line.level->name; }, "", true},
    {"size", "", 0, [](const ValueLine& line) { return line.level->size; }},
    {"quantity", "", 0, [](const ValueLine& line) { return line.quantity->name; }, "", true},
    {"unit", "", 0, [](const ValueLine& line) { return line.quantity->unit; }, "", true},
    {"", "", -44, [](const ValueLine& line) { return named(*line.quantity); }},
    {"value", "value", 14, [](const ValueLine& line) { return line.quantity->value; }, "{:.6g}"},
    {"reference", "reference", 14, [](const ValueLine& line) { return line.quantity->reference; }, "{:.6g}"},
    {"error", "error", 11, [](const ValueLine& line) { return line.quantity->error(); }, "{:.3g}"},
    {"allowed", "allowed", 11, [](const ValueLine& line) { return line.quantity->target_or_nan(); }, "{:.3g}"}};

void print(const ValueLine& one) {
    const bool has_target = one.quantity->has_target();
    fmt::print("    {}", line(value_columns, one, value_columns.size() - (has_target ? 0 : 1)));
    fmt::print("{}\n", !has_target ? "" : one.quantity->is_met() ? "  met" : "  MISSED");
}

const Columns<Figures> energy_columns{{"pseudo_energy_drift", "", 0, &Figures::drift},
                                      {"energy_excess_max", "", 0, &Figures::excess},
                                      {"parasitic_max", "", 0, &Figures::parasitic},
                                      {"events", "", 0, &Figures::events},
                                      {"scale", "", 0, [](const Figures& run) { return run.scale.value; }},
                                      {"scale_name", "", 0, [](const Figures& run) { return run.scale.name; }}};

void print_energies(const Figures& run) {
    fmt::print("    {:<44}drift of H~ {:.2g} {}, max (H - H~) {:.2g} {}, max |e|/m {:.2g} m/s, {} events\n", "energies",
               run.drift, run.scale.name, run.excess, run.scale.name, run.parasitic, run.events);
}

std::optional<double> least_order(const Study& study, const std::string& quantity) {
    for (const OrderTarget& target : study.orders)
        if (target.quantity == quantity) return target.least;
    return std::nullopt;
}

void print_orders(const Study& study) {
    for (const std::string& name : quantity_names(study)) {
        const auto order = fitted_order(study, name);
        if (!order) continue;
        fmt::print("  {:<46}error ~ size^{:.2f}", name, *order);
        if (const auto least = least_order(study, name))
            fmt::print(", at least {:g} is asked for: {}", *least, *order >= *least ? "met" : "MISSED");
        fmt::print("\n");
    }
}

Json to_json(const Level& level) {
    Json json{{"name", level.name}, {"seconds", level.seconds}, {"quantities", Json::array()}};
    if (level.size > 0.0) json["size"] = level.size;
    for (const Quantity& quantity : level.quantities) json["quantities"].push_back(to_json(quantity));
    if (level.energies) json["energies"] = studies::to_json(members(energy_columns, *level.energies));
    return json;
}

Json summary(const apps::Program& program, const Study& study) {
    Json json = begun_summary(program);
    json.update({{"title", study.title}, {"reference", study.reference}});
    json["options"] = apps::to_json(study.options);
    json["levels"] = Json::array();
    for (const Level& level : study.levels) json["levels"].push_back(to_json(level));
    json["orders"] = Json::object();
    for (const std::string& name : quantity_names(study))
        if (const auto order = fitted_order(study, name)) json["orders"][name] = *order;
    for (const OrderTarget& target : study.orders) json["orders_least"][target.quantity] = target.least;
    return json;
}

}  // namespace

std::vector<std::int64_t> counts(const std::vector<int>& numbers) { return {numbers.begin(), numbers.end()}; }

nlohmann::ordered_json to_json(const Quantity& quantity) {
    Json json{{"name", quantity.name},
              {"unit", quantity.unit},
              {"value", apps::json_number(quantity.value)},
              {"reference", quantity.reference},
              {"error", apps::json_number(quantity.error())}};
    if (quantity.has_target()) json.update({{"allowed", quantity.allowed}, {"met", quantity.is_met()}});
    return json;
}

void Quantities::at_most(const std::string& name, double value, double allowed) {
    push_back({.name = name, .unit = "", .value = value, .reference = 0.0, .scale = 1.0, .allowed = allowed});
}

void Quantities::near(const std::string& name, double value, double reference, double allowed, const std::string& unit) {
    const double scale = reference == 0.0 ? 1.0 : std::abs(reference);
    push_back({.name = name, .unit = unit, .value = value, .reference = reference, .scale = scale, .allowed = allowed});
}

double Quantity::error() const { return std::abs(value - reference) / (scale > 0.0 ? scale : std::abs(reference)); }

std::optional<double> fitted_order(const Study& study, const std::string& quantity) {
    std::set<double> sizes;
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const Level& level : study.levels)
        for (const Quantity& one : level.quantities) {
            if (one.name != quantity || !(level.size > 0.0) || !(one.error() > round_off)) continue;
            const double log_size = std::log(level.size), log_error = std::log(one.error());
            sizes.insert(level.size);
            n += 1.0;
            x += log_size;
            y += log_error;
            xx += log_size * log_size;
            xy += log_size * log_error;
        }
    if (sizes.size() < 2) return std::nullopt;
    return (n * xy - x * y) / (n * xx - x * x);
}

run::FolderLock prepare_study(const apps::Program& program, const std::filesystem::path& out,
                              const std::vector<std::string>& curves, const std::vector<std::string>& pictures) {
    run::FolderLock lock(out, program.name);
    std::vector<std::string> names{"values.csv", "summary.json"};
    for (const std::string& curve : curves) names.push_back(curve + ".csv");
    for (const std::string& picture : pictures) {
        names.push_back(picture + ".gp");
        names.push_back(picture + ".png");
    }
    run::claim_results(out, names);
    return lock;
}

void report(const apps::Program& program, const std::filesystem::path& out, const Study& study) {
    for (const auto& [name, table] : study.curves) apps::write_csv(out / (name + ".csv"), table);
    std::vector<std::string> without_picture;
    for (const Picture& picture : study.pictures)
        if (std::string why = draw(out, picture); !why.empty()) without_picture.push_back(std::move(why));
    std::vector<ValueLine> lines;
    for (const Level& level : study.levels)
        for (const Quantity& quantity : level.quantities) lines.push_back({&level, &quantity});
    run::write_whole(out / "values.csv", csv_text(value_columns, lines));
    apps::write_json(out / "summary.json", summary(program, study));

    fmt::print("{}: {}\n", program.name, study.title);
    fmt::print("  reference: {}\n", study.reference);
    fmt::print("    {}\n", heads(value_columns));
    for (const Level& level : study.levels) {
        fmt::print("  {} ({:.2g} s)\n", level.name, level.seconds);
        for (const Quantity& quantity : level.quantities) print({&level, &quantity});
        if (level.energies) print_energies(*level.energies);
    }
    print_orders(study);
    for (const std::string& why : without_picture) fmt::print("  no picture: {}\n", why);
    fmt::print("  files: {}\n", out.string());
}

}  // namespace abut::studies
