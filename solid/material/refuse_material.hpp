#pragma once
// Private to the sources of this layer.
#include <string>

namespace abut::solid {

/// Throws BadInput "material of body 0: <name> is <value>; <limit>".
[[noreturn]] void refuse_material(int body, const std::string& name, double value, const std::string& limit);

}  // namespace abut::solid
