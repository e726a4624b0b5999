#include <fmt/format.h>

#include <cmath>

#include "abut/mesh/cell_shape.hpp"
#include "extremes/families.hpp"
#include "extremes/scenes.hpp"

namespace abut::examples::extremes {
namespace {

Block<3> small_block(int n) { return {.sides = {1.0, 0.9, 1.1}, .cells = {n, n, n}}; }

template <int Dim>
Trial<Dim> trial_in(const Units& units, const std::string& value, const RunOptions& run) {
    Meeting<Dim> meeting{.units = units, .aside = 0.3, .slide = 0.01};
    if constexpr (Dim == 3) meeting.time = 5.0;
    const auto scene = [meeting]() -> Scene<Dim> {
        if constexpr (Dim == 2)
            return discs(meeting);
        else
            return blocks<3>(meeting, {small_block(3), small_block(2)});
    };
    return {.family = "units",
            .value = fmt::format("{}D {}", Dim, value),
            .speed = meeting.speed * units.speed(),
            .make = scene,
            .run = run};
}

/// Powers of two are exact: not a bit may change. Powers of ten are rounded.
std::vector<double> factors(bool quick) {
    if (quick) return {std::ldexp(1.0, -30), 1e-9, 1e9};
    return {std::ldexp(1.0, -30), std::ldexp(1.0, 30), 1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9};
}

std::string shown(double factor) {
    int exponent = 0;
    return std::frexp(factor, &exponent) == 0.5 ? fmt::format("2^{}", exponent - 1) : fmt::format("{:g}", factor);
}

template <int Dim>
void sweep(const SweepOptions& options, const Sink& sink) {
    const Row reference = attempt(trial_in<Dim>({}, "SI", options.run));
    sink(reference);
    const auto try_units = [&](const char* quantity, double factor, const Units& units) {
        Row row = attempt(trial_in<Dim>(units, fmt::format("{} x {}", quantity, shown(factor)), options.run));
        compare(row, reference);
        sink(row);
    };
    for (const double factor : factors(options.quick)) {
        try_units("length", factor, {.length = factor});
        try_units("stress", factor, {.stress = factor});
        try_units("density", factor, {.density = factor});
        try_units("all", factor, {.length = factor, .stress = factor, .density = factor});
    }
}

}  // namespace

void sweep_units(const SweepOptions& options, const Sink& sink) {
    sweep<2>(options, sink);
    SweepOptions few = options;
    few.quick = true;
    sweep<3>(few, sink);
}

void sweep_offset(const SweepOptions& options, const Sink& sink) {
    for (const double offset : {1.0, 1e2, 1e4, 1e6}) {
        Meeting<2> in_plane{.aside = 0.3};
        in_plane.place = offset * Vector<2>(1.0, -0.7);
        sink(attempt<2>({.family = "offset",
                         .value = fmt::format("2D discs {:g}", offset),
                         .speed = in_plane.speed,
                         .make = [=] { return discs(in_plane); },
                         .run = options.run}));
        for (const auto shape : {mesh::CellShape::tetrahedron, mesh::CellShape::hexahedron}) {
            Meeting<3> in_space{.aside = 0.3, .time = 3.0};
            in_space.place = offset * Vector<3>(1.0, -0.7, 0.3);
            std::array pair{small_block(3), small_block(2)};
            for (Block<3>& block : pair) block.shape = shape;
            sink(attempt<3>({.family = "offset",
                             .value = fmt::format("3D {} {:g}", mesh::name(shape), offset),
                             .speed = in_space.speed,
                             .make = [=] { return blocks<3>(in_space, pair); },
                             .run = options.run}));
        }
    }
}

}  // namespace abut::examples::extremes
