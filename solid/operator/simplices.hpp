#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/large_array.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// A cell with Dim + 1 faces.
template <int Dim>
struct SimplexCell {
    std::array<std::int32_t, Dim + 1> faces;
    std::array<std::int32_t, Dim + 1> neighbours;  // behind each of them; the cell itself on the boundary
};

/// A simplex with one boundary face, which is free and in equilibrium with the other faces: no row of R is needed, the cell
/// tells where the face is.
struct CondensedCell {
    std::int32_t cell;
    BoundaryFace face;
};

/// The bodies of linear, isotropic elasticity that are made of simplices throughout. Their face displacements are
/// affine in each cell, which saves most of what other shapes need. docs/method.md, Space.
template <int Dim>
class Simplices {
public:
    /// None.
    Simplices() = default;
    /// `kinematics`: one per body; all that are not `finite` are linear, as all are where none are given.
    Simplices(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const FaceConditions<Dim>& conditions,
              FreeFaceRule rule, std::span<const Kinematics> kinematics);

    [[nodiscard]] bool contains(std::ptrdiff_t cell) const {
        return !cells_.empty() && cells_[static_cast<std::size_t>(cell)].faces[0] >= 0;
    }
    /// Whether all cells of the mesh are of such bodies.
    [[nodiscard]] bool all() const { return all_; }
    [[nodiscard]] const SimplexCell<Dim>& operator[](std::ptrdiff_t cell) const {
        return cells_[static_cast<std::size_t>(cell)];
    }
    /// By cell, as the function above; empty: no body is of simplices.
    [[nodiscard]] const LargeArray<SimplexCell<Dim>>& cells() const { return cells_; }
    [[nodiscard]] const std::vector<BoundaryFace>& condensed_faces() const { return condensed_face_; }
    /// By cell.
    [[nodiscard]] std::span<const CondensedCell> condensed() const { return condensed_; }
    /// The boundary face of a condensed cell; `no_face` for others.
    [[nodiscard]] BoundaryFace condensed_face(std::ptrdiff_t cell) const {
        return cells_.empty() ? no_face : condensed_face_[static_cast<std::size_t>(cell)];
    }

private:
    void set_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell);
    void condense(const mesh::Mesh<Dim>& mesh, const FaceConditions<Dim>& conditions);

    bool all_ = false;
    LargeArray<SimplexCell<Dim>> cells_;  // of all cells, without faces where they are of other bodies; empty: none are
    std::vector<CondensedCell> condensed_;
    std::vector<BoundaryFace> condensed_face_;
};

}  // namespace abut::solid
