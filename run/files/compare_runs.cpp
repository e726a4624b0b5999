#include "abut/run/files/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/base/input_file.hpp"
#include "abut/run/files/compare_checkpoints.hpp"
#include "abut/run/files/compare_frames.hpp"
#include "abut/run/files/compare_tables.hpp"
#include "abut/run/files/compared_values.hpp"
#include "abut/run/files/json.hpp"
#include "abut/run/option_table.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;

void require_results(const fs::path& folder) {
    for (const char* name : {"summary.json", "energy.csv", "energy.csv.partial"})
        if (fs::is_regular_file(folder / name)) return;
    throw BadInput(
        folder.string() +
        ": no folder of results: neither summary.json nor energy.csv.partial is in it. Give the folder of --out of a "
        "run.");
}

// summary.json -----------------------------------------------------------------------------------------------------------

/// Nothing of a run that is under way or broke off.
std::optional<Json> summary_of(const fs::path& folder) {
    const fs::path path = folder / "summary.json";
    if (!fs::exists(path)) return {};
    Json summary = Json::parse(file_bytes(path), nullptr, false);
    if (!summary.is_object()) throw BadInput(fmt::format("{}: not a summary of a run: no object of JSON.", path.string()));
    return summary;
}

void require_same_dimension(const Json& first, const Json& second) {
    const auto dim = [](const Json& summary) {
        const auto found = summary.find("dim");
        return found != summary.end() && found->is_number_integer() ? found->get<int>() : 0;
    };
    const int a = dim(first), b = dim(second);
    if (a != b)
        throw BadInput(
            fmt::format("the first run is in {}D, the second in {}D: their values cannot be compared. Give two runs "
                        "of the same dimension.",
                        a, b));
}

/// Whether a value may differ between two runs that are the same.
bool is_free(const std::string& key) {
    for (const char* part : {"program", "version", "contact_share", "rebuilds", "candidates", "resumed_after",
                             "rebalancing.", "options.scene", "options.skin"})
        if (key.starts_with(part)) return true;
    for (const Option<RunOptions>& option : run_options())
        if (option.free_on_resume && (key + ".").starts_with("options." + option.name + ".")) return true;
    return key.find("seconds") != std::string::npos;
}

/// Whether a value is given, not found by the run.
bool is_setting(const std::string& key) {
    if (key.starts_with("options.")) return true;
    if (key == "cells" || key == "boundary_faces" || key == "dt") return true;
    const auto holds = [&](const char* part) { return key.find(part) != std::string::npos; };
    return key.starts_with("bodies.") && (holds(".name") || holds(".mass") || holds(".velocity_initial"));
}

/// Values by their keys, "bodies.0.mass".
Json flat(const Json& summary) {
    Json values = Json::object();
    const Json by_pointer = summary.flatten();
    for (const auto& [pointer, value] : by_pointer.items()) {
        if (pointer.empty()) continue;  // of a summary without any
        std::string key = pointer.substr(1);
        std::ranges::replace(key, '/', '.');
        if (!is_free(key)) values[key] = value;
    }
    return values;
}

std::string shown(const Json& value) { return value.is_string() ? value.get<std::string>() : text_of(value); }

ValueDifference difference_of(const std::string& key, const Json& a, const Json& b) {
    const ValueDifference difference{.name = key, .first = shown(a), .second = shown(b)};
    if (!a.is_number() || !b.is_number()) return difference;
    ComparedValues values(0.0);
    values.add(a.get<double>(), b.get<double>(), {});
    return values.differ() ? values.described(values.first(), key) : difference;
}

/// Counts and what is true or false: no fractions, and no texts, which quote them.
bool is_whole(const Json& value) { return value.is_number_integer() || value.is_boolean() || value.is_null(); }

struct SummaryComparison {
    std::vector<ValueDifference> settings;
    PartComparison figures;
};

void tell_figure(PartComparison& figures, const ValueDifference& difference, bool are_numbers) {
    if (!figures.parting) figures.parting = {.place = "", .value = difference};
    if (are_numbers) figures.largest.push_back(difference);
}

SummaryComparison compare_summaries(const Json& first, const Json& second, double tolerance) {
    SummaryComparison result{.figures = {.name = "summary.json"}};
    Json a = flat(first), b = flat(second);
    for (const auto& [key, value] : b.items())
        if (!a.contains(key)) a[key] = "nothing";
    std::int64_t n = 0;
    for (const auto& [key, value] : a.items()) {
        const Json other = b.value(key, Json("nothing"));
        const bool is_told = is_setting(key);
        if (!is_told && tolerance > 0.0 && !is_whole(value) && !is_whole(other)) continue;
        n += is_told ? 0 : 1;
        if (value == other) continue;
        const ValueDifference difference = difference_of(key, value, other);
        if (is_told)
            result.settings.push_back(difference);
        else
            tell_figure(result.figures, difference, value.is_number() && other.is_number());
    }
    result.figures.compared = counted(n, "figure");
    result.figures.largest = largest_of(std::move(result.figures.largest));
    return result;
}

// Files ------------------------------------------------------------------------------------------------------------------

/// Names with one of two endings, without the second: "energy.csv" of energy.csv.partial.
std::set<std::string> names_in(const fs::path& folder, const std::string& ending) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::string name = entry.path().filename().string();
        if (name.ends_with(ending + ".partial")) name.resize(name.size() - std::string_view(".partial").size());
        if (name.ends_with(ending)) names.insert(name);
    }
    return names;
}

fs::path whole_or_partial(const fs::path& folder, const std::string& name) {
    return fs::exists(folder / name) ? folder / name : folder / (name + ".partial");
}

using CompareFiles = std::function<PartComparison(const fs::path&, const fs::path&)>;

void compare_files(const fs::path& first, const fs::path& second, const std::string& ending, const CompareFiles& compare,
                   std::vector<PartComparison>& parts) {
    const std::set<std::string> in_first = names_in(first, ending), in_second = names_in(second, ending);
    std::set<std::string> all = in_first;
    all.insert(in_second.begin(), in_second.end());
    for (const std::string& name : all) {
        if (in_first.contains(name) && in_second.contains(name))
            parts.push_back(compare(whole_or_partial(first, name), whole_or_partial(second, name)));
        else
            parts.push_back(
                {.name = name, .lacks = {fmt::format("in the {} run only", in_first.contains(name) ? "first" : "second")}});
    }
}

/// Frames of both in one file of HDF5.
PartComparison left_out(const fs::path& first, const fs::path&) {
    fs::path name = first.filename();
    if (name.extension() == ".partial") name.replace_extension();
    return {.name = name.string(), .remarks = {"frames in one file of HDF5 are not compared"}};
}

}  // namespace

RunComparison compare_runs(const fs::path& first, const fs::path& second, double tolerance) {
    for (const fs::path* folder : {&first, &second}) require_results(*folder);
    RunComparison result;
    const std::optional<Json> a = summary_of(first), b = summary_of(second);
    if (a && b) require_same_dimension(*a, *b);
    const auto tables = [&](const fs::path& x, const fs::path& y) { return compare_tables(x, y, tolerance); };
    const auto frames = [&](const fs::path& x, const fs::path& y) { return compare_frames(x, y, tolerance); };
    compare_files(first, second, ".csv", tables, result.parts);
    compare_files(first, second, ".pvd", frames, result.parts);
    if (auto checkpoints = compare_checkpoints(first / "checkpoints", second / "checkpoints", tolerance))
        result.parts.push_back(std::move(*checkpoints));
    compare_files(first, second, ".h5", left_out, result.parts);
    if (!a || !b) return result;
    auto [settings, figures] = compare_summaries(*a, *b, tolerance);
    result.settings = std::move(settings);
    result.parts.push_back(std::move(figures));
    return result;
}

}  // namespace abut::run
