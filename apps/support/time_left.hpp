#pragma once
#include <cstdint>
#include <deque>
#include <string>

namespace abut::apps {

/// How long the steps that are left will take, from how long those of the latter half of the time so far took: steps in
/// contact cost more than others, and the first ones more than those to come.
class TimeLeft {
public:
    explicit TimeLeft(std::int64_t n_steps) : n_steps_(n_steps) {}

    /// `step` steps were taken by `elapsed` [s]; neither ever decreases.
    void add(std::int64_t step, double elapsed);
    /// [s]; 0 before any step.
    [[nodiscard]] double seconds() const;

private:
    struct Mark {
        std::int64_t step;
        double elapsed;
    };
    std::int64_t n_steps_;
    std::deque<Mark> marks_{{0, 0.0}};  // at most some hundreds: the next one comes after a part of the time so far
};

/// "4.2 s", "12 min 05 s", "3 h 07 min", "2 d 05 h".
[[nodiscard]] std::string duration(double seconds);

}  // namespace abut::apps
