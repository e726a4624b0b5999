#include "studies/trade/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "abut/run/files/files.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/preset.hpp"
#include "studies/schemes/gnuplot.hpp"
#include "studies/table/columns.hpp"

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
    const double error = row.outcome.*measure.error, other_error = other.outcome.*measure.error;
    return row.outcome.seconds_of_steps <= other.outcome.seconds_of_steps && error <= other_error &&
           (row.outcome.seconds_of_steps < other.outcome.seconds_of_steps || error < other_error);
}

bool is_on_front(const Row& row, const std::vector<Row>& rows, const Measure& measure) {
    if (std::isnan(row.outcome.*measure.error)) return false;
    return std::ranges::none_of(rows, [&](const Row& other) {
        return other.problem == row.problem && other.finished() && is_better(other, row, measure);
    });
}

const Columns<Row>& table() {
    static const Columns<Row> all = [] {
        const auto of = [](auto member) { return [=](const Row& row) { return row.outcome.*member; }; };
        Columns<Row> made{
            {"problem", "", 0, &Row::problem},
            {"level", "", 4, &Row::level},
            {"setting", "", 0, &Row::setting, "", true},
            {"", "", -54, [](const Row& row) { return "  " + (row.setting.empty() ? "(defaults)" : row.setting); }},
            {"model", "", 0, [](const Row& row) { return word_of(row.model); }},
            {"preset", "", 0, [](const Row& row) { return preset_of(row.setting); }},
            {"finished", "", 0, &Row::finished},
            {"cells", "", 0, of(&Outcome::cells)},
            {"steps", "", 0, of(&Outcome::steps)},
            {"seconds", "seconds", 8,
             [](const Row& row) { return row.finished() ? row.outcome.seconds_of_steps : run::not_given; }},
            {"ratio", "", 0, &Row::ratio}};
        for (std::size_t i = 0; i < measures.size(); ++i) {
            made.push_back({measures[i].key + "_error", measures[i].key, 12, of(measures[i].error)});
            made.push_back({measures[i].key + "_front", "", 0, [i](const Row& row) { return row.on_front[i]; }});
        }
        made.insert(made.end(), {{"energy_excess_max", "H - H~", 9, of(&Outcome::excess)},
                                 {"parasitic_max", "|e|/m v", 9, of(&Outcome::parasitic)},
                                 {"momentum_drift", "P", 9, of(&Outcome::momentum)},
                                 {"pseudo_angular_momentum_drift", "J~", 9, of(&Outcome::pseudo_angular)},
                                 {"events", "events", 8, of(&Outcome::events)},
                                 {"missed_contacts", "missed", 7, of(&Outcome::missed_contacts)},
                                 {"message", "", 0, &Row::refusal, "", true}});
        return made;
    }();
    return all;
}
constexpr std::size_t of_refused = 4;  // columns that are printed of a run that gave no numbers

Json to_json(const Row& row) {
    if (!row.finished())
        return {{"problem", row.problem},
                {"level", row.level},
                {"setting", row.setting},
                {"model", word_of(row.model)},
                {"message", row.refusal}};
    Json json = studies::to_json(members(table(), row));
    json["seconds_over_balanced"] = json["ratio"];
    json["errors"] = Json::object();
    json["on_front"] = Json::array();
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const std::string& key = measures[i].key;
        json["errors"][key] = json[key + "_error"];
        if (row.on_front[i]) json["on_front"].push_back(key);
        json.erase(key + "_error"), json.erase(key + "_front");
    }
    for (const char* of_files : {"ratio", "message", "finished", "preset"}) json.erase(of_files);
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
        if (row.finished() && !std::isnan(row.outcome.*measure.error) &&
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
            front.emplace_back(row.outcome.seconds_of_steps, std::max(row.outcome.*measures[measure].error, least_shown));
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

/// Meaning of points and colours, for all panels.
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

Picture picture(const std::vector<Row>& rows) {
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

Model model_of(const NodalRun& run) { return run.strain == Kinematics::small ? Model::nodes : Model::finite_nodes; }

void compare(std::vector<Row>& rows) {
    for (Row& row : rows) {
        if (!row.finished()) continue;
        for (std::size_t i = 0; i < measures.size(); ++i) row.on_front[i] = is_on_front(row, rows, measures[i]);
        for (const Row& other : rows)
            if (other.problem == row.problem && other.level == row.level && other.setting.empty() && other.finished())
                row.ratio = row.outcome.seconds_of_steps / other.outcome.seconds_of_steps;
    }
}

void print_head(const Problem& problem) { fmt::print("{}: {}\n  {}\n", problem.name, problem.text, heads(table())); }

void print(const Row& row) {
    fmt::print("  {}\n", line(table(), row, row.finished() ? table().size() : of_refused));
    if (!row.finished()) fmt::print("        {}\n", row.refusal);
    std::fflush(stdout);
}

void write_report(const apps::Program& program, const std::filesystem::path& out, const run::NamedValues& options,
                  const std::vector<Row>& rows) {
    run::write_whole(out / "trade.csv", csv_text(table(), rows));
    Json json = begun_summary(program);
    json["options"] = apps::to_json(options);
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
