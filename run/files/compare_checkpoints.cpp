#include "abut/run/files/compare_checkpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/files/checkpoint_file.hpp"
#include "abut/run/files/compared_values.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;

std::set<std::string> checkpoints_in(const fs::path& folder) {
    std::set<std::string> names;
    std::error_code none;
    for (fs::directory_iterator entry(folder, none), end; !none && entry != end; entry.increment(none))
        if (const std::string name = entry->path().filename().string(); name.starts_with("step_") && name.ends_with(".h5"))
            names.insert(name);
    return names;
}

class CheckpointComparison {
public:
    CheckpointComparison(const Checkpoint& first, const Checkpoint& second, double tolerance)
        : first_(first), second_(second), tolerance_(tolerance) {}

    PartComparison run() && {
        result_.name = "checkpoint";
        result_.compared = fmt::format("step {}: positions, momenta", first_.motion.steps);
        const dynamics::IntegratorState &a = first_.motion, &b = second_.motion;
        compare("time", std::vector{a.time}, std::vector{b.time});
        compare("dt", std::vector{a.dt}, std::vector{b.dt});
        compare("q", a.q, b.q);
        compare("p_before", a.p_before, b.p_before);
        compare("p_after", a.p_after, b.p_after);
        compare("of_scheme", a.of_scheme, b.of_scheme);
        compare_rest();
        result_.largest = largest_of(std::move(result_.largest));
        return std::move(result_);
    }

private:
    void compare(const char* name, std::span<const double> a, std::span<const double> b) {
        if (a.size() != b.size())
            return tell({fmt::format("numbers in {}", name), fmt::format("{}", a.size()), fmt::format("{}", b.size())});
        ComparedValues values(tolerance_);
        for (std::size_t i = 0; i < a.size(); ++i) values.add(a[i], b[i], {.index = static_cast<std::int64_t>(i)});
        if (!values.differ()) return;
        const auto named = [&](const ComparedValues::Difference& difference) {
            return values.described(difference, fmt::format("{}[{}]", name, difference.place.index));
        };
        tell(named(values.first()));
        result_.largest.push_back(named(values.largest()));
    }

    /// Counts of searches are among them, and differ between a run and the same one that was stopped.
    void compare_rest() {
        if (tolerance_ > 0.0)
            result_.remarks = {"states of loads, materials and contact are not compared with a tolerance"};
        else if (first_.solid == second_.solid && first_.looks == second_.looks)
            result_.compared += ", loads, materials and contact";
        else
            result_.remarks = {"states of loads, materials and contact differ bitwise, as counts of searches in them may"};
    }

    void tell(const ValueDifference& value) {
        if (!result_.parting) result_.parting = {fmt::format("step {}", first_.motion.steps), first_.motion.time, value};
    }

    const Checkpoint &first_, &second_;
    double tolerance_;
    PartComparison result_;
};

}  // namespace

std::optional<PartComparison> compare_checkpoints(const fs::path& first, const fs::path& second, double tolerance) {
    const std::set<std::string> a = checkpoints_in(first), b = checkpoints_in(second);
    if (a.empty() && b.empty()) return {};
    PartComparison none{.name = "checkpoint"};
    const auto common = std::ranges::find_if(a, [&](const std::string& name) { return b.contains(name); });
    if (common == a.end()) {
        none.remarks = {"not compared: the two runs have none of the same step"};
        return none;
    }
    try {
        return CheckpointComparison(read_checkpoint(first / *common), read_checkpoint(second / *common), tolerance).run();
    } catch (const BadInput& error) {
        none.remarks = {std::string("not compared: ") + error.what()};
        return none;
    }
}

}  // namespace abut::run
