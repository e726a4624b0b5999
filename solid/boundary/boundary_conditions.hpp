#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_face.hpp"

namespace abut::solid {

/// Rule for the displacement of a boundary face without a prescribed value. docs/method.md, Space.
enum class FreeFaceRule {
    local_equilibrium,  ///< sigma_c n = t in the cell: the face minimises the energy of its cell
    extrapolate,        ///< affine extrapolation from nearby cells: large parasitic energy in contact, for comparison
    adjacent,           ///< u_f = u_c: loses accuracy and costs energy in a rotation, for comparison
};

/// Response of the free faces of a cell when contact moves another of its boundary faces. docs/method.md, Contact.
enum class CornerRule {
    /// They keep the balance of their cell (`local_equilibrium` only): stresses at free sides are right. Where contact
    /// presses on two sides of one cell, each side moves the other: off by 18 % (2D) to 39 % (3D) of the pressure
    relaxed,
    /// They do not answer. Where contact presses on two sides of one cell: off by 6 % (2D) to 11 % (3D); beside a
    /// free side the cell holds 47 % (2D) to 67 % (3D) of the pressure too much
    fixed,
};

/// How contact acts on the free faces of bodies, beside tractions.
enum class FreeFaces {
    stay_alone,
    are_moved,  ///< contact by the modified reconstruction: what it moves a face by is in the stress of the cell and in its traces
    are_pushed,  ///< contact by the pair potential: its forces are not in the stress of the cell
};

/// A vector that may depend on time and position.
template <int Dim>
using Field = std::function<Vector<Dim>(double time, const Vector<Dim>& position)>;

/// Which part of a face's displacement is prescribed.
enum class Constraint {
    full,        ///< all of it
    normal,      ///< along the face normal; tangential free (roller, symmetry plane)
    components,  ///< the chosen components
};

template <int Dim>
struct DirichletCondition {
    std::string group;  ///< name of a boundary group of the mesh
    Constraint constraint = Constraint::full;
    std::array<bool, Dim> components{};       ///< for Constraint::components
    Vector<Dim> value = Vector<Dim>::Zero();  ///< u_D [m]
    Field<Dim> history;                       ///< u_D(t, x) [m] if it varies; then `value` is not used
};

/// On a body that may turn its work is booked, and it is a force at the centroid of each face, which is extrapolated
/// from the cells around; where it follows a floating body the cell behind the face balances it. docs/method.md, Bodies
/// that turn.
template <int Dim>
struct TractionCondition {
    std::string group;
    Vector<Dim> value = Vector<Dim>::Zero();  ///< t [Pa]
    Field<Dim> history;                       ///< t(t, x) [Pa] if it varies; constant within a step, taken at its start
    /// It turns with the body; on one of Kinematics::finite with its face, and is along its normal: a pressure, which
    /// acts on the area that the face has then. On bodies of Kinematics::small no difference
    bool follows = false;
    /// It is set by face between steps (Solid::set_traction): a fluid. Until then it is `value`; it has no `history`.
    bool from_outside = false;
};

template <int Dim>
struct BoundaryConditions {
    FreeFaceRule free_face_rule = FreeFaceRule::local_equilibrium;
    CornerRule corner_rule = CornerRule::relaxed;
    std::vector<DirichletCondition<Dim>> dirichlet;
    std::vector<TractionCondition<Dim>> traction;
    /// Boundary faces of the mesh whose own cell does not balance what holds them, so that they are extrapolated from
    /// the cells around: they are bonded face to face for ever, or a traction pulls at their extrapolated centroids (a
    /// dead one on a floating body). Read by operators alone: a solid finds them by itself
    std::vector<std::int32_t> joined_faces = {};
    /// Boundary faces of the mesh that bonds move to where tractions balance, from where each would be without its
    /// traction while the other ones of its cell stay where the cells around point. Read by operators alone
    std::vector<std::int32_t> glued_faces = {};
    /// Cells of thick parts, increasing, where contact pushes free faces by the pair potential: their traces do without
    /// the balance of these (BoundaryReconstruction::affine). Read by operators alone: a solid finds them by itself
    std::vector<std::int32_t> thick_cells = {};
};

/// The conditions sorted to the boundary faces of a mesh.
template <int Dim>
struct FaceConditions {
    IdVector<BoundaryFace, Matrix<Dim>> prescribed;  ///< P_f, projector onto all prescribed directions (n_boundary)
    IdVector<BoundaryFace, char> joined;             ///< BoundaryConditions::joined_faces (n_boundary)
    IdVector<BoundaryFace, char> glued;              ///< BoundaryConditions::glued_faces (n_boundary)
    std::vector<char> is_thick;                      ///< BoundaryConditions::thick_cells (n_cells); empty: none is
    /// A boundary face of a Dirichlet condition and the directions that this condition prescribes there.
    struct Prescribed {
        BoundaryFace face;
        Matrix<Dim> projector;
    };
    std::vector<std::vector<Prescribed>> dirichlet;   ///< by condition
    std::vector<std::vector<BoundaryFace>> traction;  ///< boundary faces by condition

    /// Whether a traction acts on a face (n_boundary).
    [[nodiscard]] IdVector<BoundaryFace, char> are_loaded() const {
        IdVector<BoundaryFace, char> loaded(prescribed.size(), 0);
        for (const std::vector<BoundaryFace>& faces : traction)
            for (const BoundaryFace b : faces) loaded[b] = 1;
        return loaded;
    }
};

/// Throws BadInput for an unknown group, two conditions that prescribe the same direction of a face, a
/// traction on a fully prescribed face, or a component condition without components.
template <int Dim>
[[nodiscard]] FaceConditions<Dim> sort_to_faces(const mesh::Mesh<Dim>& mesh, const BoundaryConditions<Dim>& conditions);

}  // namespace abut::solid
