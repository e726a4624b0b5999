// Pairs of overlapping boxes of two facing surfaces: Embree, FCL's tree, and every box against every box.
//
// Each surface is a square cut into triangles, wavy, one face size apart from the other, the second one turned and with a
// different cell count; boxes are grown by half a face as contact grows them. One thread or more. All answers must be equal.
// Expected: Embree and FCL linear up to a logarithm, brute force quadratic.
#include <fmt/core.h>
#include <oneapi/tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "abut/geometry/broad_phase.hpp"
#include "support/measure.hpp"

namespace {

using namespace abut;
using geometry::Box;
using geometry::BroadPhase;

/// Boxes of the 2 n^2 triangles of a wavy unit square at height z, turned by `angle` about its middle.
std::vector<Box<3>> surface_boxes(int n, double z, double angle) {
    const auto point = [&](int i, int j) {
        const double x = static_cast<double>(i) / n - 0.5, y = static_cast<double>(j) / n - 0.5;
        return Vector<3>(std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y,
                         z + 0.05 * std::sin(6.0 * (std::cos(angle) * x - std::sin(angle) * y)));
    };
    std::vector<Box<3>> boxes;
    const auto add = [&](const Vector<3>& a, const Vector<3>& b, const Vector<3>& c) {
        Box<3> box;
        for (const auto& corner : {a, b, c}) box.extend(corner);
        boxes.push_back(box.grown(0.5 / n));
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            add(point(i, j), point(i + 1, j), point(i, j + 1));
            add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        }
    return boxes;
}

struct Choices {
    std::vector<int> faces{1'000, 10'000, 100'000};
    int brute_limit = 30'000;
    int repetitions = 5;
    int threads = 1;
    std::string json;
};

nlohmann::json measure(int faces, const Choices& choices) {
    const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(0.5 * faces))));
    const auto lower = surface_boxes(n, 0.0, 0.0), upper = surface_boxes(n - 1, 1.0 / n, 0.3);
    const auto pairs_of = [&](BroadPhase method) { return geometry::overlapping_pairs<3>(method, lower, upper); };
    std::vector<BroadPhase> methods{BroadPhase::embree, BroadPhase::fcl};
    if (faces <= choices.brute_limit) methods.push_back(BroadPhase::brute_force);

    const auto expected = pairs_of(methods.back());
    for (const BroadPhase method : methods)
        if (pairs_of(method) != expected)
            throw std::runtime_error(
                fmt::format("{} and {} find different pairs: nothing is timed.", name(method), name(methods.back())));

    std::vector<std::function<void()>> works;
    for (const BroadPhase method : methods) works.emplace_back([&, method] { (void)pairs_of(method); });
    const auto samples = benchmark::time_in_turn(choices.repetitions, benchmark::clock_for(choices.threads), works);
    nlohmann::json result{{"faces", lower.size() + upper.size()}, {"pairs", expected.size()}};
    fmt::print("{:>8} faces, {:>8} pairs:", lower.size() + upper.size(), expected.size());
    for (std::size_t i = 0; i < methods.size(); ++i) {
        result["ms"][std::string(name(methods[i]))] = 1e3 * samples[i].least();
        fmt::print("  {} {:.3f} ms", name(methods[i]), 1e3 * samples[i].least());
    }
    fmt::print("\n");
    return result;
}

int run(int argc, char** argv) {
    Choices choices;
    CLI::App app{"Broad phases on two facing surfaces."};
    app.option_defaults()->always_capture_default();
    app.add_option("--faces", choices.faces, "faces a surface")->delimiter(',')->check(CLI::Range(8, 10'000'000));
    app.add_option("--brute-limit", choices.brute_limit, "faces a surface up to which brute force takes part");
    app.add_option("--repetitions", choices.repetitions, "rounds; the least is shown")->check(CLI::PositiveNumber);
    app.add_option("--threads", choices.threads)->check(CLI::PositiveNumber);
    app.add_option("--json", choices.json, "file for the result");
    CLI11_PARSE(app, argc, argv);

    const oneapi::tbb::global_control threads(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(choices.threads));
    nlohmann::json result = benchmark::circumstances(argc, argv);
    for (const int faces : choices.faces) result["results"].push_back(measure(faces, choices));
    benchmark::write(result, choices.json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
