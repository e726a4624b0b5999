#pragma once
// Private to the layer.
#include <cmath>

#include "abut/contact/nodal_step.hpp"
#include "abut/contact/pairs/nodal_pairs.hpp"
#include "abut/contact/step.hpp"

namespace abut::contact {

/// Largest figure that a step may give back of one pair, in any unit: sums and products of a few of these are numbers.
inline constexpr double largest_figure = 1e150;

/// Whether all figures are numbers of at most `largest_figure`. `magnitudes`: their sum; NaN is not.
[[nodiscard]] inline bool is_usable(double magnitudes) { return magnitudes <= largest_figure; }

template <int Dim>
[[nodiscard]] double magnitudes(const geometry::PairMeanGradient<Dim>& found) {
    double sum = std::abs(found.energy_0) + std::abs(found.energy_1) + std::abs(found.gap_0) + std::abs(found.gap_1) +
                 std::abs(found.area) + std::abs(found.correction);
    for (const Vector<Dim>& corner : found.gradient) sum += corner.cwiseAbs().sum();
    return sum;
}

/// Throws Diverged that names both faces of a pair of the pair potential, and why its forces may have left the range of
/// numbers: a face that collapses or turns over in the step, or what stiffness and depth make of it.
template <int Dim>
[[noreturn]] void refuse_pair(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair,
                              const geometry::PairMeanGradient<Dim>& found, PointsView<Dim> x_0, PointsView<Dim> x_1);

/// Throws Diverged for a body whose forces, moments or work add up to more than numbers can say.
template <int Dim>
void check_bodies(const NodalStep<Dim>& step);

/// Throws Diverged that names the faces of the first pair of a step of the reconstruction whose figures are not usable.
template <int Dim>
void check_forces(const SurfaceView<Dim>& surface, const ContactStep<Dim>& step);

}  // namespace abut::contact
