#include "support/measure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace abut::benchmark {
namespace {

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
    std::string text;
    std::array<char, 256> buffer{};
    while (pipe && std::fgets(buffer.data(), buffer.size(), pipe.get())) text += buffer.data();
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

std::string commit() {
    const std::string text = output_of("git -C '" ABUT_SOURCE_DIR "' describe --always --dirty --abbrev=12 2>/dev/null");
    return text.empty() ? "unknown" : text;
}

/// A field of the first processor in /proc/cpuinfo.
std::string processor(std::string_view field) {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with(field)) return line.substr(std::min(line.size(), line.find(':') + 2));
    return "unknown";
}

std::string time_of_day() {
    const std::time_t time = std::time(nullptr);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time));
    return text.data();
}

std::string base_name(std::string_view path) { return std::string(path.substr(path.find_last_of('/') + 1)); }

}  // namespace

double Samples::least() const { return *std::min_element(seconds.begin(), seconds.end()); }

double Samples::median() const {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

double now(Clock clock) {
    std::timespec time{};
    clock_gettime(clock == Clock::wall ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<Samples> time_in_turn(int repetitions, Clock clock, const std::vector<std::function<void()>>& works) {
    std::vector<Samples> samples(works.size());
    for (int round = 0; round <= repetitions; ++round)
        for (std::size_t i = 0; i < works.size(); ++i) {
            const double seconds = seconds_of(works[i], clock);
            if (round > 0) samples[i].seconds.push_back(seconds);
        }
    return samples;
}

nlohmann::json circumstances(int argc, char** argv) {
    std::string command = base_name(argv[0]);
    for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
    return {{"commit", commit()},
            {"machine",
             {{"processor", processor("model name")},
              {"cache", processor("cache size")},
              {"cores", std::thread::hardware_concurrency()}}},
            {"compiler",
             {{"version", __VERSION__},
              {"avx2",
#ifdef __AVX2__
               true
#else
               false
#endif
              }}},
            {"command", command},
            {"time", time_of_day()}};
}

Triad::Triad() : a_(std::size_t{1} << 24), b_(a_.size(), 1.0), c_(a_.size(), 2.0) {}

void Triad::run() {
    const double scale = 3.0;
    const double* __restrict b = b_.data();
    const double* __restrict c = c_.data();
    double* __restrict a = a_.data();
    for (std::size_t i = 0; i < a_.size(); ++i) a[i] = b[i] + scale * c[i];
}

void write(const nlohmann::json& result, const std::string& file) {
    if (file.empty()) return;
    std::ofstream stream(file);
    stream << result.dump(2) << '\n';
    if (!stream.flush())
        throw std::runtime_error(file + ": cannot be written. Give --json a file in a folder that exists and is writable.");
}

int main(int argc, char** argv, int (*run)(int argc, char** argv)) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", base_name(argv[0]), error.what());
        return 1;
    }
}

void require_small(const std::string& what, double difference, double limit) {
    if (difference <= limit) return;
    throw std::runtime_error(
        fmt::format("{}: the answers differ by {:.2e}, {:.0e} is allowed: nothing is timed.", what, difference, limit));
}

}  // namespace abut::benchmark
