#pragma once

namespace abut::solid {

/// How a body may move. docs/method.md, Bodies that turn.
enum class Kinematics {
    small,     ///< linear elasticity in one frame: exact where nothing turns; a body that turns by a grows by 1/cos a
    floating,  ///< linear elasticity in a frame that turns with the body: any turn, small strains and small turns inside it
    /// St. Venant-Kirchhoff: any turn and bend, strains to some 0.1; refused where a cell collapses. docs/limits.md
    finite,
    rigid,  ///< no deformation but the skin that contact presses in: six degrees of freedom in space, three in the plane
};

/// How the mean force inside a body of Kinematics::finite is made along a step. docs/method.md, Bodies that bend.
enum class MeanForce {
    automatic,          ///< `closed_trapezoid`
    discrete_gradient,  ///< exact for energy and moment cell by cell; it feeds the alternating mode
    trapezoid,          ///< the mean of the forces at both ends: it feeds no mode, and H~ is not exact
    closed_trapezoid,   ///< the same, with a smooth correction per body that makes energy and moment exact
};

/// Law that acts between faces in contact.
enum class ContactLaw {
    automatic,       ///< `pair_potential`
    reconstruction,  ///< faces that are moved as a whole, normals at rest. docs/method.md, Contact
    pair_potential,  ///< the potential of pairs of faces that tilt and turn. docs/method.md, The potential of a pair
};
/// The one that acts where this one is chosen.
[[nodiscard]] constexpr ContactLaw acting_law(ContactLaw chosen) {
    return chosen == ContactLaw::automatic ? ContactLaw::pair_potential : chosen;
}

}  // namespace abut::solid
