#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/solid/boundary/boundary_face.hpp"

namespace abut::solid {

/// A contact of two faces; `no_face` is one of an obstacle.
template <int Dim>
struct TouchingPair {
    BoundaryFace face_1;
    BoundaryFace face_2;
    Vector<Dim> normal;  ///< from the body of face 1 into that of face 2
    double gap;          ///< [m]
};

/// Interaction of two faces in a state; `no_face` is one of an obstacle.
template <int Dim>
struct ActingPair {
    BoundaryFace face_1;
    BoundaryFace face_2;
    Vector<Dim> normal;    ///< from the body of face 1 into that of face 2
    double gap;            ///< [m], < 0 pressed in
    double area;           ///< that they share [m^(Dim-1)]
    double normal_force;   ///< [N], > 0 in compression
    Vector<Dim> force;     ///< on face 2, friction included [N]; face 1 feels the opposite
    Vector<Dim> friction;  ///< part of it that is friction [N]
    Vector<Dim> slip;      ///< motion of face 2 past face 1 in the last step, where there is friction [m]
};

/// Impulse that two bodies have exchanged by contact since the first step. Obstacles count as bodies behind those of the
/// mesh, in their order.
template <int Dim>
struct BodyImpulse {
    std::int32_t body_1;
    std::int32_t body_2;                         ///< > body_1
    Vector<Dim> impulse;                         ///< on body 2 [N s]; body 1 gets the opposite
    double normal_impulse;                       ///< of all pairs of faces along their normals [N s], > 0 in compression
    Vector<Dim> friction = Vector<Dim>::Zero();  ///< part of `impulse` that is friction [N s]
    double rubbing_impulse = 0.0;                ///< part of `normal_impulse` where there is friction [N s]
    /// Sum of normal force times slip of these pairs, over all steps [N m]: over `rubbing_impulse` it is a velocity,
    /// that of body 2 past body 1 where they press.
    Vector<Dim> slip = Vector<Dim>::Zero();
    /// Largest |g|/D of a step above the warning that pairs with `bearing_share` of the normal force reach [-]; 0: none.
    double compression = 0.0;
    std::int64_t compressed_steps = 0;  ///< steps with such a compression

    static auto fields(auto& self) {
        return std::tie(self.body_1, self.body_2, self.impulse, self.normal_impulse, self.friction, self.rubbing_impulse,
                        self.slip, self.compression, self.compressed_steps);
    }
};

/// Part of the normal force of two bodies below which the pairs that are pressed in deepest do not count [-].
inline constexpr double bearing_share = 0.01;

/// Contact pressure [Pa] and smallest gap [m] of each boundary face, in the order of Mesh::boundary_faces; a face without an
/// admitted partner that shares area with it has pressure 0 and gap infinity.
struct ContactField {
    std::vector<double> pressure;
    std::vector<double> gap;
    /// Fields of friction, empty without any: the size of its traction [Pa]; the slip of each face in the last step
    /// [m]; and whether it stuck (1) or slid (2) then, 0 without friction.
    std::vector<double> friction = {};
    std::vector<double> slip = {};
    std::vector<double> sliding = {};
};

}  // namespace abut::solid
