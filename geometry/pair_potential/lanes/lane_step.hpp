#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_energy_2d.hpp"
#include "abut/geometry/pair_potential/lanes/lane_energy_3d.hpp"

namespace abut::geometry::lanes {

inline constexpr double eps = 2.220446049250313e-16;

/// Part of the gradient up to which a correction is small: what Integral::checked asks for.
inline constexpr double small_correction = 1e-7;

/// Sum of the products of all components.
template <class T, int Dim>
T dot(const LaneCorners<T, Dim>& a, const LaneCorners<T, Dim>& b) {
    T sum = dot(a.at[0], b.at[0]);
    for (int v = 1; v < 2 * Dim; ++v) sum = sum + dot(a.at[v], b.at[v]);
    return sum;
}
template <class T, int Dim>
LaneCorners<T, Dim> difference(const LaneCorners<T, Dim>& a, const LaneCorners<T, Dim>& b) {
    LaneCorners<T, Dim> result;
    for (int v = 0; v < 2 * Dim; ++v) result.at[v] = a.at[v] - b.at[v];
    return result;
}
template <class T, int Dim>
LaneCorners<T, Dim> sum(const LaneCorners<T, Dim>& a, const T& factor, const LaneCorners<T, Dim>& b) {
    LaneCorners<T, Dim> result;
    for (int v = 0; v < 2 * Dim; ++v) result.at[v] = a.at[v] + factor * b.at[v];
    return result;
}

/// The largest length of a corner.
template <class T, int Dim>
T largest_corner(const LaneCorners<T, Dim>& z) {
    T largest = dot(z.at[0], z.at[0]);
    for (int v = 1; v < 2 * Dim; ++v) largest = higher(largest, dot(z.at[v], z.at[v]));
    return square_root(largest);
}

/// A pair in each lane, along its step.
template <class T, int Dim>
struct LaneStep {
    LaneStep(const LaneCorners<T, Dim>& start_at, const LaneCorners<T, Dim>& end_at, const LaneLaw<T>& of_pair)
        : law(of_pair),
          x_motion(difference(end_at, start_at)),
          start(start_at, of_pair),
          end(end_at, of_pair),
          motion(difference(end.z, start.z)) {}

    [[nodiscard]] LaneCorners<T, Dim> at(const T& s) const { return sum(start.z, s, motion); }
    [[nodiscard]] T size() const { return higher(largest_corner(start.z), largest_corner(end.z)); }
    /// True if corners move by much of the size of the pair.
    [[nodiscard]] FlagsOf<T> is_long() const { return largest_corner(motion) > T(0.03) * size(); }
    /// True if no face turns or changes its shape, beyond what rounding does to corners.
    [[nodiscard]] FlagsOf<T> only_translates() const {
        T change(0.0);
        for (int first = 0; first < 2 * Dim; first += Dim)
            for (int v = first + 1; v < first + Dim; ++v)
                for (int d = 0; d < Dim; ++d) change = higher(change, magnitude(motion.at[v].c[d] - motion.at[first].c[d]));
        return change <= T(8.0 * eps) * size();
    }

    LaneLaw<T> law;
    LaneCorners<T, Dim> x_motion;
    LaneFrame<T, Dim> start, end;
    LaneCorners<T, Dim> motion;  // Delta z
};

/// A state of a pair: W and its gradient, and n in space.
template <class T, int Dim>
struct LaneEnd : LaneEnergy<T, Dim> {
    LaneEnd() = default;
    LaneEnd(const LaneFrame<T, Dim>& frame, const LaneLaw<T>& law) : LaneEnergy<T, Dim>(energy_of(frame.z, law)) {
        const LaneVector<T, Dim> seen = frame.in_space(this->common);
        const FlagsOf<T> is_unit = dot(seen, seen) < T(2.0);  // false where a face has lost its area
        normal = select<T, Dim>((this->facing < law.none) & is_unit, seen, no_vector<T, Dim>());
    }

    LaneVector<T, Dim> normal;  // 0 where the pair has no weight
};

/// A mean gradient in the coordinates of the pair, and what goes with it.
template <class T, int Dim>
struct LaneMean {
    T energy_0, energy_1;
    T depth;                       // the larger one of both ends
    LaneCorners<T, Dim> gradient;  // phi
    T pressure[2 * Dim];
    T area;
    T active_share;
};

/// The discrete gradient.
template <class T, int Dim>
struct LaneClosed {
    LaneCorners<T, Dim> gradient;
    T correction;
    FlagsOf<T> is_rough;  // the correction is not small, or a pair may pass another one between ends without energy
};

/// Takes a mean gradient back to space, and closes the balance of energy along the motion in the coordinates of the pair.
/// Nothing is added where the work is open by round-off of the energies or, in steps that are nothing but round-off, of the
/// force and of the overlap.
template <class T, int Dim>
LaneClosed<T, Dim> closed(const LaneStep<T, Dim>& step, const LaneMean<T, Dim>& mean) {
    LaneClosed<T, Dim> result;
    result.gradient = in_mean_frame(step.start, step.end, step.law, mean.gradient);
    const T open = (mean.energy_1 - mean.energy_0) - dot(result.gradient, step.x_motion);
    const T of_energies = T(8.0 * eps) * (mean.energy_0 + mean.energy_1);
    const T squared_motion = dot(step.motion, step.motion), distance = square_root(squared_motion);
    const T size = square_root(higher(dot(step.start.z, step.start.z), dot(step.end.z, step.end.z)));
    const T force = square_root(dot(mean.gradient, mean.gradient));
    T of_overlap = T(8.0 * eps) * step.law.stiffness * mean.depth * mean.depth;
    for (int d = 1; d < Dim; ++d) of_overlap = of_overlap * size;
    const FlagsOf<T> is_round_off =
        (magnitude(open) <= of_energies) |
        ((distance <= T(1e-9) * size) & (magnitude(open) <= of_energies + of_overlap + T(8.0 * eps) * force * size));
    const T factor = select(is_round_off, T(0.0), open) / select(is_round_off, T(1.0), squared_motion);
    result.gradient = sum(result.gradient, factor, in_mean_frame(step.start, step.end, step.law, step.motion));
    result.correction = magnitude(factor) * distance;
    const FlagsOf<T> has_energy = (mean.energy_0 > T(0.0)) | (mean.energy_1 > T(0.0));
    result.is_rough = (result.correction > T(small_correction) * force) | without(step.is_long(), has_energy);
    const FlagsOf<T> acts = (mean.active_share > T(0.0)) | has_energy;
    const FlagsOf<T> is_lost = turns_over<T>(step.start, step.end);
    for (int v = 0; v < 2 * Dim; ++v)
        for (int d = 0; d < Dim; ++d) {
            T& value = result.gradient.at[v].c[d];
            value = select(acts, select(is_lost, T(__builtin_nan("")), value), T(0.0));
        }
    result.correction = select(acts, result.correction, T(0.0));
    return result;
}

/// A rule with `n` states, weights[i] of energy i.
template <class T, int Dim>
LaneMean<T, Dim> weighed(const LaneEnergy<T, Dim>* const* states, const T* weights, int n) {
    LaneMean<T, Dim> mean;
    mean.area = mean.active_share = T(0.0);
    for (int v = 0; v < 2 * Dim; ++v) {
        mean.gradient.at[v] = no_vector<T, Dim>();
        mean.pressure[v] = T(0.0);
    }
    for (int i = 0; i < n; ++i) {
        const T& weight = weights[i];
        const LaneEnergy<T, Dim>& state = *states[i];
        mean.gradient = sum(mean.gradient, weight, state.gradient);
        for (int v = 0; v < 2 * Dim; ++v) mean.pressure[v] = mean.pressure[v] + weight * state.pressure[v];
        mean.area = mean.area + weight * state.area;
        mean.active_share = mean.active_share + select(state.energy > T(0.0), weight, T(0.0));
    }
    return mean;
}

}  // namespace abut::geometry::lanes
