#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "abut/mesh/cell_shape.hpp"
#include "studies/extremes/families.hpp"
#include "studies/extremes/scenes.hpp"

namespace abut::studies::extremes {
namespace {

/// No edge of one lies on an edge of the other: how often edges cross that lie on each other, rounding decides.
std::array<Block<3>, 2> small_blocks(mesh::CellShape shape = mesh::CellShape::tetrahedron) {
    return {{{.sides = {1.0, 0.9, 1.1}, .cells = {3, 3, 3}, .shape = shape},
             {.sides = {0.7, 0.8, 1.0}, .cells = {2, 2, 2}, .shape = shape}}};
}

template <int Dim>
Trial<Dim> trial_in(const Units& units, const std::string& value, const run::RunOptions& run) {
    Meeting<Dim> meeting{.units = units, .aside = 0.3, .slide = 0.01};
    if constexpr (Dim == 3) meeting.time = 5.0;
    const auto scene = [meeting]() -> run::Scene<Dim> {
        if constexpr (Dim == 2)
            return discs(meeting, {0.3, 0.27});  // equal faces pass each other with both ends at once: one event or two
        else
            return blocks<3>(meeting, small_blocks());
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
        compare(row, reference, row.numbers.size(), largest_deviation);
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

namespace {

/// Coordinates of that size are rounded to 1e-16 of it; what an impact makes of it is some hundred times more.
double allowed_at(double offset) { return largest_deviation + 1e4 * std::numeric_limits<double>::epsilon() * offset; }

template <int Dim>
void sweep_places(const std::string& what, const std::function<Trial<Dim>(const Vector<Dim>&)>& trial_at, const Sink& sink) {
    const Vector<3> direction(1.0, -0.7, 0.3);
    Row reference;
    for (const double offset : {0.0, 1.0, 1e2, 1e4, 1e6}) {
        Trial<Dim> trial = trial_at(offset * direction.head<Dim>());
        trial.family = "offset";
        trial.value = fmt::format("{}, {:g} sizes", what, offset);
        Row row = attempt(trial);
        if (offset == 0.0)
            reference = row;
        else
            compare(row, reference, 2 * Dim, allowed_at(offset));
        sink(row);
    }
}

}  // namespace

void sweep_offset(const SweepOptions& options, const Sink& sink) {
    sweep_places<2>(
        "discs",
        [&](const Vector<2>& place) -> Trial<2> {
            const Meeting<2> meeting{.aside = 0.3, .place = place};
            return {.speed = meeting.speed, .make = [=] { return discs(meeting); }, .run = options.run};
        },
        sink);
    for (const auto shape : {mesh::CellShape::tetrahedron, mesh::CellShape::hexahedron})
        sweep_places<3>(
            std::string(mesh::name(shape)),
            [&](const Vector<3>& place) -> Trial<3> {
                const Meeting<3> meeting{.aside = 0.3, .slide = 0.01, .time = 3.0, .place = place};
                return {.speed = meeting.speed,
                        .make = [=] { return blocks<3>(meeting, small_blocks(shape)); },
                        .run = options.run};
            },
            sink);
}

}  // namespace abut::studies::extremes
