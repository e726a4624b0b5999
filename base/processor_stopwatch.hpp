#pragma once
#include <ctime>

namespace abut {

/// Adds the time of its life to a sum [s], as the processors of this machine have spent it on all threads of this
/// process: other processes take nothing from it.
class ProcessorStopwatch {
public:
    explicit ProcessorStopwatch(double& sum) : sum_(sum), start_(now()) {}
    ~ProcessorStopwatch() { sum_ += now() - start_; }
    ProcessorStopwatch(const ProcessorStopwatch&) = delete;
    ProcessorStopwatch& operator=(const ProcessorStopwatch&) = delete;

private:
    [[nodiscard]] static double now() {
        timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }
    double& sum_;
    double start_;
};

}  // namespace abut
