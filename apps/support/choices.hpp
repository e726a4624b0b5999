#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/option.hpp"
#include "abut/run/options.hpp"

namespace abut::apps {

/// A value for each of two bodies: one for both, or two separated by a comma.
using BodyValues = std::array<double, 2>;

template <class Value>
using Choices = std::vector<std::pair<std::string, Value>>;

/// A table of words as choices.
template <class Value, std::size_t N>
[[nodiscard]] Choices<Value> choices_of(const std::array<Word<Value>, N>& words) {
    Choices<Value> choices;
    for (const auto& [word, value] : words) choices.emplace_back(word, value);
    return choices;
}

template <class Value>
[[nodiscard]] std::string name_of(const Choices<Value>& choices, const Value& value) {
    for (const auto& [name, choice] : choices)
        if (choice == value) return name;
    return "";
}

}  // namespace abut::apps
