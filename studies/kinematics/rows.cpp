#include "studies/kinematics/rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/support/csv.hpp"

namespace abut::studies::kinematics {
namespace {

using Json = nlohmann::ordered_json;

constexpr double drift_allowed = 1e-12;                // of H~, over the largest energy
constexpr double momentum_allowed = 1e-13;             // over sum |p|
constexpr double angular_allowed = 1e-13;              // of J~, over sum |x × p|
constexpr double correction_allowed[] = {1e-5, 1e-4};  // over the forces, in two and three dimensions

constexpr const char* columns[] = {"not ended before its time", "missed contacts", "H~ drift",
                                   "corrections over forces",   "momentum drift",  "J~ drift"};

/// What every run has to meet.
std::vector<Quantity> asked_of(const Figures& run, int dim) {
    std::vector<Quantity> asked{at_most(columns[0], run.is_complete ? 0.0 : 1.0, 0.0),
                                at_most("missed contacts", static_cast<double>(run.missed_contacts), 0.0),
                                at_most("H~ drift", run.drift, drift_allowed)};
    if (!std::isnan(run.correction))
        asked.push_back(at_most("corrections over forces", run.correction, correction_allowed[dim - 2]));
    if (!std::isnan(run.momentum)) asked.push_back(at_most("momentum drift", run.momentum, momentum_allowed));
    if (!std::isnan(run.pseudo_angular)) asked.push_back(at_most("J~ drift", run.pseudo_angular, angular_allowed));
    return asked;
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

}  // namespace

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
               apps::two_digits(run.correction), apps::two_digits(run.correction_max), all_met(row.quantities), run.seconds);
    print_rest(row.quantities, columns);
    if (!run.ending.empty()) fmt::print("      {}\n", run.ending);
    std::fflush(stdout);
}

void write_report(const apps::Program& program, const Options& options, const std::vector<Row>& rows) {
    std::vector<RowRecord> records;
    for (const Row& row : rows) records.push_back({row.scene, row.setting, row.quantities, {{"run", to_json(row.run)}}});
    write_table(program, options.out,
                {{"only", options.only}, {"quick", options.quick}, {"steps", options.steps}, {"turns", options.turns}},
                records);
}

template Row row_of<2>(const Case<2>&, const std::string&, const Options&, CaseResult<2>*, const Watch<2>&);
template Row row_of<3>(const Case<3>&, const std::string&, const Options&, CaseResult<3>*, const Watch<3>&);

}  // namespace abut::studies::kinematics
