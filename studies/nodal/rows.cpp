#include "studies/nodal/rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/support/csv.hpp"

namespace abut::studies::turning {
namespace {

using Json = nlohmann::ordered_json;

constexpr double drift_allowed = 1e-12;          // of H~, over the largest energy
constexpr double momentum_allowed = 1e-13;       // over sum m |v|
constexpr double angular_allowed = 1e-14;        // of J~, over sum |x × p|
constexpr double noisy_angular_allowed = 3e-14;  // where H - H~ says that the grid vibrates
constexpr double noise = 1e-3;
constexpr double correction_allowed[] = {1e-5, 1e-4};  // over the forces, in two and three dimensions

/// What every run has to meet.
std::vector<Quantity> asked_of(const ImpactFigures& run, const ImpactOptions& options, int dim, bool is_free, bool turns) {
    std::vector<Quantity> asked{at_most("not ended before its time", run.is_complete ? 0.0 : 1.0, 0.0),
                                at_most("missed contacts", static_cast<double>(run.missed_contacts), 0.0)};
    const bool memm = options.scheme == Scheme::memm;
    if (memm) {
        asked.push_back(at_most("H~ drift", run.drift, drift_allowed));
        asked.push_back(at_most("corrections over forces", run.correction, correction_allowed[dim - 2]));
    }
    if (!is_free) return asked;
    asked.push_back(at_most("momentum drift", run.momentum, momentum_allowed));
    const double allowed = run.excess > noise ? noisy_angular_allowed : angular_allowed;
    if (!turns) return asked;  // linear strain keeps neither
    asked.push_back(at_most(memm ? "J~ drift" : "angular momentum drift", memm ? run.pseudo_angular : run.angular, allowed));
    return asked;
}

constexpr const char* columns[] = {"not ended before its time", "missed contacts", "H~ drift",
                                   "corrections over forces",   "momentum drift",  "J~ drift",
                                   "angular momentum drift"};

Json to_json(const ImpactFigures& run) {
    return {{"steps", run.steps},
            {"dt", run.dt},
            {"largest_energy", run.largest_energy},
            {"pseudo_energy_drift", apps::json_number(run.drift)},
            {"energy_drift", apps::json_number(run.energy_drift)},
            {"energy_excess_max", apps::json_number(run.excess)},
            {"parasitic_max", apps::json_number(run.parasitic)},
            {"momentum_drift", apps::json_number(run.momentum)},
            {"angular_momentum_drift", apps::json_number(run.angular)},
            {"pseudo_angular_momentum_drift", apps::json_number(run.pseudo_angular)},
            {"rest_angular_momentum_drift", apps::json_number(run.rest_angular)},
            {"compression_max", apps::json_number(run.compression)},
            {"correction", apps::json_number(run.correction)},
            {"missed_contacts", run.missed_contacts},
            {"events", run.events},
            {"pair_steps", run.pair_steps},
            {"complete", run.is_complete},
            {"ending", run.ending},
            {"unseen_edges", run.unseen_edges}};
}

}  // namespace

std::string name_of(const ImpactOptions& run) {
    std::string name = run.scheme == Scheme::memm ? "memm" : "leapfrog";
    if (run.filter) name += ", filter";
    if (run.restart > 0) name += fmt::format(", restart {}", run.restart);
    return name;
}

template <int Dim>
Row row_of(const Impact<Dim>& impact, const ImpactOptions& run, const std::string& setting, const Options& options,
           ImpactResult<Dim>* result, const Watch<Dim>& watch) {
    ImpactOptions in_folder = run;
    in_folder.out = options.out / folder_name(impact.name + " " + setting);
    ImpactResult<Dim> done = run_impact<Dim>(impact, in_folder, watch);
    if (!impact.is_free)
        for (double* figure :
             {&done.figures.momentum, &done.figures.angular, &done.figures.pseudo_angular, &done.figures.rest_angular})
            *figure = run::not_given;
    Row row{.scene = impact.name, .setting = setting, .run = done.figures, .seconds = done.figures.seconds};
    row.quantities = asked_of(done.figures, run, Dim, impact.is_free, impact.scene.strain == Strain::finite);
    row.remark = done.figures.unseen_edges;
    if (!done.figures.ending.empty()) row.remark += (row.remark.empty() ? "" : "\n      ") + done.figures.ending;
    if (result != nullptr) *result = std::move(done);
    return row;
}

void print_head(const Part& part) {
    fmt::print("{}: {}\n", part.name, part.question);
    fmt::print("  {:<22}{:<30}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}{:>9}\n", "", "", "steps", "dt",
               "H~", "H", "H - H~", "|e|/m", "P", "J~", "events", "pairs", "missed", "|g|/D", "corr");
}

void print(const Row& row) {
    fmt::print("  {:<22}{:<30}", row.scene, row.setting);
    if (row.run) {
        const ImpactFigures& run = *row.run;
        fmt::print("{:>8}{:>8.2g}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>7}{:>8}{:>9}", run.steps, run.dt,
                   apps::two_digits(run.drift), apps::two_digits(run.energy_drift), apps::two_digits(run.excess),
                   apps::two_digits(run.parasitic), apps::two_digits(run.momentum), apps::two_digits(run.pseudo_angular),
                   run.events, run.pair_steps, run.missed_contacts, apps::two_digits(run.compression),
                   apps::two_digits(run.correction));
    }
    fmt::print("  {} ({:.2g} s)\n", all_met(row.quantities), row.seconds);
    print_rest(row.quantities, columns);
    if (!row.remark.empty()) fmt::print("      {}\n", row.remark);
    std::fflush(stdout);
}

void write_report(const apps::Program& program, const Options& options, const std::vector<Row>& rows) {
    std::vector<RowRecord> records;
    for (const Row& row : rows) {
        RowRecord& record = records.emplace_back(row.scene, row.setting, row.quantities);
        record.more = {{"seconds", row.seconds}, {"remark", row.remark}};
        if (row.run) record.more["run"] = to_json(*row.run);
    }
    const Json chosen{{"only", options.only},
                      {"scheme", options.impact.scheme == Scheme::memm ? "memm" : "leapfrog"},
                      {"filter", options.impact.filter},
                      {"restart", options.impact.restart},
                      {"cfl", options.impact.cfl},
                      {"steps", options.long_steps},
                      {"quick", options.quick}};
    write_table(program, options.out, chosen, records);
}

#define ABUT_INSTANTIATE(Dim)                                                                              \
    template Row row_of<Dim>(const Impact<Dim>&, const ImpactOptions&, const std::string&, const Options&, \
                             ImpactResult<Dim>*, const Watch<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::turning
