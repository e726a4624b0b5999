#include "abut/geometry/pair_potential/pair_potential.hpp"

#include <Eigen/Geometry>  // cross()
#include <algorithm>
#include <array>

#include "abut/geometry/pair_potential/kernel.hpp"
#include "abut/geometry/pair_potential/pair_frame.hpp"

namespace abut::geometry {
namespace {

Vector<2> common_normal(const PairNormals<2>&, const PairFrame<2>& frame) { return frame.normal; }
Vector<3> common_normal(const PairNormals<3>& normals, const PairFrame<3>& frame) {
    return normals.common[0] * frame.e[0] + normals.common[1] * frame.e[1] + normals.common[2] * frame.e[2];
}

/// Normals of both faces, of any length in 2D and for n with its lengths at rest.
std::array<Vector<2>, 2> weighed_normals(const PairCorners<2>& x, const PairLaw<2>& law) {
    const Vector<2> d_1 = (x[1] - x[0]) / law.length[0], d_2 = (x[3] - x[2]) / law.length[1];
    return {Vector<2>(d_1[1], -d_1[0]), Vector<2>(d_2[1], -d_2[0])};
}
std::array<Vector<3>, 2> weighed_normals(const PairCorners<3>& x, const PairLaw<3>&) {
    return {(x[1] - x[0]).cross(x[2] - x[0]).normalized(), (x[4] - x[3]).cross(x[5] - x[3]).normalized()};
}

/// From the highest corner of face 1 to the lowest one of face 2 along a direction.
template <int Dim>
double clearance(const PairCorners<Dim>& x, const Vector<Dim>& direction) {
    double highest = direction.dot(x[0]), lowest = direction.dot(x[Dim]);
    for (int v = 1; v < Dim; ++v) {
        highest = std::max(highest, direction.dot(x[v]));
        lowest = std::min(lowest, direction.dot(x[Dim + v]));
    }
    return lowest - highest;
}

/// From the middle of face 1 to that of face 2, times Dim.
template <int Dim>
Vector<Dim> between_middles(const PairCorners<Dim>& x) {
    Vector<Dim> between = x[Dim] - x[0];
    for (int v = 1; v < Dim; ++v) between += x[Dim + v] - x[v];
    return between;
}

}  // namespace

template <int Dim>
PairPlacement<Dim> pair_placement(const PairCorners<Dim>& corners, const PairLaw<Dim>& law) {
    const auto normals = weighed_normals(corners, law);
    PairPlacement<Dim> found{PairPlace::unclear, normals[0].dot(normals[1]), normals[0] - normals[1]};
    if constexpr (Dim == 2) found.facing /= normals[0].norm() * normals[1].norm();
    if (found.facing >= not_facing_cosine) {
        found.place = PairPlace::turned_away;
        return found;
    }
    found.normal.normalize();
    if (clearance<Dim>(corners, found.normal) >= 0.0) {
        found.place = PairPlace::apart;
        return found;
    }
    const Vector<Dim> between = between_middles<Dim>(corners);
    const Vector<Dim> aside = between - between.dot(found.normal) * found.normal;
    if (clearance<Dim>(corners, aside) > 1e-14 * between.squaredNorm()) found.place = PairPlace::beside;
    return found;
}

template <int Dim>
PairState<Dim> pair_state(const PairCorners<Dim>& corners, const PairLaw<Dim>& law) {
    PairState<Dim> state;
    state.facing = facing_cosine<Dim>(corners);
    state.gap = std::numeric_limits<double>::infinity();
    if (state.facing > no_normal_cosine) return state;
    const PairFrame<Dim> frame(corners, law);
    const PairNormals<Dim> normals(frame.z);
    const PairEnergy<Dim> energy = pair_energy<Dim>(normals, frame.z, law.stiffness, false);
    const PairView view = pair_view<Dim>(normals, frame.z);
    state.energy = energy.energy;
    state.area = energy.area;
    state.overlap = view.overlap;
    state.gap = view.gap;
    state.normal = common_normal(normals, frame);
    return state;
}

template <int Dim>
PairGradient<Dim> pair_gradient(const PairCorners<Dim>& corners, const PairLaw<Dim>& law) {
    PairGradient<Dim> result;
    result.gradient.fill(Vector<Dim>::Zero());
    if (facing_cosine<Dim>(corners) >= not_facing_cosine) return result;
    const PairFrame<Dim> frame(corners, law);
    const PairEnergy<Dim> energy = pair_energy<Dim>(PairNormals<Dim>(frame.z), frame.z, law.stiffness, true);
    result.energy = energy.energy;
    result.area = energy.area;
    result.gap = energy.gap;
    if (energy.energy != 0.0) result.gradient = in_mean_frame<Dim>(frame, frame, law, energy.gradient);
    return result;
}

template PairPlacement<2> pair_placement(const PairCorners<2>&, const PairLaw<2>&);
template PairPlacement<3> pair_placement(const PairCorners<3>&, const PairLaw<3>&);
template PairState<2> pair_state(const PairCorners<2>&, const PairLaw<2>&);
template PairState<3> pair_state(const PairCorners<3>&, const PairLaw<3>&);
template PairGradient<2> pair_gradient(const PairCorners<2>&, const PairLaw<2>&);
template PairGradient<3> pair_gradient(const PairCorners<3>&, const PairLaw<3>&);

}  // namespace abut::geometry
