#pragma once
#include <cstddef>
#include <vector>

#include "abut/ranks/communicator.hpp"

namespace abut::ranks {

// What rank 0 alone has, brought to others as bytes: values as put_value of base/state_fields.hpp writes them, whole meshes
// and parts among them. Any number of bytes goes.

/// The bytes of rank 0 on all ranks; those that others give are dropped. A call of all ranks.
[[nodiscard]] std::vector<std::byte> of_first(const Communicator& communicator, std::vector<std::byte> bytes);

/// The bytes of rank 0 on rank `to`; nothing on rank 0 unless it is that one. A call of these two.
[[nodiscard]] std::vector<std::byte> from_first(const Communicator& communicator, std::vector<std::byte> bytes, int to);

}  // namespace abut::ranks
