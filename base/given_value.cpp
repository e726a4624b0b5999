#include "abut/base/given_value.hpp"

#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/base/nearest_word.hpp"

namespace abut {

std::string fault_of(const std::string& name, const Limits& limits, double value) {
    if (limits.allow(value)) return "";
    const std::string allowed = text_of(limits), remedy = limits.remedy;
    return name + " is " + with_unit_of(limits, value) + "; " + (allowed.empty() ? "a finite number" : allowed) +
           " is needed." + (remedy.empty() ? "" : " " + remedy);
}

void require_allowed(const std::string& name, const Limits& limits, double value) {
    if (const std::string fault = fault_of(name, limits, value); !fault.empty())
        throw BadInput(fault, {.value = value, .allowed = limits.above});
}

std::size_t word_among(const std::vector<std::string>& words, const std::string& name, const std::string& given) {
    const auto found = std::ranges::find(words, given);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "'" : ", '") + word + "'";
    const auto nearest = nearest_word(given, words);
    throw BadInput(name + " is '" + given + "', which is none of " + all + "." +
                   (nearest ? " Did you mean '" + *nearest + "'?" : ""));
}

}  // namespace abut
