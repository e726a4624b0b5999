#pragma once
#include <nlohmann/json.hpp>

#include <string>

namespace abut::examples {

/// Something that a scene alone can tell about its run.
struct Finding {
    std::string key;   ///< in summary.json
    std::string text;  ///< in the table, unit included
    nlohmann::ordered_json value;
};

}  // namespace abut::examples
