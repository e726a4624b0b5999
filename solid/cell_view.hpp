#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/solid/ccg/ccg.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

/// Cells of a rank (n).
struct OwnCells {
    std::vector<std::int32_t> number;    ///< of each in the whole mesh, increasing
    std::vector<std::int32_t> position;  ///< of each in the part of the rank, increasing
};

/// The cells of the mesh of a solid (Solid::cells), and the path to its points, as long as the solid lives. Cells are
/// numbered as in `Solid::mesh`; stresses and gradients are those of the state that was evaluated last, by a step or
/// otherwise. On several ranks functions that take or return q or p are calls of all ranks, except
/// `displacement_gradient`.
template <int Dim>
class CellView {
public:
    explicit CellView(const Solid<Dim>& solid) : solid_(solid) {}

    /// Cells whose points this rank owns, on one rank all. Needs no other rank.
    [[nodiscard]] OwnCells own() const;

    /// Number in the mesh of a cell of Solid::ccg, which has those of bodies that deform alone.
    [[nodiscard]] std::int32_t of_mesh(std::int32_t of_operators) const;
    /// sigma of a cell in space, with what contact and bonds push its free faces with [Pa]; 0 in rigid bodies.
    [[nodiscard]] Matrix<Dim> stress(std::int32_t cell) const;
    /// In 2D: sigma_zz of a cell, which `stress` does not have [Pa]; of an elastic body that of small strains, nu
    /// (sigma_xx + sigma_yy). In 3D 0.
    [[nodiscard]] double out_of_plane_stress(std::int32_t cell) const;
    /// Equivalent plastic strain of a cell [-]; 0 where its material has none.
    [[nodiscard]] double plastic_strain(std::int32_t cell) const;
    /// F - I of a cell in space, in q: a point of the cell that is at X at rest is displaced by the displacement of the
    /// cell and this times X - x_c. On several ranks of an own cell, without the others.
    [[nodiscard]] Matrix<Dim> displacement_gradient(std::int32_t cell, std::span<const double> q) const;
    /// Reports on the stencils of the faces of all ranks, each counted where its first cell is an own one. A call of all
    /// ranks. On several `worst_weight` is of all, `worst_face` and `lowered_faces` are those of this rank, numbered as in
    /// Solid::ccg.
    [[nodiscard]] StencilReports stencils() const;
    /// Largest deformation of cells of large strains in all steps so far. H~ does not show where they collapse: a step in
    /// which det F of one falls to 0.1 throws Diverged.
    [[nodiscard]] const FiniteExtremes& finite_extremes() const;

    /// Displacement of the cells (n_cells) [m] in q.
    [[nodiscard]] std::vector<Vector<Dim>> displacement(std::span<const double> q) const;
    /// Displacement of the vertices of the mesh (n_vertices) [m] in q, which was evaluated last: the mean over the
    /// cells around each of where these carry it, turned and stretched as they are. Throws BadInput on several ranks.
    [[nodiscard]] std::vector<Vector<Dim>> vertex_displacement(std::span<const double> q) const;
    /// Velocity of the cells (n_cells) [m/s] at momenta p.
    [[nodiscard]] std::vector<Vector<Dim>> velocity(std::span<const double> p) const;
    /// q (n_points, Dim) for displacements of the cells: rigid bodies take the rigid motion that is nearest [m].
    [[nodiscard]] std::vector<double> to_q(std::span<const Vector<Dim>> displacement) const;
    /// p (n_points, Dim) for velocities of the cells where they are at rest: the same [kg m/s].
    [[nodiscard]] std::vector<double> to_p(std::span<const Vector<Dim>> velocity) const;

private:
    [[nodiscard]] std::span<const Vector<Dim>> own_points_of(std::size_t rigid, std::span<const Vector<Dim>> q) const;

    const Solid<Dim>& solid_;
};

}  // namespace abut::solid
