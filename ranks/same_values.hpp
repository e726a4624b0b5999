#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/ranks/communicator.hpp"

namespace abut::ranks {

/// Something that all ranks give alike, under the name that a host knows it by.
struct NamedValue {
    std::string name;
    double value;
};

/// A call of all ranks. Throws BadInput on all, naming the rank and the first value that has not the bits of rank 0's. Where
/// ranks give lists of different lengths, a value before their ends says so.
void require_same(const Communicator& communicator, std::span<const NamedValue> values);

/// All that a host chooses; of `wanted`, whether it is there.
[[nodiscard]] std::vector<NamedValue> named_values(const contact::NodalOptions& options);

/// Whether all ranks have made the same of something. A call of all ranks, one reduction of two numbers.
[[nodiscard]] bool is_same(const Communicator& communicator, std::uint64_t checksum);

}  // namespace abut::ranks
