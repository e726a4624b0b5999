#pragma once
#include <cstddef>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "abut/base/option.hpp"

/// Checks of single values that a user gives, the same from every door: scenes, C, Python and C++.
namespace abut {

/// A number of a struct, under its name in scenes and in fields of hosts.
template <class Owner>
struct NumberOf {
    const char* name;
    double Owner::*member;
    Limits limits;
};

/// "young is -1 Pa; above 0 Pa is needed. Steel has 2.1e11 Pa."; empty where the limits allow the value.
[[nodiscard]] std::string fault_of(const std::string& name, const Limits& limits, double value);
/// Throws BadInput with the text of `fault_of`.
void require_allowed(const std::string& name, const Limits& limits, double value);
/// As `require_allowed`, of all numbers of a table, with `whose` in front of a name.
template <class Owner, class Table>
void require_allowed(const std::string& whose, const Table& numbers, const Owner& owner) {
    for (const NumberOf<Owner>& number : numbers) require_allowed(whose + number.name, number.limits, owner.*number.member);
}
/// The number of a table that a member has.
template <class Owner, class Table>
[[nodiscard]] constexpr const NumberOf<Owner>& number_of(const Table& numbers, double Owner::*member) {
    const NumberOf<Owner>* number = std::begin(numbers);
    while (number->member != member) ++number;
    return *number;
}

/// Position of a word in a list. Throws BadInput: "law is 'j3', which is none of 'j2', 'orthotropic'. Did you mean 'j2'?"
[[nodiscard]] std::size_t word_among(const std::vector<std::string>& words, const std::string& name,
                                     const std::string& given);

/// The entry of a range whose `name_of` is this word. Throws as `word_among`.
template <class Range, class NameOf>
[[nodiscard]] const auto& entry_called(const Range& entries, const NameOf& name_of, const std::string& name,
                                       const std::string& given) {
    std::vector<std::string> words;
    for (const auto& entry : entries) words.emplace_back(std::invoke(name_of, entry));
    return *std::next(std::begin(entries), static_cast<std::ptrdiff_t>(word_among(words, name, given)));
}
/// The choice of a word, of a range of Word. Throws as `word_among`.
template <class Words>
[[nodiscard]] auto choice_called(const Words& words, const std::string& name, const std::string& given) {
    return entry_called(
               words, [](const auto& one) { return one.word; }, name, given)
        .choice;
}

}  // namespace abut
