#pragma once
// Private to the layer; not installed.
#include <optional>
#include <string_view>
#include <vector>

#include "abut/mesh/io/binary_values.hpp"

namespace abut::mesh {

/// A type of numbers as a VTK file names it.
struct NumberType {
    std::string_view name;
    double n_bytes;
};

/// The type of this name; null if there is none.
[[nodiscard]] const NumberType* number_type(std::string_view name);

/// The values that are stored so, as double or std::int64_t. Whole numbers are not asked of types with fractions.
template <class Value>
[[nodiscard]] std::vector<Value> values_in(std::string_view bytes, std::string_view type, ByteOrder order);

/// A word of a text as a value of a type; nothing for any other word.
template <class Value>
[[nodiscard]] std::optional<Value> value_in(std::string_view word, const NumberType& type);

}  // namespace abut::mesh
