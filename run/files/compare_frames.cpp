#include "abut/run/files/compare_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/input_file.hpp"
#include "abut/mesh/io/read_arrays.hpp"
#include "abut/run/files/compared_values.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;
using mesh::NamedArray;

struct ListedFrame {
    double time = 0.0;
    fs::path file;
};

/// Text between `before` and the next quotation mark, from `at` on.
std::string quoted_behind(const std::string& text, const std::string& before, std::size_t at) {
    const std::size_t begin = std::min(text.find(before, at), text.size() - before.size()) + before.size();
    return text.substr(begin, text.find('"', begin) - begin);
}

std::vector<ListedFrame> listed_frames(const fs::path& list) {
    const std::string text = file_bytes(list);
    std::vector<ListedFrame> frames;
    for (std::size_t at = text.find("<DataSet "); at != std::string::npos; at = text.find("<DataSet ", at + 1)) {
        const std::string time = quoted_behind(text, "timestep=\"", at);
        frames.push_back({.file = list.parent_path() / quoted_behind(text, "file=\"", at)});
        std::from_chars(time.data(), time.data() + time.size(), frames.back().time);
    }
    return frames;
}

std::string component(std::size_t i, std::size_t n) {
    constexpr std::array<const char*, 3> of_vector{"x", "y", "z"};
    constexpr std::array<const char*, 6> of_tensor{"xx", "yy", "zz", "xy", "yz", "xz"};
    if (n == of_vector.size()) return fmt::format(", {}", of_vector[i]);
    if (n == of_tensor.size()) return fmt::format(", {}", of_tensor[i]);
    return "";
}

/// A field in all frames so far.
struct FieldComparison {
    std::string name;
    NamedArray::Of of;
    std::size_t n_components;
    ComparedValues values;

    /// "velocity [m/s] of cell 12, x"
    [[nodiscard]] std::string place_name(std::int64_t index) const {
        if (of == NamedArray::Of::grid && n_components == 1) return fmt::format("{}[{}] of the mesh", name, index);
        const auto i = static_cast<std::size_t>(index);
        return fmt::format("{} of {} {}{}", of == NamedArray::Of::grid ? "position" : name,
                           of == NamedArray::Of::cells ? "cell" : "point", i / n_components,
                           component(i % n_components, n_components));
    }
    [[nodiscard]] ValueDifference described(const ComparedValues::Difference& difference) const {
        return values.described(difference, place_name(difference.place.index));
    }
};

const NamedArray* same_array(const std::vector<NamedArray>& arrays, const NamedArray& array) {
    const auto found = std::ranges::find_if(
        arrays, [&](const NamedArray& other) { return other.name == array.name && other.of == array.of; });
    return found == arrays.end() ? nullptr : &*found;
}

class SeriesComparison {
public:
    SeriesComparison(const fs::path& first, const fs::path& second, double tolerance)
        : first_(listed_frames(first)), second_(listed_frames(second)), tolerance_(tolerance) {
        result_.name = first.filename().string();
    }

    PartComparison run() && {
        const auto n = std::min(first_.size(), second_.size());
        while (frame_ < n && compare(first_[frame_], second_[frame_])) ++frame_;
        if (frame_ > 0 || n == 0) result_.compared = counted(static_cast<std::int64_t>(frame_), "frame");
        const auto more = std::max(std::ssize(first_), std::ssize(second_)) - static_cast<std::ptrdiff_t>(n);
        if (frame_ == n && more > 0)
            result_.lacks.push_back(
                fmt::format("{} more in the {} run", counted(more, "frame"), first_.size() > n ? "first" : "second"));
        tell_differences();
        return std::move(result_);
    }

private:
    /// False where nothing behind it can be compared.
    bool compare(const ListedFrame& a, const ListedFrame& b) {
        if (std::abs(a.time - b.time) > tolerance_ * std::max(std::abs(a.time), std::abs(b.time)))
            return end_with({"time of the frame [s]", shortest(a.time), shortest(b.time)});
        for (const ListedFrame* frame : {&a, &b})
            if (const auto ending = frame->file.extension(); ending != ".vtu" && ending != ".vtp") {
                result_.remarks.push_back("frames in pieces are not compared");
                return false;
            }
        return (tolerance_ == 0.0 && file_bytes(a.file) == file_bytes(b.file)) ||
               compare_arrays(mesh::read_arrays(a.file), mesh::read_arrays(b.file));
    }

    bool compare_arrays(const std::vector<NamedArray>& first, const std::vector<NamedArray>& second) {
        for (const NamedArray& array : first) {
            const NamedArray* other = same_array(second, array);
            if (!other)
                tell_lack(array, "first");
            else if (array.values.size() != other->values.size())
                return end_with({fmt::format("number of values of {}", array.name), fmt::format("{}", array.values.size()),
                                 fmt::format("{}", other->values.size())});
            else
                add(array, *other);
        }
        for (const NamedArray& array : second)
            if (!same_array(first, array)) tell_lack(array, "second");
        return true;
    }

    void add(const NamedArray& first, const NamedArray& second) {
        ComparedValues& values = field(first).values;
        ComparedValues::Place place{.row = static_cast<std::int64_t>(frame_), .time = first_[frame_].time};
        for (std::size_t i = 0; i < first.values.size(); ++i, ++place.index)
            values.add(first.values[i], second.values[i], place);
    }

    FieldComparison& field(const NamedArray& array) {
        const auto found = std::ranges::find_if(
            fields_, [&](const FieldComparison& field) { return field.name == array.name && field.of == array.of; });
        if (found != fields_.end()) return *found;
        fields_.push_back({array.name, array.of, array.n_components, ComparedValues(tolerance_)});
        return fields_.back();
    }

    void tell_lack(const NamedArray& array, const char* run) {
        const std::string text = fmt::format("field {} in the {} run only", array.name, run);
        if (std::ranges::find(result_.lacks, text) == result_.lacks.end()) result_.lacks.push_back(text);
    }

    bool end_with(const ValueDifference& difference) {
        end_ = difference;
        return false;
    }

    void tell_parting(std::int64_t frame, double time, const ValueDifference& value) {
        result_.parting = {fmt::format("frame {}", frame), time, value};
    }

    void tell_differences() {
        std::vector<ValueDifference> all;
        const FieldComparison* first = nullptr;
        for (const FieldComparison& field : fields_) {
            if (!field.values.differ()) continue;
            all.push_back(field.described(field.values.largest()));
            if (!first || field.values.first().place.row < first->values.first().place.row) first = &field;
        }
        if (first)
            tell_parting(first->values.first().place.row, first->values.first().place.time,
                         first->described(first->values.first()));
        else if (end_)
            tell_parting(static_cast<std::int64_t>(frame_), first_[frame_].time, *end_);
        if (first && end_)
            result_.remarks.push_back(fmt::format("from frame {} on frames are not compared: {} is {} | {}", frame_,
                                                  end_->name, end_->first, end_->second));
        result_.largest = largest_of(std::move(all));
    }

    std::vector<ListedFrame> first_, second_;
    double tolerance_;
    std::size_t frame_ = 0;
    std::vector<FieldComparison> fields_;
    std::optional<ValueDifference> end_;
    PartComparison result_;
};

}  // namespace

PartComparison compare_frames(const fs::path& first, const fs::path& second, double tolerance) {
    return SeriesComparison(first, second, tolerance).run();
}

}  // namespace abut::run
