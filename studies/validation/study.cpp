#include "studies/validation/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <set>

#include "abut/run/files.hpp"
#include "apps/support/csv.hpp"

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

void print_quantity(const Quantity& quantity) {
    fmt::print("    {:<44}{:>14.6g}{:>14.6g}{:>11.3g}", named(quantity), quantity.value, quantity.reference,
               quantity.error());
    if (quantity.has_target()) fmt::print("{:>11.3g}  {}", quantity.allowed, quantity.is_met() ? "met" : "MISSED");
    fmt::print("\n");
}

void print_energies(const EnergyFigures& energies) {
    fmt::print("    {:<44}{}\n", "energies",
               fmt::format("drift of H~ {:.2g} {}, max (H - H~) {:.2g} {}, max |e|/m {:.2g} m/s, {} events", energies.drift,
                           energies.scale_name, energies.excess, energies.scale_name, energies.parasitic, energies.events));
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

Json to_json(const EnergyFigures& energies) {
    return {{"pseudo_energy_drift", energies.drift},
            {"energy_excess_max", energies.excess},
            {"parasitic_max", energies.parasitic},
            {"events", energies.events},
            {"scale", energies.scale},
            {"scale_name", energies.scale_name}};
}

Json to_json(const Level& level) {
    Json json{{"name", level.name}, {"seconds", level.seconds}, {"quantities", Json::array()}};
    if (level.size > 0.0) json["size"] = level.size;
    for (const Quantity& quantity : level.quantities) json["quantities"].push_back(to_json(quantity));
    if (level.energies) json["energies"] = to_json(*level.energies);
    return json;
}

Json summary(const apps::Program& program, const Study& study) {
    Json json{{"program", program.name}, {"version", ABUT_VERSION}, {"title", study.title}, {"reference", study.reference}};
    json["options"] = study.options;
    json["levels"] = Json::array();
    for (const Level& level : study.levels) json["levels"].push_back(to_json(level));
    json["orders"] = Json::object();
    for (const std::string& name : quantity_names(study))
        if (const auto order = fitted_order(study, name)) json["orders"][name] = *order;
    for (const OrderTarget& target : study.orders) json["orders_least"][target.quantity] = target.least;
    return json;
}

/// A quotation mark in a name would end it: there are none.
std::string values_text(const Study& study) {
    std::string text = "level,size,quantity,unit,value,reference,error,allowed\n";
    for (const Level& level : study.levels)
        for (const Quantity& quantity : level.quantities)
            text += fmt::format("\"{}\",{:.17g},\"{}\",\"{}\",{:.17g},{:.17g},{:.17g},{}\n", level.name, level.size,
                                quantity.name, quantity.unit, quantity.value, quantity.reference, quantity.error(),
                                quantity.has_target() ? fmt::format("{:.17g}", quantity.allowed) : "");
    return text;
}

}  // namespace

nlohmann::ordered_json to_json(const Quantity& quantity) {
    Json json{{"name", quantity.name},
              {"unit", quantity.unit},
              {"value", apps::json_number(quantity.value)},
              {"reference", quantity.reference},
              {"error", apps::json_number(quantity.error())}};
    if (quantity.has_target()) json.update({{"allowed", quantity.allowed}, {"met", quantity.is_met()}});
    return json;
}

double Quantity::error() const { return std::abs(value - reference) / (scale > 0.0 ? scale : std::abs(reference)); }

template <int Dim>
EnergyFigures energy_figures(const run::RunResult<Dim>& result) {
    return {.drift = result.ledger.pseudo_energy_drift() / result.scale.value,
            .excess = result.ledger.energy_excess() / result.scale.value,
            .parasitic = result.ledger.parasitic(),
            .events = result.contact.events,
            .scale = result.scale.value,
            .scale_name = result.scale.name};
}

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
    for (const apps::Picture& picture : study.pictures)
        if (std::string why = draw(out, picture); !why.empty()) without_picture.push_back(std::move(why));
    run::write_whole(out / "values.csv", values_text(study));
    apps::write_json(out / "summary.json", summary(program, study));

    fmt::print("{}: {}\n", program.name, study.title);
    fmt::print("  reference: {}\n", study.reference);
    fmt::print("    {:<44}{:>14}{:>14}{:>11}{:>11}\n", "", "value", "reference", "error", "allowed");
    for (const Level& level : study.levels) {
        fmt::print("  {} ({:.2g} s)\n", level.name, level.seconds);
        for (const Quantity& quantity : level.quantities) print_quantity(quantity);
        if (level.energies) print_energies(*level.energies);
    }
    print_orders(study);
    for (const std::string& why : without_picture) fmt::print("  no picture: {}\n", why);
    fmt::print("  files: {}\n", out.string());
}

template EnergyFigures energy_figures<2>(const run::RunResult<2>&);
template EnergyFigures energy_figures<3>(const run::RunResult<3>&);

}  // namespace abut::studies
