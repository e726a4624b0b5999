#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace abut::run {

/// Value that a summary may hold under a name; std::monostate is "not known" (null in summary.json, as is a number that is
/// not finite).
using Value = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<std::int64_t>,
                           std::vector<double>, std::vector<std::string>>;

struct NamedValue {
    std::string name;  ///< in summary.json
    Value value;
};
/// In the order in which a summary shows them. A name that comes again replaces the value and keeps its place.
using NamedValues = std::vector<NamedValue>;

/// Something that a scene alone can tell about its run.
struct Finding {
    std::string key;   ///< in summary.json
    std::string text;  ///< in the table, unit included
    Value value;
};

}  // namespace abut::run
