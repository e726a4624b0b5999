#pragma once
// Private to the layer.
#include <array>

#include "abut/base/vector.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::geometry {

/// Coordinates z of the corners of a pair that do not change when it moves or turns as a whole.
template <int Dim>
struct PairFrame;

template <>
struct PairFrame<2> {
    PairFrame(const PairCorners<2>& x, const PairLaw<2>& law);

    PairCorners<2> y;  ///< from the mean of the corners
    Vector<2> m;       ///< n_1 - n_2 with lengths at rest, linear in x
    double m_length;
    Vector<2> along;   ///< t
    Vector<2> normal;  ///< n = m/|m|
    PairCorners<2> z;  ///< (t . y, n . y)
};

template <>
struct PairFrame<3> {
    PairFrame(const PairCorners<3>& x, const PairLaw<3>& law);

    PairCorners<3> y;
    Vector<3> edge_b, edge_c;    ///< of face 1, from its first corner
    std::array<Vector<3>, 3> e;  ///< along edge_b, in the face, along its normal
    PairCorners<3> z;            ///< (e_1 . y, e_2 . y, e_3 . y)
};

/// True if the pair turns by half a turn along a step, or next to it: there is no way back then that keeps the momenta.
template <int Dim>
[[nodiscard]] bool turns_over(const PairFrame<Dim>& start, const PairFrame<Dim>& end);

/// The way back along a step: Delta z is an exact discrete derivative of z, and this is its transpose. For any phi,
/// sum result . Delta x = sum phi . Delta z, and result has neither a sum nor moments about the mean of both ends.
template <int Dim>
[[nodiscard]] PairCorners<Dim> in_mean_frame(const PairFrame<Dim>& start, const PairFrame<Dim>& end, const PairLaw<Dim>& law,
                                             const PairCorners<Dim>& phi);

}  // namespace abut::geometry
