#pragma once
// Private to the layer.
#include <string>
#include <utility>
#include <vector>

#include "abut/run/user_words.hpp"
#include "abut/run/words/warnings.hpp"

namespace abut::run {

/// Gathers warnings of counts that should be 0.
class Counts {
public:
    template <class Count>
    void add(WarningKind kind, Severity severity, Count count, std::string text) {
        if (count > 0) warnings.push_back({kind, severity, std::move(text), static_cast<double>(count), 0.0});
    }
    std::vector<Warning> warnings;
};

/// In the words of people who write scenes.
inline std::vector<Warning> in_user_words(std::vector<Warning> warnings) {
    for (Warning& warning : warnings) warning.text = with_keys(in_user_words(std::move(warning.text)));
    return warnings;
}

}  // namespace abut::run
