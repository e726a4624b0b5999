#include "abut/dynamics/composition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "abut/base/error.hpp"

namespace abut::dynamics {
namespace {

/// A and B in turn, first and last A: the first half of the lengths over half a step, the rest by symmetry.
std::vector<SubFlow> symmetric(std::span<const double> first_half) {
    const std::size_t n = 2 * first_half.size() - 1;
    std::vector<SubFlow> flows;
    for (std::size_t j = 0; j < n; ++j) flows.push_back({j % 2 == 0, 0.5 * first_half[std::min(j, n - 1 - j)]});
    return flows;
}

/// Whole steps of Strang, one after the other, of these parts of a step. Neighbouring A are not one path.
std::vector<SubFlow> whole_steps(std::span<const double> parts) {
    std::vector<SubFlow> flows;
    for (const double part : parts)
        for (const SubFlow& flow : sub_flows(Composition::strang)) flows.push_back({flow.kicks_a, part * flow.length});
    return flows;
}

std::vector<SubFlow> blanes_moan_4() {
    constexpr double a1 = 0.0792036964311957, a2 = 0.353172906049774, a3 = -0.0420650803577195;
    constexpr double b1 = 0.209515106613362, b2 = -0.143851773179818;
    return symmetric(std::vector{a1, b1, a2, b2, a3, 0.5 - b1 - b2, 1.0 - 2.0 * (a1 + a2 + a3)});
}

std::vector<SubFlow> blanes_moan_6() {
    constexpr double a1 = 0.0502627644003922, a2 = 0.413514300428344, a3 = 0.0450798897943977, a4 = -0.188054853819569,
                     a5 = 0.541960678450780;
    constexpr double b1 = 0.148816447901042, b2 = -0.132385865767784, b3 = 0.067307604692185, b4 = 0.432666402578175;
    return symmetric(
        std::vector{a1, b1, a2, b2, a3, b3, a4, b4, a5, 0.5 - (b1 + b2 + b3 + b4), 1.0 - 2.0 * (a1 + a2 + a3 + a4 + a5)});
}

std::vector<SubFlow> strang() { return symmetric(std::vector{0.5, 1.0}); }

std::vector<SubFlow> suzuki_4() {
    const double g = 1.0 / (4.0 - std::cbrt(4.0));
    return whole_steps(std::vector{g, g, 1.0 - 4.0 * g, g, g});
}

struct Row {
    Composition composition;
    const char* name;
    int order;
    std::vector<SubFlow> (*sub_flows)();
};

/// In the order of Composition.
constexpr std::array rows{Row{Composition::strang, "strang", 2, strang}, Row{Composition::suzuki_4, "suzuki_4", 4, suzuki_4},
                          Row{Composition::blanes_moan_4, "blanes_moan_4", 4, blanes_moan_4},
                          Row{Composition::blanes_moan_6, "blanes_moan_6", 6, blanes_moan_6}};

constexpr bool is_in_its_place(const Row& row) { return &row == &rows[static_cast<std::size_t>(row.composition)]; }
static_assert(std::ranges::all_of(rows, is_in_its_place));

const Row& row_of(Composition composition) { return rows.at(static_cast<std::size_t>(composition)); }

}  // namespace

const char* name_of(Composition composition) { return row_of(composition).name; }

int order_of(Composition composition) { return row_of(composition).order; }

std::vector<SubFlow> sub_flows(Composition composition) { return row_of(composition).sub_flows(); }

void detail::check_composition_mean(Composition composition, PathMean mean, bool system_is_exact) {
    const int order = order_of(composition), points = static_cast<int>(mean);
    const bool takes_any = composition == Composition::strang || composition == Composition::suzuki_4;
    const bool is_enough = mean == PathMean::system ? system_is_exact : 2 * points >= order;
    if (takes_any || is_enough) return;
    const std::string name = name_of(composition);
    if (mean == PathMean::system)
        throw BadInput("composition " + name +
                       ": the system does not say that the mean of its force is the integral along the path, and the order "
                       "would be 2. Take suzuki_4, whose order is 4 with any discrete gradient, or let `mean_is_exact()` "
                       "of the system return true where it is so.");
    throw BadInput("composition " + name + ": a mean of " + std::to_string(points) + " Gauss points, and order " +
                       std::to_string(order) + " takes " + std::to_string(order / 2) +
                       ". Take more points, or the system's own mean.",
                   {.value = static_cast<double>(points), .allowed = 0.5 * order});
}

void detail::check_rigid(std::size_t size, std::size_t size_of_q) {
    if (size != 0 && size != size_of_q)
        throw BadInput("composition: a rigid part of " + std::to_string(size) + " momenta is given, the system has " +
                           std::to_string(size_of_q) + " degrees of freedom. Give as many, or none.",
                       {.value = static_cast<double>(size), .allowed = static_cast<double>(size_of_q)});
}

void detail::check_synchronised(Composition composition) {
    if (composition != Composition::strang)
        throw Misuse(std::string("composition ") + name_of(composition) +
                     ": the state without the alternating mode is known for strang alone. Use `project`, or strang.");
}

void detail::refuse_composed(const char* what) { throw BadInput(std::string("composition: ") + what + " Take Memm."); }

}  // namespace abut::dynamics
