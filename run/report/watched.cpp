#include "abut/run/report/watched.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/drawing/plot.hpp"
#include "abut/run/files/files.hpp"

namespace abut::run {
namespace {

constexpr std::size_t most_figures = 4, most_rows = 20'000;
constexpr std::int64_t most_means = 1000;
constexpr std::array<const char*, 3> styles_of_axes{"blue", "orange", "teal"};

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    return cells;
}

double number_of(const std::string& cell) {
    double number = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(cell.data(), cell.data() + cell.size(), number);
    return number;
}

/// A table of comma-separated values without quotation marks, read row by row.
class CsvRows {
public:
    explicit CsvRows(const std::filesystem::path& path) : path_(path), file_(path) {
        std::string line;
        if (!std::getline(file_, line)) throw BadInput(path.string() + ": the table cannot be read for the report.");
        head_ = cells_of(line);
        for (std::string& name : head_) name = name.substr(0, name.find(" ["));  // a unit
    }
    [[nodiscard]] bool has(const std::string& name) const { return std::ranges::find(head_, name) != head_.end(); }
    /// Throws BadInput where there is none of that name.
    [[nodiscard]] std::size_t column(const std::string& name) const {
        if (!has(name)) throw BadInput(fmt::format("{}: a column {} is missing for the report.", path_.string(), name));
        return static_cast<std::size_t>(std::ranges::find(head_, name) - head_.begin());
    }
    /// The next row; nothing at the end.
    [[nodiscard]] std::optional<std::vector<std::string>> next() {
        std::string line;
        if (!std::getline(file_, line)) return {};
        std::vector<std::string> cells = cells_of(line);
        cells.resize(head_.size());
        return cells;
    }

private:
    std::filesystem::path path_;
    std::ifstream file_;
    std::vector<std::string> head_;
};

Markup figure(const Plot& plot, const std::string& caption) {
    return element("figure", drawing(plot) + element("figcaption", caption)) + "\n";
}

Markup left_out(std::size_t n, const char* what, const std::filesystem::path& table) {
    if (n <= most_figures) return {};
    return element("p", {{"class", "faint"}},
                   fmt::format("{} more {} are in {}.", n - most_figures, what, table.filename().string()));
}

/// Mean forces of a pair of bodies: normal, then by axis.
using Forces = std::vector<std::vector<double>>;

/// The middle of each interval that forces are means over.
struct Means {
    explicit Means(const SampledRun& run)
        : run_(run),
          n_rows_((run.steps + run.interval - 1) / run.interval),
          rows_of_each_(std::max<std::int64_t>(1, (n_rows_ + most_means - 1) / most_means)) {}
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>((n_rows_ + rows_of_each_ - 1) / rows_of_each_);
    }
    [[nodiscard]] std::size_t of_step(std::int64_t step) const {
        return static_cast<std::size_t>((step - 1) / run_.interval / rows_of_each_);
    }
    [[nodiscard]] std::int64_t begin(std::size_t i) const {
        return std::min(run_.steps, static_cast<std::int64_t>(i) * rows_of_each_ * run_.interval);
    }
    /// Part of its interval that a row at a step is about.
    [[nodiscard]] double share(std::int64_t step) const {
        const std::size_t i = of_step(step);
        return static_cast<double>(step - (step - 1) / run_.interval * run_.interval) /
               static_cast<double>(begin(i + 1) - begin(i));
    }
    [[nodiscard]] std::vector<double> times() const {
        std::vector<double> times;
        for (std::size_t i = 0; i < size(); ++i)
            times.push_back(0.5 * run_.dt * static_cast<double>(begin(i) + begin(i + 1)));
        return times;
    }

private:
    SampledRun run_;
    std::int64_t n_rows_;
    std::int64_t rows_of_each_;
};

double largest(const Forces& forces) { return std::ranges::max(forces.front()); }

Plot plot_of_forces(const std::string& title, const std::vector<double>& times, const Forces& forces) {
    Plot plot{.title = title,
              .x_label = "time [s]",
              .y_label = "force [N]",
              .x = times,
              .curves = {{"pressing", "ink", forces.front()}}};
    for (std::size_t axis = 0; axis + 1 < forces.size(); ++axis)
        plot.curves.push_back({fmt::format("along {}", "xyz"[axis]), styles_of_axes[axis], forces[axis + 1]});
    return plot;
}

/// Rows of some columns, thinned out as they come.
class Thinned {
public:
    explicit Thinned(std::size_t n_columns) : columns_(n_columns) {}

    void add(const std::vector<double>& row) {
        if (n_seen_++ % every_ != 0) return;
        for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].push_back(row[i]);
        if (columns_.front().size() < 2 * most_rows) return;
        every_ *= 2;
        for (auto& column : columns_) {
            for (std::size_t i = 0; i < most_rows; ++i) column[i] = column[2 * i];
            column.resize(most_rows);
        }
    }
    [[nodiscard]] const std::vector<double>& column(std::size_t i) const { return columns_[i]; }

private:
    std::vector<std::vector<double>> columns_;
    std::size_t n_seen_ = 0;
    std::size_t every_ = 1;
};

bool has_value(const std::vector<double>& values) {
    return std::ranges::any_of(values, [](double value) { return std::isfinite(value) && value != 0.0; });
}

}  // namespace

Markup force_pictures(const std::filesystem::path& table, const SampledRun& run) {
    CsvRows rows(table);
    const Means means(run);
    std::vector<std::size_t> columns{rows.column("normal_force")};
    for (const char* axis : {"force_on_2_x", "force_on_2_y", "force_on_2_z"})
        if (rows.has(axis)) columns.push_back(rows.column(axis));
    const std::size_t step_column = rows.column("step"), body_1 = rows.column("body_1"), body_2 = rows.column("body_2");
    std::map<std::pair<std::string, std::string>, Forces> by_pair;
    while (const auto row = rows.next()) {
        const auto step = static_cast<std::int64_t>(number_of((*row)[step_column]));
        if (step < 1 || step > run.steps) continue;
        const auto [pair, is_new] = by_pair.try_emplace({(*row)[body_1], (*row)[body_2]});
        if (is_new) pair->second.assign(columns.size(), std::vector<double>(means.size(), 0.0));
        for (std::size_t i = 0; i < columns.size(); ++i)
            pair->second[i][means.of_step(step)] += means.share(step) * number_of((*row)[columns[i]]);
    }
    std::vector<std::pair<std::pair<std::string, std::string>, Forces>> pairs(by_pair.begin(), by_pair.end());
    std::ranges::stable_sort(pairs, std::ranges::greater(), [](const auto& pair) { return largest(pair.second); });
    Markup figures;
    for (std::size_t i = 0; i < std::min(pairs.size(), most_figures); ++i) {
        const auto& [first, second] = pairs[i].first;
        figures +=
            figure(plot_of_forces(fmt::format("Forces of {} on {}", first, second), means.times(), pairs[i].second),
                   fmt::format("Force of '{}' on '{}', and what presses their faces together, summed over all of them.",
                               first, second));
    }
    return figures + left_out(pairs.size(), "pairs", table);
}

Markup probe_pictures(const std::filesystem::path& table, const std::vector<std::string>& probes) {
    CsvRows rows(table);
    const std::size_t n_drawn = std::min(probes.size(), most_figures);
    std::vector<std::size_t> columns{rows.column("time")};
    std::size_t dim = 0;
    for (std::size_t i = 0; i < n_drawn; ++i) {
        for (const char axis : {'x', 'y', 'z'})
            if (const std::string name = fmt::format("{}.displacement_{}", in_csv(probes[i]), axis); rows.has(name))
                columns.push_back(rows.column(name));
        columns.push_back(rows.column(in_csv(probes[i]) + ".von_mises"));
        if (i == 0) dim = columns.size() - 2;
    }
    Thinned values(columns.size());
    while (const auto row = rows.next()) {
        std::vector<double> numbers;
        for (const std::size_t column : columns) numbers.push_back(number_of((*row)[column]));
        values.add(numbers);
    }
    Markup figures;
    for (std::size_t i = 0; i < n_drawn; ++i) {
        const std::size_t begin = 1 + i * (dim + 1);
        Plot moved{.title = fmt::format("Displacement at {}", probes[i]),
                   .x_label = "time [s]",
                   .y_label = "displacement [m]",
                   .x = values.column(0),
                   .curves = {}};
        for (std::size_t axis = 0; axis < dim; ++axis)
            moved.curves.push_back(
                {fmt::format("along {}", "xyz"[axis]), styles_of_axes[axis], values.column(begin + axis)});
        figures += figure(moved, fmt::format("Displacement at '{}'.", probes[i]));
        if (!has_value(values.column(begin + dim))) continue;
        figures += figure({.title = fmt::format("Stress at {}", probes[i]),
                           .x_label = "time [s]",
                           .y_label = "stress [Pa]",
                           .x = values.column(0),
                           .curves = {{"von Mises stress", "ink", values.column(begin + dim)}}},
                          fmt::format("von Mises stress at '{}'.", probes[i]));
    }
    return figures + left_out(probes.size(), "probes", table);
}

}  // namespace abut::run
