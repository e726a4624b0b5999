#include "abut/run/files/compare_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/run/files/compared_values.hpp"

namespace abut::run {
namespace {

std::optional<double> number_in(std::string_view cell) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    return error == std::errc{} && end == cell.data() + cell.size() ? std::optional(number) : std::nullopt;
}

/// Commas between quotation marks belong to a text.
void split_line(const std::string& line, std::vector<std::string_view>& cells) {
    cells.clear();
    bool is_quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') is_quoted = !is_quoted;
        if (line[i] != ',' || is_quoted) continue;
        cells.push_back(std::string_view(line).substr(begin, i - begin));
        begin = i + 1;
    }
    cells.push_back(std::string_view(line).substr(begin));
}

/// Lines of a table, one at a time.
class TableLines {
public:
    explicit TableLines(const std::filesystem::path& path) {
        if (std::filesystem::is_regular_file(path)) file_.open(path, std::ios::binary);
        if (!file_.is_open())
            throw BadInput(path.string() + ": the table cannot be read. See that it is a file, and that it may be read.");
        next();
    }
    /// False at the end. `cells` are those of the line.
    bool next() {
        const bool is_there = static_cast<bool>(std::getline(file_, line_));
        is_half_written_ = is_there && file_.eof();
        if (!is_there || is_half_written_) line_.clear();
        split_line(line_, cells_);
        return is_there && !is_half_written_;
    }
    [[nodiscard]] std::int64_t skip_rest() {
        std::int64_t n = 0;
        while (next()) ++n;
        return n;
    }
    [[nodiscard]] bool is_half_written() const { return is_half_written_; }
    [[nodiscard]] const std::string& line() const { return line_; }
    [[nodiscard]] const std::vector<std::string_view>& cells() const { return cells_; }
    [[nodiscard]] std::string_view cell(std::size_t column) const {
        return column < cells_.size() ? cells_[column] : std::string_view();
    }

private:
    std::ifstream file_;
    std::string line_;
    std::vector<std::string_view> cells_;
    bool is_half_written_ = false;
};

/// A column that both tables have.
struct Column {
    std::string name;
    std::size_t first, second;  // numbers of it
    ComparedValues values;
};

class TableComparison {
public:
    TableComparison(const std::filesystem::path& first, const std::filesystem::path& second, double tolerance)
        : first_(first), second_(second), has_same_head_(first_.line() == second_.line()) {
        result_.name = first.filename().string();
        if (result_.name.ends_with(".partial")) result_.name = second.filename().string();
        if (first_.line().empty() || second_.line().empty())
            result_.remarks.push_back(
                fmt::format("the table of the {} run has no heading yet", first_.line().empty() ? "first" : "second"));
        else
            match_columns(tolerance);
    }

    PartComparison run() && {
        bool belong_together = true;
        while (belong_together && take_rows()) belong_together = compare_rows();
        if (belong_together) tell_rows_of_one();
        tell_half_written();
        result_.compared = counted(row_, "row") + ", " + counted(std::ssize(columns_), "column");
        tell_differences();
        return std::move(result_);
    }

private:
    void match_columns(double tolerance) {
        const auto &a = first_.cells(), &b = second_.cells();
        for (std::size_t i = 0; i < a.size(); ++i)
            if (const auto other = std::ranges::find(b, a[i]); other != b.end())
                columns_.push_back(
                    {std::string(a[i]), i, static_cast<std::size_t>(other - b.begin()), ComparedValues(tolerance)});
            else
                result_.lacks.push_back(fmt::format("column {} in the first run only", a[i]));
        for (const std::string_view name : b)
            if (std::ranges::find(a, name) == a.end())
                result_.lacks.push_back(fmt::format("column {} in the second run only", name));
    }

    bool take_rows() {
        has_first_ = first_.next();
        has_second_ = second_.next();
        return has_first_ && has_second_;
    }

    /// Step and time of the row as the first run has them.
    [[nodiscard]] ComparedValues::Place place() const {
        ComparedValues::Place place{.row = row_};
        for (const Column& column : columns_) {
            const auto number = number_in(first_.cell(column.first));
            if (number && column.name == "step") place.step = static_cast<std::int64_t>(*number);
            if (number && column.name == "time [s]") place.time = *number;
        }
        return place;
    }

    /// False where the rows are about other steps or bodies.
    bool compare_rows() {
        const bool is_same = has_same_head_ && first_.line() == second_.line();
        ++row_;
        const ComparedValues::Place here = place();
        if (!is_same && are_of_others(here)) return false;
        constexpr double none = std::numeric_limits<double>::quiet_NaN();  // of an empty cell beside a number
        for (Column& column : columns_) {
            const auto x = number_in(first_.cell(column.first)), y = is_same ? x : number_in(second_.cell(column.second));
            if (x || y) column.values.add(x.value_or(none), y.value_or(none), here);
        }
        return true;
    }
    /// Whether the step or a text differs.
    bool are_of_others(const ComparedValues::Place& here) {
        for (const Column& column : columns_) {
            const std::string_view a = first_.cell(column.first), b = second_.cell(column.second);
            if (a == b || (column.name != "step" && (number_in(a) || number_in(b)))) continue;
            other_rows_ = {here, {column.name, std::string(a), std::string(b)}};
            return true;
        }
        return false;
    }

    void tell_rows_of_one() {
        if (!has_first_ && !has_second_) return;
        const std::int64_t n = 1 + (has_first_ ? first_ : second_).skip_rest();
        result_.lacks.push_back(fmt::format("{} more in the {} run", counted(n, "row"), has_first_ ? "first" : "second"));
    }

    void tell_half_written() {
        for (const auto& [lines, run] : {std::pair{&first_, "first"}, std::pair{&second_, "second"}})
            if (lines->is_half_written())
                result_.remarks.push_back(fmt::format("the last line of the {} run is half-written and left out", run));
    }

    void tell_parting(const ComparedValues::Place& place, const ValueDifference& value) {
        const std::string step = place.step < 0 ? "" : fmt::format(", step {}", place.step);
        result_.parting = {fmt::format("row {}{}", place.row, step), place.time, value};
    }

    void tell_differences() {
        std::vector<ValueDifference> all;
        const Column* first = nullptr;
        for (const Column& column : columns_) {
            if (!column.values.differ()) continue;
            all.push_back(column.values.described(column.values.largest(), column.name));
            if (!first || column.values.first().place.row < first->values.first().place.row) first = &column;
        }
        if (first)
            tell_parting(first->values.first().place, first->values.described(first->values.first(), first->name));
        else if (other_rows_)
            tell_parting(other_rows_->first, other_rows_->second);
        if (other_rows_)
            result_.remarks.push_back(fmt::format("from row {} on rows are of another {}, and are not compared",
                                                  other_rows_->first.row, other_rows_->second.name));
        result_.largest = largest_of(std::move(all));
    }

    TableLines first_, second_;
    bool has_same_head_, has_first_ = false, has_second_ = false;
    std::vector<Column> columns_;
    std::int64_t row_ = 0;
    std::optional<std::pair<ComparedValues::Place, ValueDifference>> other_rows_;
    PartComparison result_;
};

}  // namespace

PartComparison compare_tables(const std::filesystem::path& first, const std::filesystem::path& second, double tolerance) {
    return TableComparison(first, second, tolerance).run();
}

}  // namespace abut::run
