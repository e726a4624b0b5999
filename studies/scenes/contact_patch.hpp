#pragma once
#include <array>

#include "abut/contact/options.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/statics.hpp"

/// Two blocks of unit width and height, one on the other, under a uniform pressure from above: the exact solution is one
/// uniform stress in both, whatever their materials and meshes, since contact is free of friction.
namespace abut::studies {

enum class PatchMesh {
    matching,      ///< bricks, node on node across the contact
    non_matching,  ///< bricks, 3 above 4 in each direction of the contact
    unstructured,  ///< triangles or tetrahedra of Gmsh that do not match
};

/// Support of the sides at xmax (and ymax); the others stand on rollers.
enum class PatchSides {
    rollers,
    free,
    walls,  ///< contact with rigid planes: cells in the corner are pressed on two sides or three
};

struct PatchOptions {
    PatchMesh mesh = PatchMesh::matching;
    PatchSides sides = PatchSides::rollers;
    solid::CornerRule corners = solid::CornerRule::relaxed;
    std::array<double, 2> young{1.0, 7.0};  ///< lower and upper [Pa]
    std::array<double, 2> poisson{0.3, 0.2};
    /// Pressure over the wave modulus of the lower block [-]. Contact answers to the second order of it: areas shared by
    /// faces at the edges change as the blocks slide
    double strain = 1e-11;
    contact::ContactOptions contact;
    solid::FreeFaceRule free_faces = solid::FreeFaceRule::local_equilibrium;
};

/// Largest errors of all cells and contact faces [-].
struct ContactPatchErrors {
    double stress = 0.0;        ///< Frobenius norm of the error over the pressure
    double displacement = 0.0;  ///< over the largest displacement
    double pressure = 0.0;      ///< of the contact pressure, over the pressure
    solid::StaticReport report;
};

/// Throws what `solve_statics` throws. The choices that are there for comparison may not come into balance: see the report.
template <int Dim>
[[nodiscard]] ContactPatchErrors solve_patch(const PatchOptions& options);

}  // namespace abut::studies
