#include "abut/geometry/pair_potential/pair_potential.hpp"

#include "abut/geometry/pair_potential/kernel.hpp"
#include "abut/geometry/pair_potential/pair_frame.hpp"

namespace abut::geometry {
namespace {

Vector<2> common_normal(const PairNormals<2>&, const PairFrame<2>& frame) { return frame.normal; }
Vector<3> common_normal(const PairNormals<3>& normals, const PairFrame<3>& frame) {
    return normals.common[0] * frame.e[0] + normals.common[1] * frame.e[1] + normals.common[2] * frame.e[2];
}

}  // namespace

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
    if (energy.energy != 0.0) result.gradient = in_mean_frame<Dim>(frame, frame, law, energy.gradient);
    return result;
}

template PairState<2> pair_state(const PairCorners<2>&, const PairLaw<2>&);
template PairState<3> pair_state(const PairCorners<3>&, const PairLaw<3>&);
template PairGradient<2> pair_gradient(const PairCorners<2>&, const PairLaw<2>&);
template PairGradient<3> pair_gradient(const PairCorners<3>&, const PairLaw<3>&);

}  // namespace abut::geometry
