#include "abut/base/counted.hpp"

namespace abut {
namespace {

std::string plural_of(std::string noun) {
    constexpr std::string_view vowels = "aeiou";
    const bool ends_with_y = noun.ends_with('y') && noun.size() > 1 && vowels.find(noun[noun.size() - 2]) == vowels.npos;
    if (ends_with_y) return noun.replace(noun.size() - 1, 1, "ies");
    if (noun.ends_with('s') || noun.ends_with('x') || noun.ends_with("ch")) return noun + "es";
    return noun + "s";
}

}  // namespace

std::string counted(std::int64_t count, std::string_view noun) { return counted(count, noun, plural_of(std::string(noun))); }

std::string counted(std::int64_t count, std::string_view one, std::string_view several) {
    return std::to_string(count) + " " + std::string(count == 1 ? one : several);
}

}  // namespace abut
