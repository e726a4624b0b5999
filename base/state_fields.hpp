#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "abut/base/state_bytes.hpp"

namespace abut {

/// Type whose memory is one list, from which it is saved and restored: its `fields` ties the members that a state has.
///
///     static auto fields(auto& self) { return std::tie(self.time, self.impulse); }
template <class T>
concept HasFields = requires(T& value) {
    std::remove_const_t<T>::fields(value);
};

namespace detail {

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;
template <class T>
inline constexpr bool is_vector_of_numbers = false;
template <class T>
inline constexpr bool is_vector_of_numbers<std::vector<T>> = std::is_arithmetic_v<T>;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_map = false;
template <class K, class T>
inline constexpr bool is_map<std::map<K, T>> = true;
template <class T>
inline constexpr bool is_pair = false;
template <class A, class B>
inline constexpr bool is_pair<std::pair<A, B>> = true;

}  // namespace detail

/// Appends a value to a state: numbers, enumerations, texts, types with fields; vectors, maps and optionals of such values
/// with their number; arrays, pairs and small matrices.
template <class T>
void put_value(StateWriter& state, const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
        state.put(value);
    } else if constexpr (std::is_enum_v<T>) {
        state.put(static_cast<std::underlying_type_t<T>>(value));
    } else if constexpr (HasFields<const T>) {
        std::apply([&](const auto&... field) { (put_value(state, field), ...); }, T::fields(value));
    } else if constexpr (detail::is_optional<T>) {
        state.put(static_cast<std::uint8_t>(value.has_value()));
        if (value) put_value(state, *value);
    } else if constexpr (detail::is_pair<T>) {
        put_value(state, value.first);
        put_value(state, value.second);
    } else {
        if constexpr (detail::is_vector<T> || detail::is_map<T>) state.put(static_cast<std::uint64_t>(value.size()));
        for (const auto& element : value) put_value(state, element);
    }
}

/// Reads a value that `put_value` wrote, of the same type. Throws BadInput where the state ends before.
template <class T>
void get_value(StateReader& state, T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
        value = state.get<T>();
    } else if constexpr (std::is_same_v<T, std::string>) {
        value = state.get_text();
    } else if constexpr (std::is_enum_v<T>) {
        value = static_cast<T>(state.get<std::underlying_type_t<T>>());
    } else if constexpr (HasFields<T>) {
        std::apply([&](auto&... field) { (get_value(state, field), ...); }, T::fields(value));
    } else if constexpr (detail::is_optional<T>) {
        value.reset();
        if (state.get<std::uint8_t>() != 0) get_value(state, value.emplace());
    } else if constexpr (detail::is_pair<T>) {
        get_value(state, value.first);
        get_value(state, value.second);
    } else if constexpr (detail::is_vector_of_numbers<T>) {
        value = state.get_all<typename T::value_type>();
    } else if constexpr (detail::is_vector<T>) {
        value.clear();  // and grows by what is there: a number alone may claim anything
        for (auto n = state.get<std::uint64_t>(); n > 0; --n) get_value(state, value.emplace_back());
    } else if constexpr (detail::is_map<T>) {
        value.clear();
        for (auto n = state.get<std::uint64_t>(); n > 0; --n) {
            typename T::key_type key;
            get_value(state, key);
            get_value(state, value[key]);
        }
    } else {
        for (auto& element : value) get_value(state, element);
    }
}

}  // namespace abut
