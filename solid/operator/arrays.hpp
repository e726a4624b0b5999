#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/solid/operator/boundary_reconstruction.hpp"
#include "abut/solid/operator/cell_form.hpp"
#include "abut/solid/operator/coefficients.hpp"
#include "abut/solid/operator/directed_cells.hpp"
#include "abut/solid/operator/simplices.hpp"

namespace abut::solid {

/// A face as one of its cells has it.
struct HalfFace {
    std::int32_t face;
    std::int32_t first;  // cell on the first side of the face
    std::int32_t twin;   // that of the cell on the other side of the face; itself on the boundary
};

/// For each index of a range: the rows in which it occurs, increasing. The transpose of a sparse matrix, without its
/// weights.
template <class Row>
struct Occurrences {
    LargeArray<std::int32_t> offsets;
    LargeArray<Row> rows;
};

/// A cell with free faces that contact pushes: CcgArrays::affine.
struct AffineCell {
    std::int32_t cell;
    std::int32_t begin, end;  // of its faces among those of all such cells
};

/// Contact on nodes is not in the stress of a cell: its free faces balance as if nothing touched them.
/// Jumps that took these faces for granted would hold the cell back, and leave the layers behind a contact with 0.8 to
/// 1.1 of the pressure. In the traces I_c(x_f) of such cells free faces are affine instead, whatever pushes them.
/// docs/method.md, Contact.
struct AffineTraces {
    std::vector<AffineCell> cells;         // increasing
    std::vector<std::int32_t> cell_index;  // of a cell in `cells`; -1: it is none. Empty without any
    std::vector<BoundaryFace> faces;       // cell by cell
    std::vector<std::int32_t> face_index;  // of a boundary face in `faces`; -1: it is none. Empty without any
    Occurrences<std::int32_t> of_cell;  // by position in CcgArrays::boundary_cells: indices of faces whose stencils use it
};

/// Data of the operators of a mesh, in the order in which they run over it.
template <int Dim>
struct CcgArrays : CcgCoefficients<Dim, double> {
    using CcgCoefficients<Dim, double>::faces;
    using CcgCoefficients<Dim, double>::cells;
    using CcgCoefficients<Dim, double>::stencils;
    using CcgCoefficients<Dim, double>::lever_arms;
    using CcgCoefficients<Dim, double>::shares;
    using CcgCoefficients<Dim, double>::of_cell_weights;
    using CcgCoefficients<Dim, double>::boundary_weights;
    using CcgCoefficients<Dim, double>::boundary_cell_weights;
    using CcgCoefficients<Dim, double>::affine_parts;
    using CcgCoefficients<Dim, double>::affine_weights;

    CcgArrays(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials, const FaceConditions<Dim>& conditions,
              FreeFaceRule rule, CornerRule corner_rule, std::span<const Kinematics> kinematics = {},
              CellForm form = CellForm::automatic);

    [[nodiscard]] std::int32_t n_cells() const { return static_cast<std::int32_t>(cells.size()); }
    [[nodiscard]] std::int32_t n_faces() const { return static_cast<std::int32_t>(face_cells.size()); }
    [[nodiscard]] std::int32_t n_boundary() const { return boundary.size(); }
    /// The only cell of a boundary face.
    [[nodiscard]] std::int32_t cell_of(BoundaryFace b) const { return face_cells[face_of(b)][0]; }
    /// Its index among all faces.
    [[nodiscard]] std::int32_t face_of(BoundaryFace b) const { return boundary_faces[static_cast<std::size_t>(b)]; }
    /// Out of the body.
    [[nodiscard]] Vector<Dim> normal_of(BoundaryFace b) const {
        return Vector<Dim>(faces[face_of(b)].area_vector.data()).normalized();
    }
    [[nodiscard]] std::span<const HalfFace> half_faces_of(std::int32_t c) const {
        return {half_faces.data() + half_face_offsets[c],
                static_cast<std::size_t>(half_face_offsets[c + 1] - half_face_offsets[c])};
    }

    /// Free faces of a cell whose traces are affine.
    [[nodiscard]] std::span<const BoundaryFace> affine_faces_of(std::int32_t c) const {
        if (affine.faces.empty() || affine.cell_index[c] < 0) return {};
        const AffineCell& cell = affine.cells[static_cast<std::size_t>(affine.cell_index[c])];
        return std::span(affine.faces)
            .subspan(static_cast<std::size_t>(cell.begin), static_cast<std::size_t>(cell.end - cell.begin));
    }
    /// Indices of those whose stencils use a cell.
    [[nodiscard]] std::span<const std::int32_t> affine_rows_of(std::int32_t c) const {
        const std::int32_t position = boundary_cell_position[c];
        if (affine.faces.empty() || position < 0) return {};
        const std::int32_t begin = affine.of_cell.offsets[position];
        return {affine.of_cell.rows.data() + begin, static_cast<std::size_t>(affine.of_cell.offsets[position + 1] - begin)};
    }

    // Faces. A boundary face has its one cell on both sides, no stiffness and, but for those of `affine`, an empty
    // stencil: the sweeps need no branch.
    LargeArray<std::array<std::int32_t, 2>> face_cells;
    StencilReport report;
    // Cells and their half-faces, cell by cell.
    LargeArray<std::int32_t> half_face_offsets;  // (n_cells + 1)
    LargeArray<HalfFace> half_faces;
    Occurrences<std::int32_t> of_cell;     // interior stencils that use a cell
    std::vector<std::int32_t> body_begin;  // first cell of each body, one more at the end
    Simplices<Dim> simplices;
    DirectedCells<Dim> directed;
    // Boundary faces.
    std::vector<std::int32_t> boundary_faces;
    std::vector<BoundaryFace> boundary_index;  // of a face; none inside
    BoundaryReconstruction<Dim> boundary;
    std::vector<BoundaryFace> row_faces;               // those that the sweeps reconstruct by rows of R: not condensed
    std::vector<std::int32_t> boundary_cells;          // cells that one of them depends on, or one of `affine`
    std::vector<std::int32_t> boundary_cell_position;  // of a cell, -1 elsewhere
    Occurrences<BoundaryFace> of_boundary_cell;        // these rows by position in boundary_cells, transposed
    AffineTraces affine;

private:
    void set_faces(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_cells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials);
    void set_shares(std::span<const Kinematics> kinematics);
    void set_boundary(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                      const FaceConditions<Dim>& conditions, FreeFaceRule rule, CornerRule corner_rule,
                      std::span<const Kinematics> kinematics);
    void set_affine();
    void set_affine_occurrences();
};

}  // namespace abut::solid
