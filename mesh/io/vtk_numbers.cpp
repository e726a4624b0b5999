#include "abut/mesh/io/vtk_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "abut/mesh/io/text_words.hpp"

namespace abut::mesh {
namespace {

constexpr std::array<NumberType, 11> number_types = {{{"Int8", 1},
                                                      {"UInt8", 1},
                                                      {"Int16", 2},
                                                      {"UInt16", 2},
                                                      {"Int32", 4},
                                                      {"UInt32", 4},
                                                      {"Int64", 8},
                                                      {"UInt64", 8},
                                                      {"Float32", 4},
                                                      {"Float64", 8},
                                                      {"Bit", 0.125}}};

template <class Stored, class Value>
void append_all(std::vector<Value>& values, std::string_view bytes, ByteOrder order) {
    values.reserve(bytes.size() / sizeof(Stored));
    for (std::size_t at = 0; at + sizeof(Stored) <= bytes.size(); at += sizeof(Stored))
        values.push_back(static_cast<Value>(binary_value<Stored>(bytes, at, order)));
}

}  // namespace

const NumberType* number_type(std::string_view name) {
    const auto found = std::ranges::find(number_types, name, &NumberType::name);
    return found == number_types.end() ? nullptr : &*found;
}

template <class Value>
std::vector<Value> values_in(std::string_view bytes, std::string_view type, ByteOrder order) {
    std::vector<Value> values;
    if (type == "Int8") append_all<std::int8_t>(values, bytes, order);
    if (type == "UInt8") append_all<std::uint8_t>(values, bytes, order);
    if (type == "Int16") append_all<std::int16_t>(values, bytes, order);
    if (type == "UInt16") append_all<std::uint16_t>(values, bytes, order);
    if (type == "Int32") append_all<std::int32_t>(values, bytes, order);
    if (type == "UInt32") append_all<std::uint32_t>(values, bytes, order);
    if (type == "Int64") append_all<std::int64_t>(values, bytes, order);
    if (type == "UInt64") append_all<std::uint64_t>(values, bytes, order);
    if constexpr (std::is_floating_point_v<Value>) {
        if (type == "Float32") append_all<float>(values, bytes, order);
        if (type == "Float64") append_all<double>(values, bytes, order);
    }
    if (type == "Bit")
        for (const char byte : bytes)
            for (int bit = 7; bit >= 0; --bit) values.push_back(static_cast<Value>(byte >> bit & 1));
    return values;
}

template <class Value>
std::optional<Value> value_in(std::string_view word, const NumberType& type) {
    if constexpr (std::is_floating_point_v<Value>)
        if (type.name.starts_with("Float")) {
            const auto value = number_in(word);
            if (!value || type.name == "Float64") return value;
            if (std::isfinite(*value) && std::abs(*value) > static_cast<double>(std::numeric_limits<float>::max()))
                return {};
            return static_cast<float>(*value);
        }
    const auto value = whole_number_in(word);
    const double n_bits = 8.0 * type.n_bytes;
    const bool is_signed = type.name.starts_with("Int");
    if (!value || (!is_signed && *value < 0)) return {};
    if (n_bits < 64.0 && (static_cast<double>(*value) < -std::exp2(n_bits - 1.0) ||
                          static_cast<double>(*value) >= std::exp2(is_signed ? n_bits - 1.0 : n_bits)))
        return {};
    return static_cast<Value>(*value);
}

template std::vector<double> values_in(std::string_view, std::string_view, ByteOrder);
template std::vector<std::int64_t> values_in(std::string_view, std::string_view, ByteOrder);
template std::optional<double> value_in(std::string_view, const NumberType&);
template std::optional<std::int64_t> value_in(std::string_view, const NumberType&);

}  // namespace abut::mesh
