#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// u_f = sum_j weights[j] u_cells[j]: barycentric coordinates of x_f in a simplex of cell centroids, exact for affine
/// fields.
template <int Dim, class Real = double>
struct FaceStencil {
    std::array<std::int32_t, Dim + 1> cells;
    std::array<Real, Dim + 1> weights;  ///< they sum to 1
};

/// How far the reconstruction had to extrapolate: faces whose point lies outside every acceptable simplex.
struct StencilReport {
    std::int64_t faces = 0;                     ///< faces that were given a stencil
    std::int64_t extrapolated = 0;              ///< faces with a weight below -1e-3
    double worst_weight = 0.0;                  ///< the most negative weight
    std::int32_t worst_face = -1;               ///< the face that has it; -1: no face has a negative weight
    std::int64_t lowered_floor = 0;             ///< faces for which the volume floor had to be halved
    std::vector<std::int32_t> lowered_faces{};  ///< these, in the order in which they were asked for

    /// Counts a face whose stencil has this lowest weight.
    void add(std::int32_t face, double lowest_weight);
};

/// Reports on all faces of a solid: CellView::stencils.
struct StencilReports {
    StencilReport interior;  ///< of faces between cells
    StencilReport boundary;  ///< of boundary faces whose displacement is extrapolated
};

/// A simplex for each of `faces`, out of the nearest cell centroids of the same body (10 in 2D, 14 in 3D, up to four times
/// as many where these span none): least extrapolation (in whole steps of 1e-3, rounded down), then smallest sum of
/// distances to x_f, then cell numbers (where sums are equal to a millionth of the least distance: rounding has no say);
/// its volume at least 0.05 of the face's first cell, and if there is none, half of that again and again.
/// A boundary face around a hollow, which that choice may span with cells that are far away, also looks at the neighbours of
/// its cell, and takes the simplex for which |sum w (x - x_f) (x - x_f)^T| is least.
/// Where cells have left the mesh it takes cells that hang together with the face's first one, not those across a crack,
/// if they span one.
/// The choice decides the stable step. docs/method.md, Space. Throws BadInput naming the face when the centroids near
/// it span no simplex (a body one cell thick).
template <int Dim>
[[nodiscard]] std::vector<FaceStencil<Dim>> select_stencils(const mesh::Mesh<Dim>& mesh, std::span<const std::int32_t> faces,
                                                            StencilReport& report);

}  // namespace abut::solid
