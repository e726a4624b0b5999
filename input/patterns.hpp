#pragma once
// Private to the layer.
#include "abut/input/reader.hpp"
#include "abut/input/settings.hpp"

namespace abut::input {

/// Puts copies in the place of every body that a pattern names, and pairs and loads of all copies in the place of those
/// of that body. Faults for patterns that cannot be laid out.
void lay_out_patterns(Settings& settings, Reader& reader);

}  // namespace abut::input
