#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <limits>

#include "abut/base/vector.hpp"

namespace abut::solid {

/// Stands for the body of an anchor that stands still.
inline constexpr std::int32_t ground = -1;

/// A place on a body, or on the ground. Of a body that deforms it is a mean of cells around that place, weighted so that it
/// moves exactly with them where they move affinely.
template <int Dim>
struct Anchor {
    std::int32_t body = ground;                  ///< number in the mesh
    Vector<Dim> position = Vector<Dim>::Zero();  ///< at rest [m]
    /// Radius of support on a body that deforms [m]: held by cells with their centre that near, and by as many of the
    /// next ones as span space
    double radius = 0.0;
};

/// A spring and a dashpot between two anchors: with r from the first to the second, V = k/2 (|r| - L)^2. With L = 0 it is a
/// hinge, as stiff as k: it holds two places together, or one to the ground, and lets them turn. The dashpot acts along
/// r, of a hinge in all directions; its work is booked.
template <int Dim>
struct Spring {
    Anchor<Dim> first;
    Anchor<Dim> second;
    double stiffness = 0.0;  ///< k [N/m], >= 0
    double length = 0.0;     ///< L [m], >= 0
    double damping = 0.0;    ///< c [N s/m], >= 0
};

/// Faces that are glued where they lie on each other at rest, whether their meshes match or not: of two bodies or of
/// two groups. They have no contact with each other. docs/method.md, Bonds.
struct Bond {
    std::array<std::int32_t, 2> sides;  ///< numbered as BodyFriction::bodies, without obstacles
    /// Largest traction that it bears [Pa], pressure left out, which must part it if G is 0; infinity: it holds for ever
    double strength = std::numeric_limits<double>::infinity();
    /// G [J/m^2] >= 0 that it takes per area as it opens, with a traction that falls from the strength to 0; 0: it
    /// breaks at once
    double fracture_energy = 0.0;
    /// m > 0 of a Weibull distribution, from which each overlap of two faces draws its strength: a share
    /// 1 - exp(-(s/strength)^m) of them has one below s; infinity: all have `strength`
    double weibull_modulus = std::numeric_limits<double>::infinity();
    std::uint32_t seed = 0;  ///< of the draws
    /// It holds grains together, pieces of what was one body: floating ones have one frame as long as bonds of this kind
    /// hold them, so that they bear what the body in one piece does. Between metal it is as any other bond
    bool of_grains = false;
};

/// A moment on a body as a whole, as of a drive or a brake: a given part and one against its spin. Its work is booked.
template <int Dim>
struct BodyMoment {
    std::int32_t body = 0;                               ///< number in the mesh
    AxialVector<Dim> moment = AxialVector<Dim>::Zero();  ///< [N m]
    double damping = 0.0;                                ///< >= 0 [N m s]
    /// The moment at a time [s], finite, in place of `moment`: constant within a step, as it begins. Empty: it does not vary
    std::function<AxialVector<Dim>(double time)> history = {};
};

}  // namespace abut::solid
