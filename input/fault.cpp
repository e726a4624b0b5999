#include "abut/input/fault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "abut/run/user_words.hpp"

namespace abut::input {
namespace {

std::string headed(const std::vector<Fault>& faults) {
    return faults.size() == 1 ? text_of(faults) : fmt::format("{} faults\n{}", faults.size(), text_of(faults));
}

/// Number behind the last colon, which goes together with the colon; nothing where that is none.
std::optional<int> take_number(std::string_view& where) {
    const std::size_t colon = where.rfind(':');
    if (colon == std::string_view::npos) return std::nullopt;
    int number = 0;
    const char *begin = where.data() + colon + 1, *end = where.data() + where.size();
    const auto [stop, error] = std::from_chars(begin, end, number);
    if (error != std::errc{} || stop != end) return std::nullopt;
    where = where.substr(0, colon);
    return number;
}

/// Without a line, or not of a file; then line and column.
std::tuple<int, int, int> place_of(const Fault& fault) {
    std::string_view where = fault.where;
    if (where.starts_with("--")) return {2, 0, 0};
    const auto column = take_number(where);
    const auto line = column ? take_number(where) : std::nullopt;
    return line ? std::tuple(0, *line, *column) : std::tuple(1, 0, 0);
}

}  // namespace

std::vector<Fault> in_order(std::vector<Fault> faults) {
    for (Fault& fault : faults) fault.text = run::with_keys(run::in_user_words(std::move(fault.text)));
    std::ranges::stable_sort(faults, {}, place_of);
    return faults;
}

std::string text_of(const std::vector<Fault>& faults) {
    std::string text;
    for (const Fault& fault : faults) text += (text.empty() ? "" : "\n") + fault.where + ": " + fault.text;
    return text;
}

SceneError::SceneError(std::vector<Fault> faults) : BadInput(headed(in_order(faults))), faults_(in_order(faults)) {}

}  // namespace abut::input
