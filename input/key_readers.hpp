#pragma once
// Private to the layer.
#include "abut/input/settings.hpp"

namespace abut::input {

/// Lets all that acts in a run read the keys that it acts by: bodies and their materials, contact and friction, bonds,
/// springs, the scheme and the output. A key that none of them reads has no effect (GivenKeys); a new one is refused
/// until something here reads it. Whether another key is there counts, and not its value, so that a sweep may go
/// through 0.
void mark_keys_read(const Settings& settings);

}  // namespace abut::input
