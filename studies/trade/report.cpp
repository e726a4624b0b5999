#include "studies/trade/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "abut/run/files.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/gnuplot.hpp"
#include "apps/support/preset.hpp"

namespace abut::studies::trade {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t columns = 3;     // of panels; the place after the last one has the key
constexpr double least_shown = 1e-17;  // zero has no place on a logarithmic axis

/// The word of the files for a model, and its points in the picture.
struct Mark {
    Model model;
    const char* word;
    int shape;
};
constexpr std::array<Mark, 6> marks{{{Model::reconstruction, "small + reconstruction", 7},
                                     {Model::pair_potential, "small + pair potential", 5},
                                     {Model::floating, "floating + pair potential", 9},
                                     {Model::rigid, "rigid + pair potential", 13},
                                     {Model::nodes, "nodes + small strain", 1},
                                     {Model::finite_nodes, "nodes + finite strain", 2}}};

std::string word_of(Model model) { return std::ranges::find(marks, model, &Mark::model)->word; }

std::string preset_of(const Setting& setting) {
    for (const auto& [name, preset] : apps::presets)
        if (apps::words_of(preset) == setting) return name;
    return "";
}

bool is_better(const Row& row, const Row& other, const Measure& measure) {
    const double error = row.outcome.errors.*measure.error, other_error = other.outcome.errors.*measure.error;
    return row.outcome.seconds <= other.outcome.seconds && error <= other_error &&
           (row.outcome.seconds < other.outcome.seconds || error < other_error);
}

bool is_on_front(const Row& row, const std::vector<Row>& rows, const Measure& measure) {
    if (std::isnan(row.outcome.errors.*measure.error)) return false;
    return std::ranges::none_of(rows, [&](const Row& other) {
        return other.problem == row.problem && other.finished() && is_better(other, row, measure);
    });
}

std::string csv_text(const std::vector<Row>& rows) {
    std::string text = "problem,level,setting,model,preset,finished,cells,steps,seconds,ratio";
    for (const Measure& measure : measures) text += fmt::format(",{0}_error,{0}_front", measure.key);
    text += ",energy_excess_max,parasitic_max,momentum_drift,pseudo_angular_momentum_drift,events,missed_contacts,message\n";
    for (const Row& row : rows) {
        const Outcome& outcome = row.outcome;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{}", row.problem, row.level, apps::quoted(row.setting),
                            word_of(row.model), preset_of(row.setting), row.finished() ? 1 : 0, outcome.cells, outcome.steps,
                            row.finished() ? apps::all_digits(outcome.seconds) : "", apps::all_digits(row.ratio));
        for (std::size_t i = 0; i < measures.size(); ++i)
            text += fmt::format(",{},{}", apps::all_digits(outcome.errors.*measures[i].error), row.on_front[i] ? 1 : 0);
        text += fmt::format(",{},{},{},{},{},{},{}\n", apps::all_digits(outcome.excess), apps::all_digits(outcome.parasitic),
                            apps::all_digits(outcome.momentum), apps::all_digits(outcome.pseudo_angular), outcome.events,
                            outcome.missed_contacts, apps::quoted(row.refusal));
    }
    return text;
}

Json to_json(const Row& row) {
    const Outcome& outcome = row.outcome;
    Json json{{"problem", row.problem}, {"level", row.level}, {"setting", row.setting}, {"model", word_of(row.model)}};
    if (!row.finished()) {
        json["message"] = row.refusal;
        return json;
    }
    json.update({{"cells", outcome.cells},
                 {"steps", outcome.steps},
                 {"seconds", outcome.seconds},
                 {"seconds_over_balanced", apps::json_number(row.ratio)},
                 {"errors", Json::object()},
                 {"on_front", Json::array()},
                 {"energy_excess_max", apps::json_number(outcome.excess)},
                 {"parasitic_max", apps::json_number(outcome.parasitic)},
                 {"momentum_drift", apps::json_number(outcome.momentum)},
                 {"pseudo_angular_momentum_drift", apps::json_number(outcome.pseudo_angular)},
                 {"events", outcome.events},
                 {"missed_contacts", outcome.missed_contacts}});
    for (std::size_t i = 0; i < measures.size(); ++i) {
        json["errors"][measures[i].key] = apps::json_number(outcome.errors.*measures[i].error);
        if (row.on_front[i]) json["on_front"].push_back(measures[i].key);
    }
    return json;
}

/// Settings that are on no front on any mesh of any problem: another one is at least as fast and as good each time.
std::vector<Setting> never_on_a_front(const std::vector<Row>& rows) {
    std::vector<Setting> never;
    for (const Row& row : rows) {
        const auto is_used = [&](const Row& other) {
            return other.setting == row.setting && std::ranges::find(other.on_front, true) != other.on_front.end();
        };
        if (std::ranges::none_of(rows, is_used) && std::ranges::find(never, row.setting) == never.end())
            never.push_back(row.setting);
    }
    return never;
}

/// Names of the problems that know this error.
std::vector<std::string> problems_with(const Measure& measure, const std::vector<Row>& rows) {
    std::vector<std::string> names;
    for (const Row& row : rows)
        if (row.finished() && !std::isnan(row.outcome.errors.*measure.error) &&
            std::ranges::find(names, row.problem) == names.end())
            names.push_back(row.problem);
    return names;
}

/// The runs on a front by their seconds, as data of gnuplot.
std::string front_data(const std::string& name, const std::string& problem, std::size_t measure,
                       const std::vector<Row>& rows) {
    std::vector<std::pair<double, double>> front;
    for (const Row& row : rows)
        if (row.problem == problem && row.on_front[measure])
            front.emplace_back(row.outcome.seconds, std::max(row.outcome.errors.*measures[measure].error, least_shown));
    std::ranges::sort(front);
    std::string text = name + " << EOD\n";
    for (const auto& [seconds, error] : front) text += fmt::format("{:.6g},{:.6g}\n", seconds, error);
    return text + "EOD\n";
}

constexpr std::array<const char*, 5> colours{"#2a78d6", "#8a4fc7", "#c2992b", "#3c9d5b", "#eb6834"};  // of the problems
constexpr std::array<int, 3> shapes{8, 6, 4};  // of the presets: triangle, circle, square

std::string colour_of(const std::string& problem) {
    const auto place = std::ranges::find(problems(), problem, &Problem::name) - problems().begin();
    return colours[static_cast<std::size_t>(place) % colours.size()];
}

/// What points and colours mean, for all panels.
std::vector<std::string> key(const std::vector<Row>& rows) {
    std::vector<std::string> lines;
    for (const Problem& problem : problems())
        if (std::ranges::find(rows, problem.name, &Row::problem) != rows.end())
            lines.push_back(fmt::format("keyentry with points pt 7 ps 0.9 lc rgb \"{}\" title \"{}\"",
                                        colour_of(problem.name), problem.name));
    for (const Mark& mark : marks)
        if (std::ranges::find(rows, mark.model, &Row::model) != rows.end())
            lines.push_back(
                fmt::format("keyentry with points pt {} ps 0.9 lc rgb \"black\" title \"{}\"", mark.shape, mark.word));
    for (std::size_t p = 0; p < apps::presets.size(); ++p)
        lines.push_back(fmt::format("keyentry with points pt {} ps 1.8 lw 1.5 lc rgb \"black\" title \"{}\"", shapes[p],
                                    apps::presets[p].first));
    return lines;
}

/// One error against the seconds: a colour per problem, a shape per model, the front of a problem a line.
std::string panel(std::size_t i, const std::vector<Row>& rows) {
    const Measure& measure = measures[i];
    const std::vector<std::string> names = problems_with(measure, rows);
    if (names.empty()) return "";
    const auto points = [&](const std::string& condition) {
        return fmt::format(
            "\"trade.csv\" using (({0}) && column(\"finished\")==1 ? column(\"seconds\") : NaN)"
            ":(column(\"{1}_error\") > {2:g} ? column(\"{1}_error\") : column(\"{1}_error\") >= 0 ? {2:g} : NaN)",
            condition, measure.key, least_shown);
    };
    std::string data;
    std::vector<std::string> lines;
    for (const std::string& name : names) {
        const std::string front = fmt::format("$front_{}_{}", measure.key, name), colour = colour_of(name);
        data += front_data(front, name, i, rows);
        for (const Mark& mark : marks) {
            const std::string is_its =
                fmt::format("strcol(\"problem\") eq \"{}\" && strcol(\"model\") eq \"{}\"", name, mark.word);
            lines.push_back(
                fmt::format("{} with points pt {} ps 0.8 lc rgb \"{}\" notitle", points(is_its), mark.shape, colour));
        }
        lines.push_back(fmt::format("{} using 1:2 with lines lw 1.5 lc rgb \"{}\" notitle", front, colour));
    }
    for (std::size_t p = 0; p < apps::presets.size(); ++p)
        lines.push_back(fmt::format("{} with points pt {} ps 1.8 lw 1.5 lc rgb \"black\" notitle",
                                    points(fmt::format("strcol(\"preset\") eq \"{}\"", apps::presets[p].first)), shapes[p]));
    for (const std::string& line : key(rows)) lines.push_back(line);
    return fmt::format("{}set origin {},{}\nset size 0.33,0.47\nset ylabel \"{}\" noenhanced\nplot {}\nset key off\n", data,
                       0.33 * static_cast<double>(i % columns), i < columns ? 0.48 : 0.0, measure.label,
                       fmt::join(lines, ", \\\n     "));
}

apps::Picture picture(const std::vector<Row>& rows) {
    std::string script =
        "set multiplot\nset logscale xy\nset format x \"10^{%T}\"\nset format y \"10^{%T}\"\nset xlabel \"seconds\"\n"
        "set key at screen 0.97,0.44 right top\n";
    for (std::size_t i = 0; i < measures.size(); ++i) script += panel(i, rows);
    return {.name = "pareto",
            .purpose = "Errors against seconds, and the runs that no other one beats, from trade.csv beside this file",
            .width = 1800,
            .script = script + "unset multiplot\n"};
}

}  // namespace

Model model_of(const run::RunOptions& run) {
    if (run.kinematics == run::BodyKinematics::floating) return Model::floating;
    if (run.kinematics == run::BodyKinematics::rigid) return Model::rigid;
    return run.law == solid::ContactLaw::pair_potential ? Model::pair_potential : Model::reconstruction;
}

Model model_of(const NodalRun& run) { return run.strain == nodal::Strain::small ? Model::nodes : Model::finite_nodes; }

void compare(std::vector<Row>& rows) {
    for (Row& row : rows) {
        if (!row.finished()) continue;
        for (std::size_t i = 0; i < measures.size(); ++i) row.on_front[i] = is_on_front(row, rows, measures[i]);
        for (const Row& other : rows)
            if (other.problem == row.problem && other.level == row.level && other.setting.empty() && other.finished())
                row.ratio = row.outcome.seconds / other.outcome.seconds;
    }
}

void print_head(const Problem& problem) {
    fmt::print("{}: {}\n  {:>4}  {:<52}{:>8}", problem.name, problem.text, "", "", "seconds");
    for (const Measure& measure : measures) fmt::print("{:>12}", measure.key);
    fmt::print("{:>9}{:>9}{:>9}{:>9}{:>8}{:>7}\n", "H - H~", "|e|/m v", "P", "J~", "events", "missed");
}

void print(const Row& row) {
    fmt::print("  {:>4}  {:<52}", row.level, row.setting.empty() ? "(defaults)" : row.setting);
    const Outcome& outcome = row.outcome;
    if (row.finished()) {
        fmt::print("{:>8.2g}", outcome.seconds);
        for (const Measure& measure : measures) fmt::print("{:>12}", apps::two_digits(outcome.errors.*measure.error));
        fmt::print("{:>9}{:>9}{:>9}{:>9}{:>8}{:>7}\n", apps::two_digits(outcome.excess), apps::two_digits(outcome.parasitic),
                   apps::two_digits(outcome.momentum), apps::two_digits(outcome.pseudo_angular), outcome.events,
                   outcome.missed_contacts);
    } else {
        fmt::print("\n        {}\n", row.refusal);
    }
    std::fflush(stdout);
}

void write_report(const apps::Program& program, const std::filesystem::path& out, const Json& options,
                  const std::vector<Row>& rows) {
    run::write_whole(out / "trade.csv", csv_text(rows));
    Json json{{"program", program.name}, {"version", ABUT_VERSION}, {"options", options}};
    const std::string without_picture = draw(out, picture(rows));
    if (!without_picture.empty()) json["without_picture"] = without_picture;
    json["never_on_a_front"] = never_on_a_front(rows);
    json["rows"] = Json::array();
    for (const Row& row : rows) json["rows"].push_back(to_json(row));
    apps::write_json(out / "summary.json", json);
    fmt::print("on no front of any problem: {}\n", fmt::join(never_on_a_front(rows), " | "));
    if (!without_picture.empty()) fmt::print("no picture: {}\n", without_picture);
    fmt::print("{} runs, {} of them not finished\nfiles: {}\n", rows.size(),
               std::ranges::count_if(rows, [](const Row& row) { return !row.finished(); }), out.string());
}

}  // namespace abut::studies::trade
