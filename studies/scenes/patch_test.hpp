#pragma once
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/statics.hpp"

/// Patch test of what every discretisation of elasticity must keep: constant strain, and no energy of rigid motions.
namespace abut::studies {

/// Source of the affine displacement of the patch test.
enum class PatchBoundary {
    displacement,  ///< imposed on all sides
    mixed,         ///< on the sides across the first axis; the others have the traction of the constant stress
};

/// Largest errors of the static solution, relative to the largest exact value.
struct BulkPatchErrors {
    double displacement;  ///< of the cells [-]
    double stress;        ///< in the Frobenius norm [-]
    solid::StaticReport report;
};

/// A box under the boundary conditions of a displacement A x + b, A without symmetry, E = 70e3, nu = 0.3; solved from
/// u = 0 as far as rounding allows. Throws as solid::solve_statics.
template <int Dim>
[[nodiscard]] BulkPatchErrors patch_test(const mesh::Mesh<Dim>& box, PatchBoundary boundary, solid::FreeFaceRule free_faces);

/// Largest force on a cell [-], over |sigma| times the largest face, that a step in single precision finds in the exact
/// field of `patch_test`, where there is none.
template <int Dim>
[[nodiscard]] double single_precision_force(const mesh::Mesh<Dim>& box, PatchBoundary boundary, solid::FreeFaceRule free_faces);

/// Eigenvalues of the stiffness K of a free body.
struct ZeroModes {
    int count;            ///< of |eigenvalue| below 1e-11 of the highest
    double largest_zero;  ///< the largest |eigenvalue| of these over the highest [-]
    double next;          ///< the smallest of all others over the highest [-]
};

/// From a dense matrix: for small meshes, up to some thousand unknowns. Throws std::runtime_error where the decomposition
/// fails.
template <int Dim>
[[nodiscard]] ZeroModes zero_modes(const mesh::Mesh<Dim>& mesh, solid::FreeFaceRule free_faces);

}  // namespace abut::studies
