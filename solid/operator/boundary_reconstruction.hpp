#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/operator/stencil.hpp"

namespace abut::solid {

/// A free face of a cell that contact pushes: in the traces of the cell it is where the cells around point.
template <int Dim>
struct AffineFace {
    BoundaryFace face;
    FaceStencil<Dim> stencil;
    Matrix<Dim> free_part;  ///< projector onto the directions that are not prescribed
};

/// û = R u + B u_D + L t on the boundary faces, and ũ = û + delta + sum of C delta where contact moves faces by delta.
/// docs/method.md, Space and Contact.
template <int Dim>
struct BoundaryReconstruction {
    std::vector<std::int32_t> offsets{0};  ///< (n_boundary + 1)
    std::vector<std::int32_t> cells;
    std::vector<Matrix<Dim>> weights;             ///< R; they sum to the identity where nothing is prescribed
    std::vector<Matrix<Dim>> deficit;             ///< identity less the sum of a row's weights (n_boundary)
    std::vector<std::int32_t> load_offsets{0};    ///< (n_boundary + 1)
    std::vector<BoundaryFace> load_faces;         ///< boundary faces whose u_D or t enters
    std::vector<Matrix<Dim>> from_displacement;   ///< B
    std::vector<Matrix<Dim>> from_traction;       ///< L [m/Pa]
    std::vector<std::int32_t> answer_offsets{0};  ///< (n_boundary + 1)
    /// Free faces of the same cell that a correction of a face moves; itself where a direction is prescribed, which it
    /// undoes
    std::vector<BoundaryFace> answer_faces;
    std::vector<Matrix<Dim>> answers;  ///< C: by how much
    /// k_f = n . A_ff n / |f|, what the answers leave of it, stabilisation left out (n_boundary); infinity: the displacement
    /// along the normal is prescribed [Pa/m]
    std::vector<double> normal_stiffness;
    std::vector<AffineFace<Dim>> affine;                          ///< cell by cell, increasing: FaceConditions::is_thick
    StencilReport report;                                         ///< of the affine extrapolations that were needed
    std::vector<std::pair<BoundaryFace, double>> lowest_weights;  ///< of each of these, in the order of the faces [-]

    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(offsets.size()) - 1; }
    /// visit(face, C) for each face that answers to a correction of b.
    template <class Visit>
    void for_each_answer(BoundaryFace b, const Visit& visit) const {
        for (std::int32_t i = answer_offsets[number_of(b)]; i < answer_offsets[number_of(b) + 1]; ++i)
            visit(answer_faces[i], answers[i]);
    }
};

/// `interior` holds a stencil for every interior face, by face number. Free faces of bodies of Kinematics::finite (one per
/// body; empty: none) are extrapolated, whatever the rule: FreeCell says what they do beside that.
template <int Dim>
[[nodiscard]] BoundaryReconstruction<Dim> reconstruct_boundary(const mesh::Mesh<Dim>& mesh,
                                                               std::span<const FaceStencil<Dim>> interior,
                                                               std::span<const Material> materials,
                                                               const FaceConditions<Dim>& conditions, FreeFaceRule rule,
                                                               CornerRule corner_rule,
                                                               std::span<const Kinematics> kinematics);

/// Whether a free face answers to contact of another one of its cell. Faces that lie nearly in one plane are pressed
/// together, and a plate of one cell would give way altogether.
template <int Dim>
[[nodiscard]] bool meet_at_corner(const Vector<Dim>& normal_f, const Vector<Dim>& normal_g) {
    constexpr double largest_cosine = 0.6 + 1e-9;  // between 53 and 127 degrees, and rounding
    return std::abs(normal_f.dot(normal_g)) <= largest_cosine;
}
/// Least stiffness that a face keeps as others answer, over Young's modulus |f|/|c|. Below it none answers.
inline constexpr double least_stiffness = 0.5;

/// A_fg of a cell: the answer of dV/dũ_f to a displacement of g, stabilisation left out; the area
/// vectors |f| n_f and |g| n_g point out of the cell. docs/method.md, Space.
template <int Dim>
[[nodiscard]] Matrix<Dim> face_stiffness(double lambda, double mu, double cell_measure, const Vector<Dim>& area_f,
                                         const Vector<Dim>& area_g);

}  // namespace abut::solid
