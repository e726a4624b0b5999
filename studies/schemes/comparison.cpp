#include "studies/schemes/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "abut/base/error.hpp"
#include "abut/run/files/files.hpp"
#include "apps/support/command_line.hpp"

namespace abut::studies {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::int64_t about_rows = 10'000;

/// Findings known of every run, then those of its scene.
std::vector<run::Finding> all_findings(const SchemeRun& run) {
    const double scale = run.energy_scale;
    std::vector<run::Finding> findings = {
        {"broken_off_time", "breaks off at [s]", run.broken_off ? run::Value(run.broken_off->time) : run::Value()},
        {"energy_error_relative", "true energy, max |H - H0| / H0", run.energy_error / scale},
        {"drift_relative", "drift of its own energy / H0", run.drift / scale},
        {"excess_relative", "max (H - H~) / H0", run.excess / scale},
        {"parasitic_max", "parasitic mode, max |e|/m [m/s]", run.parasitic},
        {"gauge_defect_max", "max |psi - sqrt(2 (V + c))| [J^1/2]",
         run.gauge_defect ? run::Value(*run.gauge_defect) : run::Value()}};
    findings.insert(findings.end(), run.findings.begin(), run.findings.end());
    findings.push_back({"force_evaluations", "bonds evaluated", run.evaluations});
    findings.push_back({"seconds", "time of the steps [s]", run.seconds});
    return findings;
}

Json run_json(const SchemeRun& run) {
    Json json = {
        {"steps", run.steps}, {"dt", run.dt}, {"energy_initial", run.energy_start}, {"energy_scale", run.energy_scale}};
    for (const run::Finding& finding : all_findings(run)) json[finding.key] = apps::to_json(finding.value);
    if (run.broken_off) json["broken_off_why"] = run.broken_off->why;
    return json;
}

std::string value_text(const run::Value& value) {
    if (std::holds_alternative<std::monostate>(value)) return "-";
    const double* number = std::get_if<double>(&value);
    return number ? fmt::format("{:.5g}", *number)
                  : apps::to_json(value).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void print_line(const std::string& name, const std::vector<std::string>& values) {
    fmt::print("  {:<42}", name);
    for (const auto& value : values) fmt::print("{:>16}", value);
    fmt::print("\n");
}

void print_runs(const std::vector<SchemeRun>& runs) {
    std::vector<std::string> names;
    std::vector<std::vector<run::Finding>> findings;
    for (const SchemeRun& run : runs) names.push_back(run.name);
    for (const SchemeRun& run : runs) findings.push_back(all_findings(run));
    print_line("", names);
    for (std::size_t line = 0; line < findings.front().size(); ++line) {
        std::vector<std::string> values;
        for (const auto& of_run : findings) values.push_back(value_text(of_run[line].value));
        if (std::ranges::any_of(values, [](const auto& value) { return value != "-"; }))
            print_line(findings.front()[line].text, values);
    }
}

Json summary(const apps::Program& program, const Comparison& comparison) {
    Json json = {{"program", program.name}, {"version", ABUT_VERSION}};
    for (const run::Finding& finding : comparison.findings) json[finding.key] = apps::to_json(finding.value);
    for (const SchemeRun& run : comparison.runs) json["schemes"][run.name] = run_json(run);
    json["options"] = apps::to_json(comparison.options);
    return json;
}

void throw_if_broken_off(const std::vector<SchemeRun>& runs) {
    std::vector<std::string> broken;
    for (const SchemeRun& run : runs)
        if (run.broken_off)
            broken.push_back(fmt::format("{} breaks off at step {}, t = {:.4g} s (steps of {:.4g} s): {}", run.name,
                                         run.broken_off->step, run.broken_off->time, run.dt, run.broken_off->why));
    if (!broken.empty())
        throw std::runtime_error(fmt::format("{} The figures are those until then.", fmt::join(broken, " ")));
}

}  // namespace

double detail::clock_seconds() {
    static const double seconds = [] {
        constexpr int times = 10'000;
        double sum = 0.0;
        for (int i = 0; i < times; ++i) const Stopwatch watch(sum);
        return sum / times;
    }();
    return seconds;
}

void add_interval_option(apps::CommandParser& parser, int& interval) {
    apps::add_count(parser, "--interval", interval, "steps between two rows of the files; 0: about 10,000 rows", 0)
        .group("Output");
}

std::int64_t rows_interval(int given, std::int64_t steps) {
    return given > 0 ? given : std::max<std::int64_t>(1, steps / about_rows);
}

run::FolderLock prepare_results(const apps::Program& program, const fs::path& out, std::vector<std::string> more) {
    for (const Scheme scheme : all_schemes) more.push_back(name_of(scheme) + ".csv");
    more.insert(more.end(), {"summary.json", program.name + ".gp", program.name + ".png"});
    run::FolderLock lock(out, program.name);
    run::claim_results(out, more);
    return lock;
}

void report(const apps::Program& program, const fs::path& out, const Comparison& comparison) {
    std::vector<std::string> files;
    for (const SchemeRun& run : comparison.runs)
        if (!run.series.rows.empty()) {
            files.push_back((out / (run.name + ".csv")).string());
            apps::write_csv(files.back(), run.series);
        }
    const std::string without_picture = draw(out, comparison.picture);
    apps::write_json(out / "summary.json", summary(program, comparison));
    fmt::print("{}: {}\n", program.name, comparison.title);
    print_runs(comparison.runs);
    for (const run::Finding& finding : comparison.findings) print_line(finding.text, {value_text(finding.value)});
    fmt::print("Files\n");
    fmt::print("  {:<12}{}\n", "summary", (out / "summary.json").string());
    if (!files.empty()) fmt::print("  {:<12}{}\n", "series", fmt::join(files, ", "));
    fmt::print("  {:<12}{}\n", "picture",
               without_picture.empty() ? (out / (program.name + ".png")).string() : "none: " + without_picture);
    throw_if_broken_off(comparison.runs);
}

}  // namespace abut::studies
