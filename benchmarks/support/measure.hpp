#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace abut::benchmark {

/// Times of one thing over the repetitions of a benchmark [s]. The machine may be shared: the least is what the code takes,
/// the median is what one gets.
struct Samples {
    std::vector<double> seconds;

    [[nodiscard]] double least() const;
    [[nodiscard]] double median() const;
};

/// `processor`: of all threads of this process, waiting for a processor left out: for one thread on a machine that others
/// use too. They still take their share of the memory's bandwidth: the triad in the same rounds tells.
enum class Clock { wall, processor };

[[nodiscard]] inline Clock clock_for(int threads) { return threads == 1 ? Clock::processor : Clock::wall; }
[[nodiscard]] double now(Clock clock);  ///< [s]

/// Seconds that a call takes.
template <class Work>
[[nodiscard]] double seconds_of(Work&& work, Clock clock) {
    const double start = now(clock);
    work();
    return now(clock) - start;
}

/// Runs all works in turn, again and again, so that whatever else the machine does meets all of them alike. The first
/// round warms caches and is not counted.
[[nodiscard]] std::vector<Samples> time_in_turn(int repetitions, Clock clock,
                                                const std::vector<std::function<void()>>& works);

/// What a result is worth nothing without: commit, machine, compiler, command, time of day.
[[nodiscard]] nlohmann::json circumstances(int argc, char** argv);

/// Bytes a second of a[i] = b[i] + s c[i] as STREAM counts them (three arrays, no write-allocate). Arrays of 128 MiB each.
class Triad {
public:
    Triad();
    void run();
    [[nodiscard]] double bytes() const { return 3.0 * sizeof(double) * static_cast<double>(a_.size()); }

private:
    std::vector<double> a_, b_, c_;
};

/// Writes `result` to a file; an empty name writes nothing. Throws std::runtime_error naming the file.
void write(const nlohmann::json& result, const std::string& file);

/// Body of every main function: calls `run`; a message on standard error and 1 if it throws.
int main(int argc, char** argv, int (*run)(int argc, char** argv));

/// Throws std::runtime_error with the figure unless difference <= limit: a benchmark of a wrong answer is worthless.
void require_small(const std::string& what, double difference, double limit);

}  // namespace abut::benchmark
