#include "apps/abut/diff.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/text.hpp"
#include "abut/input/changes.hpp"
#include "abut/input/fault.hpp"
#include "abut/run/files/compare_runs.hpp"
#include "apps/abut/restart.hpp"

namespace abut::apps {
namespace {

using run::PartComparison;
using run::RunComparison;
using run::ValueDifference;

constexpr std::size_t most_settings = 5, most_lacks = 3, longest_value = 60;

std::string values_of(const ValueDifference& difference) {
    return fmt::format("{} | {}", shortened(difference.first, longest_value), shortened(difference.second, longest_value));
}

std::string relative_of(const ValueDifference& difference) {
    return std::isfinite(difference.relative) ? fmt::format("{:.2g}", difference.relative) : "no number";
}

/// "row 3, step 10, t = 0.9 s"; nothing at the end of a run.
std::string place_of(const run::Parting& parting) {
    if (parting.place.empty()) return "";
    return std::isnan(parting.time) ? parting.place : fmt::format("{}, t = {:g} s", parting.place, parting.time);
}

std::string line(const std::string& name, const std::string& text) { return fmt::format("  {:<18} {}\n", name, text); }

/// The first items, and how many more there are.
std::vector<std::string> first_of(std::vector<std::string> items, std::size_t most) {
    if (items.size() <= most) return items;
    const std::size_t more = items.size() - most;
    items.resize(most);
    items.push_back(fmt::format("and {} more", more));
    return items;
}

// The verdict ------------------------------------------------------------------------------------------------------------

std::string verdict_of_same(double tolerance) {
    return tolerance == 0.0 ? "bitwise identical"
                            : fmt::format("the same within {:g} of the largest value of each column and field", tolerance);
}

std::string verdict(const DiffOptions& options, const RunComparison& comparison) {
    const std::string runs = fmt::format("{} and {}", options.first.string(), options.second.string());
    if (comparison.is_same()) {
        const bool is_all = std::ranges::all_of(comparison.parts, [](const auto& part) { return part.remarks.empty(); });
        return fmt::format("{} are {}{}.\n", runs, verdict_of_same(options.tolerance),
                           is_all ? "" : " in all that was compared");
    }
    const PartComparison* first = comparison.first_to_part();
    if (!first) return fmt::format("{} are {} in all that both have.\n", runs, verdict_of_same(options.tolerance));
    const run::Parting& parting = *first->parting;
    const std::string place = place_of(parting);
    return fmt::format("{} differ, first in {}{}{}: {} is {}.\n", runs, first->name, place.empty() ? "" : " at ", place,
                       parting.value.name, values_of(parting.value));
}

// Lines below it ---------------------------------------------------------------------------------------------------------

/// Keys that differ, of the copies of the scenes beside the checkpoints; nothing where one has none.
std::vector<std::string> scene_changes(const DiffOptions& options) {
    const auto first = scene_for_restart(options.first), second = scene_for_restart(options.second);
    if (!std::filesystem::exists(first) || !std::filesystem::exists(second)) return {};
    try {
        return input::changed_keys(first, second);
    } catch (const input::SceneError&) {
        return {"one of the copies cannot be read"};
    }
}

std::string settings_line(const std::vector<ValueDifference>& settings) {
    std::vector<std::string> items;
    for (const ValueDifference& one : settings) items.push_back(fmt::format("{} {}", one.name, values_of(one)));
    return items.empty() ? "" : line("settings", fmt::format("{}", fmt::join(first_of(items, most_settings), "; ")));
}

std::string scene_line(const DiffOptions& options) {
    const std::vector<std::string> changes = first_of(scene_changes(options), most_settings);
    return changes.empty() ? "" : line("scene", fmt::format("{}", fmt::join(changes, "; ")));
}

std::string difference_text(const PartComparison& part) {
    std::vector<std::string> texts;
    if (part.parting) {
        const std::string place = place_of(*part.parting);
        texts.push_back(fmt::format("{}{} {}", place.empty() ? "" : "from " + place + " on: ", part.parting->value.name,
                                    values_of(part.parting->value)));
    }
    std::vector<std::string> largest;
    for (const ValueDifference& one : part.largest) largest.push_back(fmt::format("{} {}", one.name, relative_of(one)));
    if (!largest.empty()) texts.push_back(fmt::format("largest: {}", fmt::join(largest, ", ")));
    for (const std::string& lack : first_of(part.lacks, most_lacks)) texts.push_back(lack);
    return fmt::format("{}", fmt::join(texts, "; "));
}

/// Lines of the parts: those that differ first, then the others in one, and remarks.
std::string part_lines(const std::vector<PartComparison>& parts) {
    std::string different, remarks;
    std::vector<std::string> same;
    for (const PartComparison& part : parts) {
        if (!part.is_same())
            different += line(part.name, difference_text(part));
        else if (!part.compared.empty())
            same.push_back(fmt::format("{} ({})", part.name, part.compared));
        for (const std::string& remark : part.remarks) remarks += line("note", part.name + ": " + remark);
    }
    return different + (same.empty() ? "" : line("the same", fmt::format("{}", fmt::join(same, ", ")))) + remarks;
}

}  // namespace

DiffAnswer diff(const DiffOptions& options) {
    const RunComparison comparison = run::compare_runs(options.first, options.second, options.tolerance);
    return {verdict(options, comparison) + scene_line(options) + settings_line(comparison.settings) +
                part_lines(comparison.parts),
            comparison.is_same()};
}

}  // namespace abut::apps
