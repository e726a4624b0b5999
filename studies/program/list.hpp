#pragma once
#include <vector>

#include "studies/program/entry.hpp"

namespace abut::studies {

/// All studies, by name. A new one is a source with a namespace and two lines of list.cpp.
[[nodiscard]] std::vector<Entry> all_studies();

}  // namespace abut::studies
