#pragma once
// Private to the layer.
#include <algorithm>
#include <array>
#include <limits>

#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::geometry {

/// chi and its derivative.
struct FacingWeight {
    double chi;
    double slope;  ///< dchi/dc
};
[[nodiscard]] inline FacingWeight facing_weight(double cosine, const FacingFade& fade) {
    const double width = fade.none - fade.full;
    const double y = std::clamp((fade.none - cosine) / width, 0.0, 1.0);
    return {y * y * (3.0 - 2.0 * y), -6.0 * y * (1.0 - y) / width};
}

/// n_1 . n_2 above which the normal of a pair is not asked for.
inline constexpr double no_normal_cosine = 0.3;

/// n_1 . n_2, at any place and turn of the pair.
template <int Dim>
[[nodiscard]] double facing_cosine(const PairCorners<Dim>& corners);

/// W of a pair in coordinates z in which nothing but the shape of the pair is left (PairFrame), and its gradient there.
template <int Dim>
struct PairEnergy {
    double energy = 0.0;
    double area = 0.0;             ///< where g < 0
    double gap = 0.0;              ///< the least of g, 0 without such a part
    PairCorners<Dim> gradient{};   ///< dW/dz
    PairPressure<Dim> pressure{};  ///< with the gradient
};

/// All that the directions of two faces decide.
template <int Dim>
struct PairNormals;

template <>
struct PairNormals<2> {
    explicit PairNormals(const PairCorners<2>& z);

    std::array<Vector<2>, 2> edge;  ///< second corner less first
    std::array<double, 2> length;
    std::array<double, 2> slope;  ///< of eta over xi; meaningless where the faces do not look at each other
    double facing;                ///< n_1 . n_2
};

template <>
struct PairNormals<3> {
    explicit PairNormals(const PairCorners<3>& z);

    std::array<Vector<3>, 2> edge_b, edge_c;  ///< second and third corner less first
    std::array<Vector<3>, 2> normal;
    std::array<double, 2> twice_area;
    double facing;  ///< n_1 . n_2
    // Set where the faces have a normal in common.
    Vector<3> common;                  ///< n
    double difference;                 ///< |n_1 - n_2|
    std::array<Vector<3>, 2> tangent;  ///< with n right-handed
    std::array<Vector<2>, 2> slope;    ///< of the height along n over the plane, gamma
};

/// Overlap and gap of two faces along n, `offset` included (PairLaw), whatever k: for states, not for forces.
struct PairView {
    double overlap = 0.0;  ///< |P|
    double gap = std::numeric_limits<double>::infinity();
};

template <int Dim>
[[nodiscard]] PairEnergy<Dim> pair_energy(const PairNormals<Dim>& normals, const PairCorners<Dim>& z,
                                          const PairLaw<Dim>& law, bool with_gradient);
template <int Dim>
[[nodiscard]] PairView pair_view(const PairNormals<Dim>& normals, const PairCorners<Dim>& z, double offset);

}  // namespace abut::geometry
