// Area that two faces share, and its derivative: the fast implementation against the exact one, nanoseconds a pair.
//
// Pairs as contact meets them: triangles (3D) or segments (2D) of like size, the second one moved by up to its own size.
// Every tenth pair is degenerate: equal faces, a shared edge, a corner on an edge.
// Expected: areas equal to round-off of the face, derivatives too; fast well below 200 ns per pair.
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <random>

#include "abut/geometry/overlap/overlap.hpp"
#include "support/measure.hpp"
#include "support/options.hpp"

namespace {

using namespace abut;
using geometry::AreaMethod;

template <int Dim>
struct FacePair {
    std::array<PlaneVector<Dim>, Dim> face_1, face_2;  // a segment has 2 ends, a triangle 3 corners
    PlaneVector<Dim> shift;
};

class Maker {
public:
    template <int Dim>
    FacePair<Dim> pair(std::size_t i) {
        FacePair<Dim> made{face<Dim>(), face<Dim>(), random_vector<Dim>()};
        if (i % 30 == 0) made = {made.face_1, made.face_1, PlaneVector<Dim>::Zero()};
        if (i % 30 == 10) made = {made.face_1, made.face_1, PlaneVector<Dim>(made.face_1[1] - made.face_1[0])};
        if (i % 30 == 20) made.shift = 0.5 * (made.face_1[0] + made.face_1[1]) - made.face_2[0];
        return made;
    }

private:
    template <int Dim>
    PlaneVector<Dim> random_vector() {
        PlaneVector<Dim> v;
        for (int i = 0; i < Dim - 1; ++i) v[i] = value_(generator_);
        return v;
    }
    template <int Dim>
    std::array<PlaneVector<Dim>, Dim> face() {
        std::array<PlaneVector<Dim>, Dim> corners;
        if constexpr (Dim == 2) {
            const double half = 0.75 + 0.25 * value_(generator_);
            corners = {PlaneVector<2>(-half), PlaneVector<2>(half)};
        } else {
            double angle = 4.0 * value_(generator_);
            for (auto& corner : corners) {
                corner = (0.75 + 0.25 * value_(generator_)) * PlaneVector<3>(std::cos(angle), std::sin(angle));
                angle += 2.0 + 0.1 * value_(generator_);
            }
        }
        return corners;
    }

    std::mt19937_64 generator_{1};
    std::uniform_real_distribution<double> value_{-1.0, 1.0};
};

template <int Dim>
std::vector<FacePair<Dim>> make_pairs(std::size_t n) {
    Maker maker;
    std::vector<FacePair<Dim>> pairs;
    for (std::size_t i = 0; i < n; ++i) pairs.push_back(maker.pair<Dim>(i));
    return pairs;
}

template <int Dim>
geometry::OverlapArea<Dim> area_of(const FacePair<Dim>& pair, AreaMethod method) {
    return geometry::overlap_area<Dim>(pair.face_1, pair.face_2, pair.shift, method);
}

struct Difference {
    double area = 0.0;  ///< faces have sizes of about 1
    double derivative = 0.0;
};

template <int Dim>
Difference largest_difference(std::span<const FacePair<Dim>> pairs) {
    Difference largest;
    for (const auto& pair : pairs) {
        const auto fast = area_of(pair, AreaMethod::fast), exact = area_of(pair, AreaMethod::exact);
        largest.area = std::max(largest.area, std::abs(fast.area - exact.area));
        // where nothing but round-off is shared, the two may disagree on which side of "nothing" they are
        if (std::min(fast.area, exact.area) > 1e-12)
            largest.derivative = std::max(largest.derivative, (fast.area_gradient - exact.area_gradient).norm());
    }
    return largest;
}

template <int Dim>
double sum_of_areas(std::span<const FacePair<Dim>> pairs, AreaMethod method) {
    double sum = 0.0;
    for (const auto& pair : pairs) sum += area_of(pair, method).area;
    return sum;
}

template <int Dim>
nlohmann::json measure(std::size_t n, std::size_t n_exact, int repetitions) {
    const auto pairs = make_pairs<Dim>(n);
    const std::span<const FacePair<Dim>> all(pairs), few = all.first(std::min(n, n_exact));
    const Difference difference = largest_difference<Dim>(few);
    benchmark::require_small("area, fast against exact", difference.area, 1e-14);
    benchmark::require_small("derivative of the area, fast against exact", difference.derivative, 1e-12);

    volatile double sink = 0.0;
    const auto samples = benchmark::time_in_turn(repetitions, benchmark::Clock::processor,
                                                 {[&] { sink = sum_of_areas<Dim>(all, AreaMethod::fast); },
                                                  [&] { sink = sum_of_areas<Dim>(few, AreaMethod::exact); }});
    const auto nanoseconds = [&](const benchmark::Samples& s, std::size_t count) {
        return 1e9 * s.least() / static_cast<double>(count);
    };
    nlohmann::json result{
        {"dim", Dim},
        {"pairs", n},
        {"difference", {{"area", difference.area}, {"derivative", difference.derivative}}},
        {"ns_a_pair", {{"fast", nanoseconds(samples[0], n)}, {"exact", nanoseconds(samples[1], few.size())}}}};
    fmt::print(
        "{}D, {} pairs: fast {:.1f} ns per pair, exact {:.0f}; largest difference of areas {:.1e}, of derivatives {:.1e}\n",
        Dim, n, result["ns_a_pair"]["fast"].get<double>(), result["ns_a_pair"]["exact"].get<double>(), difference.area,
        difference.derivative);
    return result;
}

int run(int argc, char** argv) {
    std::vector<std::size_t> counts{1'000, 30'000, 1'000'000};
    std::size_t n_exact = 10'000;
    int repetitions = 5;
    std::string json;
    benchmark::Options options("Shared area of two faces: fast against exact.");
    options.add("--pairs", counts, "numbers of pairs").positive();
    options.add("--exact", n_exact, "pairs that are compared, and timed with the exact method, at most").positive();
    options.add("--repetitions", repetitions, "rounds; the least is shown").positive();
    options.add("--json", json, "file for the result");
    if (const auto status = options.parse(argc, argv)) return *status;

    nlohmann::json result = benchmark::circumstances(argc, argv);
    for (const std::size_t n : counts) {
        result["results"].push_back(measure<2>(n, n_exact, repetitions));
        result["results"].push_back(measure<3>(n, n_exact, repetitions));
    }
    benchmark::write(result, json);
    return 0;
}

}  // namespace

int main(int argc, char** argv) { return abut::benchmark::main(argc, argv, run); }
