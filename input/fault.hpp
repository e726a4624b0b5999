#pragma once
#include <string>
#include <vector>

#include "abut/base/error.hpp"

namespace abut::input {

/// Something that a scene says and that cannot be.
struct Fault {
    std::string where;  ///< "bars.toml:12:5", file, line and column from 1 on, or "--set dim=4"
    std::string text;   ///< the key with its value, what is allowed, and what to do
};

/// In the words of a scene (run::in_user_words, run::with_keys), by line and column; then those of a file as a whole,
/// then those of other sources.
[[nodiscard]] std::vector<Fault> in_order(std::vector<Fault> faults);

/// "bars.toml:12:5: ..." on a line for each.
[[nodiscard]] std::string text_of(const std::vector<Fault>& faults);

/// All faults of a scene that could be found at once, in order.
class SceneError : public BadInput {
public:
    explicit SceneError(std::vector<Fault> faults);
    [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

private:
    std::vector<Fault> faults_;
};

}  // namespace abut::input
