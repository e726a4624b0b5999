#include "abut/geometry/pair_potential/pair_potential.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "abut/geometry/pair_potential/lane_pair.hpp"
#include "abut/geometry/pair_potential/lanes/lane_task.hpp"
#include "abut/geometry/pair_potential/pair_normal.hpp"

namespace abut::geometry {
namespace {

using lanes::Integral;
using lanes::LaneTask;

static_assert(sizeof(PairCorners<2>) == 8 * sizeof(double) && sizeof(PairCorners<3>) == 18 * sizeof(double));
static_assert(PairEnd<2>().size() == lanes::end_size<2> && PairEnd<3>().size() == lanes::end_size<3>);

template <int Dim>
using Integrate = void (*)(LaneTask<Dim>*, int, Integral);

/// As many lanes as this processor has.
template <int Dim>
Integrate<Dim> integrate_by_most() {
#ifdef ABUT_WIDE_LANES
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
        return &lanes::integrate_by_8;
    if (__builtin_cpu_supports("avx2")) return &lanes::integrate_by_4;
#endif
    return &lanes::integrate_by_2;
}

template <int Dim>
LaneTask<Dim> task_of(const PairStep<Dim>& step) {
    const bool stays = std::memcmp(step.x_0, step.x_1, sizeof(PairCorners<Dim>)) == 0;
    const PairLaw<Dim>& law = *step.law;
    PairMeanGradient<Dim>& mean = *step.mean;
    return {.x_0 = (*step.x_0)[0].data(),
            .x_1 = (stays ? *step.x_0 : *step.x_1)[0].data(),
            .start = step.start ? step.start->data() : nullptr,
            .stiffness = law.stiffness,
            .length = {law.length[0], law.length[1]},
            .full = law.facing.full,
            .none = law.facing.none,
            .offset = law.offset,
            .end = step.end->data(),
            .gradient = mean.gradient[0].data(),
            .pressure = mean.pressure.data(),
            .normal = mean.normal.data()};
}

template <int Dim>
void take(const LaneTask<Dim>& task, PairMeanGradient<Dim>& mean) {
    mean.energy_0 = task.energy_0, mean.energy_1 = task.energy_1;
    mean.gap_0 = task.gap_0, mean.gap_1 = task.gap_1;
    mean.area = task.area;
    mean.active_share = task.active_share;
    mean.correction = task.correction;
    mean.events = task.cuts;
    mean.facing = task.facing;
}

template <int Dim>
void integrate(std::span<const PairStep<Dim>> steps, Integral integral) {
    static const Integrate<Dim> integrate_tasks = integrate_by_most<Dim>();
    std::array<LaneTask<Dim>, lanes::most_tasks> tasks;
    for (std::size_t first = 0; first < steps.size(); first += tasks.size()) {
        const auto part = steps.subspan(first, std::min(tasks.size(), steps.size() - first));
        for (std::size_t i = 0; i < part.size(); ++i) tasks[i] = task_of<Dim>(part[i]);
        integrate_tasks(tasks.data(), static_cast<int>(part.size()), integral);
        for (std::size_t i = 0; i < part.size(); ++i) take<Dim>(tasks[i], *part[i].mean);
    }
}

Integral integral_of(const PairPathOptions& options) {
    if (options.gauss) return options.events ? Integral::pieces : Integral::whole;
    return options.events ? Integral::checked : Integral::ends;
}

/// g of faces that share nothing, halfway between the nearest points of both.
double gap_between(const lanes::LaneCorners<double, 2>& z, double offset) {
    const lanes::Strip<double> strip(z);
    return strip.gap(0.5 * (strip.low + strip.high)) + offset;
}

/// The point of a segment that is nearest to another point.
Vector<2> nearest_on(const Vector<2>& a, const Vector<2>& b, const Vector<2>& point) {
    const Vector<2> along = b - a;
    return a + std::clamp(along.dot(point - a) / along.squaredNorm(), 0.0, 1.0) * along;
}

double gap_between(const lanes::LaneCorners<double, 3>& z, double offset) {
    const lanes::SeenPair<double> seen(z, offset);
    std::array<Vector<2>, 6> corner;
    for (std::size_t v = 0; v < corner.size(); ++v) corner[v] = lanes::vector_of(seen.plane[v]);
    double least = std::numeric_limits<double>::infinity();
    Vector<2> halfway = corner[0];
    const auto offer = [&](const Vector<2>& a, const Vector<2>& b) {
        if (const double distance = (a - b).squaredNorm(); distance < least) {
            least = distance;
            halfway = 0.5 * (a + b);
        }
    };
    for (std::size_t v = 0; v < corner.size(); ++v)
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const std::size_t other = v < 3 ? 3 : 0;
            offer(corner[v], nearest_on(corner[other + edge], corner[other + (edge + 1) % 3], corner[v]));
        }
    return seen.gap({halfway[0], halfway[1]});
}

}  // namespace

template <int Dim>
void integrate_pairs(std::span<const PairStep<Dim>> steps, const PairPathOptions& options) {
    integrate<Dim>(steps, integral_of(options));
}

template <int Dim>
void evaluate_pairs(std::span<const PairStep<Dim>> steps) {
    integrate<Dim>(steps, Integral::end);
}

template <int Dim>
PairMeanGradient<Dim> pair_mean_gradient(const PairCorners<Dim>& x_0, const PairCorners<Dim>& x_1, const PairLaw<Dim>& law,
                                         const PairPathOptions& options) {
    PairEnd<Dim> end;
    PairMeanGradient<Dim> mean;
    const PairStep<Dim> step{&x_0, &x_1, &law, nullptr, &end, &mean};
    integrate_pairs<Dim>({&step, 1}, options);
    return mean;
}

template <int Dim>
PairGradient<Dim> pair_gradient(const PairCorners<Dim>& corners, const PairLaw<Dim>& law) {
    PairEnd<Dim> end;
    PairMeanGradient<Dim> found;
    const PairStep<Dim> step{&corners, &corners, &law, nullptr, &end, &found};
    evaluate_pairs<Dim>({&step, 1});
    return {found.energy_1, found.gap_1, found.gradient, found.area, found.pressure};
}

template <int Dim>
PairState<Dim> pair_state(const PairCorners<Dim>& corners, const PairLaw<Dim>& law) {
    PairState<Dim> state;
    state.facing = facing_cosine(corners);
    state.gap = std::numeric_limits<double>::infinity();
    if (state.facing > no_normal_cosine) return state;
    const lanes::LaneLaw<double> of_lane = lanes::law_of<Dim>(law);
    const lanes::LaneFrame<double, Dim> frame(lanes::corners_of<Dim>(corners), of_lane);
    const lanes::LaneEnergy<double, Dim> found = lanes::energy_of(frame.z, of_lane);
    state.energy = found.energy;
    state.area = found.area;
    state.overlap = found.overlap;
    state.gap = found.overlap > 0.0 ? found.view_gap : gap_between(frame.z, law.offset);
    state.normal = lanes::vector_of(frame.in_space(found.common));
    return state;
}

#define ABUT_INSTANTIATE(Dim)                                                                           \
    template void integrate_pairs(std::span<const PairStep<Dim>>, const PairPathOptions&);              \
    template void evaluate_pairs(std::span<const PairStep<Dim>>);                                       \
    template PairMeanGradient<Dim> pair_mean_gradient(const PairCorners<Dim>&, const PairCorners<Dim>&, \
                                                      const PairLaw<Dim>&, const PairPathOptions&);     \
    template PairGradient<Dim> pair_gradient(const PairCorners<Dim>&, const PairLaw<Dim>&);             \
    template PairState<Dim> pair_state(const PairCorners<Dim>&, const PairLaw<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::geometry
