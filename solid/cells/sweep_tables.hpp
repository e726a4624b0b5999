#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>

#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/host_device.hpp"

namespace abut::solid {

/// An array of somebody else, on the host or on a device, as the functions of one element see it.
template <class T>
struct Table {
    T* data = nullptr;
    std::ptrdiff_t size = 0;

    Table() = default;
    Table(T* first, std::ptrdiff_t n) : data(first), size(n) {}
    template <class Array>
    requires requires(Array& array) { std::data(array); }
    explicit Table(Array& array) : data(array.data()), size(std::ssize(array)) {}

    [[nodiscard]] ABUT_HOST_DEVICE T& operator[](std::ptrdiff_t i) const { return data[i]; }
};

/// The numbers of an array of vectors or tensors.
template <class Number, class Array>
[[nodiscard]] Table<const Number> plain(const Array& array) {
    using Element = typename Array::value_type;
    static_assert(sizeof(Element) % sizeof(Number) == 0 && std::is_trivially_destructible_v<Element>);
    return {reinterpret_cast<const Number*>(array.data()),
            std::ssize(array) * static_cast<std::ptrdiff_t>(sizeof(Element) / sizeof(Number))};
}

/// Data that the sweeps read and write, in arrays of plain numbers. Vectors and tensors are packed: Lanes, TensorOf.
template <int Dim, class Real>
struct SweepTables {
    // As in CcgArrays and CcgCoefficients.
    Table<const std::array<std::int32_t, 2>> face_cells;
    Table<const FaceStencil<Dim, Real>> stencils;
    Table<const FaceGeometry<Dim, Real>> faces;
    Table<const CellGeometry<Dim, Real>> cells;
    Table<const std::int32_t> half_face_offsets;
    Table<const HalfFace> half_faces;
    Table<const std::array<Real, Dim>> lever_arms;
    Table<const std::array<Real, 2>> shares;  // empty: of simplices all points are centroids
    Table<const std::int32_t> of_cell_offsets, of_cell_rows;
    Table<const Real> of_cell_weights;
    Table<const SimplexCell<Dim>> simplices;   // empty: no body is of simplices
    Table<const BoundaryFace> condensed_face;  // by cell, as `simplices`
    Table<const CondensedCell> condensed;
    Table<const std::int32_t> boundary_faces;
    Table<const BoundaryFace> boundary_index, row_faces;
    Table<const std::int32_t> row_offsets, row_cells;
    Table<const Real> row_weights;
    Table<const double> deficit;  // (n_boundary, Dim, Dim), not packed
    Table<const std::int32_t> boundary_cells, boundary_cell_position;
    Table<const std::int32_t> of_boundary_cell_offsets;
    Table<const BoundaryFace> of_boundary_cell_rows;
    Table<const Real> of_boundary_cell_weights;
    Table<const AffineCell> affine_cells;  // this and all below empty without any
    Table<const std::int32_t> affine_cell_index, affine_face_index;
    Table<const BoundaryFace> affine_faces;
    Table<const Real> affine_parts;  // packed
    Table<const std::int32_t> of_affine_offsets, of_affine_rows;
    Table<const Real> of_affine_weights;

    // Work arrays, packed.
    Table<double> u;            // displacement, by cell
    Table<Real> of_face;        // u_f - u_c of the first side, later y of interior faces, by face
    Table<Real> g;              // displacement gradient, by cell
    Table<Real> trace;          // I_c(x_f) - u_c of the first side, by half-face
    Table<Real> s;              // S_c, by cell
    Table<Real> deviation;      // d_c, by cell of simplices
    Table<Real> direct;         // sum of k [u], by cell
    Table<Real> boundary_y;     // dV/dũ_f, by boundary face
    Table<Real> affine_y;       // dV/dX u of the faces of AffineTraces, by index
    Table<Real> correction;     // delta_f and answers, by boundary face; zero except during a call
    Table<Real> pair_gradient;  // by boundary face; zero except during a call

    // Loads of a call, as in BoundaryLoad; empty without any. Not packed.
    Table<const double> load_displacement, traction;

    [[nodiscard]] ABUT_HOST_DEVICE bool of_simplices(std::ptrdiff_t c) const {
        return simplices.size > 0 && simplices[c].faces[0] >= 0;
    }
    /// Among `affine_cells`; -1: it is none.
    [[nodiscard]] ABUT_HOST_DEVICE std::int32_t affine_index_of(std::ptrdiff_t c) const {
        return affine_cell_index.size > 0 ? affine_cell_index[c] : -1;
    }
    /// Among `affine_faces`; -1: it is none.
    [[nodiscard]] ABUT_HOST_DEVICE std::int32_t affine_index_of(BoundaryFace b) const {
        return affine_face_index.size > 0 ? affine_face_index[number_of(b)] : -1;
    }
    /// `no_face` where the cell is not condensed.
    [[nodiscard]] ABUT_HOST_DEVICE BoundaryFace condensed_face_of(std::ptrdiff_t c) const {
        return condensed_face.size > 0 ? condensed_face[c] : no_face;
    }
    [[nodiscard]] ABUT_HOST_DEVICE std::int32_t face_of(BoundaryFace b) const { return boundary_faces[number_of(b)]; }
    [[nodiscard]] ABUT_HOST_DEVICE std::int32_t cell_of(BoundaryFace b) const { return face_cells[face_of(b)][0]; }
};

/// visit(table) for those that do not change from call to call: the first part.
template <int Dim, class Real, class Visit>
void for_each_fixed_table(SweepTables<Dim, Real>& t, const Visit& visit) {
    const auto each = [&](auto&... tables) { (visit(tables), ...); };
    each(t.face_cells, t.stencils, t.faces, t.cells, t.half_face_offsets, t.half_faces, t.lever_arms, t.shares);
    each(t.of_cell_offsets, t.of_cell_rows, t.of_cell_weights, t.simplices, t.condensed_face, t.condensed);
    each(t.boundary_faces, t.boundary_index, t.row_faces, t.row_offsets, t.row_cells, t.row_weights, t.deficit);
    each(t.boundary_cells, t.boundary_cell_position, t.of_boundary_cell_offsets, t.of_boundary_cell_rows,
         t.of_boundary_cell_weights);
    each(t.affine_cells, t.affine_cell_index, t.affine_face_index, t.affine_faces, t.affine_parts, t.of_affine_offsets,
         t.of_affine_rows, t.of_affine_weights);
}

/// The first part of them. All must outlive what it returns.
template <int Dim, class Real>
[[nodiscard]] SweepTables<Dim, Real> tables_of(const CcgArrays<Dim>& arrays,
                                               const CcgCoefficients<Dim, Real>& coefficients) {
    SweepTables<Dim, Real> tables;
    const auto set = [](auto& table, const auto& array) { table = std::remove_reference_t<decltype(table)>(array); };
    set(tables.face_cells, arrays.face_cells);
    set(tables.stencils, coefficients.stencils);
    set(tables.faces, coefficients.faces);
    set(tables.cells, coefficients.cells);
    set(tables.half_face_offsets, arrays.half_face_offsets);
    set(tables.half_faces, arrays.half_faces);
    set(tables.lever_arms, coefficients.lever_arms);
    set(tables.shares, coefficients.shares);
    set(tables.of_cell_offsets, arrays.of_cell.offsets);
    set(tables.of_cell_rows, arrays.of_cell.rows);
    set(tables.of_cell_weights, coefficients.of_cell_weights);
    set(tables.simplices, arrays.simplices.cells());
    set(tables.condensed_face, arrays.simplices.condensed_faces());
    set(tables.condensed, arrays.simplices.condensed());
    set(tables.boundary_faces, arrays.boundary_faces);
    set(tables.boundary_index, arrays.boundary_index);
    set(tables.row_faces, arrays.row_faces);
    set(tables.row_offsets, arrays.boundary.offsets);
    set(tables.row_cells, arrays.boundary.cells);
    tables.row_weights = plain<Real>(coefficients.boundary_weights);
    tables.deficit = plain<double>(arrays.boundary.deficit);
    set(tables.boundary_cells, arrays.boundary_cells);
    set(tables.boundary_cell_position, arrays.boundary_cell_position);
    set(tables.of_boundary_cell_offsets, arrays.of_boundary_cell.offsets);
    set(tables.of_boundary_cell_rows, arrays.of_boundary_cell.rows);
    tables.of_boundary_cell_weights = plain<Real>(coefficients.boundary_cell_weights);
    set(tables.affine_cells, arrays.affine.cells);
    set(tables.affine_cell_index, arrays.affine.cell_index);
    set(tables.affine_face_index, arrays.affine.face_index);
    set(tables.affine_faces, arrays.affine.faces);
    tables.affine_parts = plain<Real>(coefficients.affine_parts);
    set(tables.of_affine_offsets, arrays.affine.of_cell.offsets);
    set(tables.of_affine_rows, arrays.affine.of_cell.rows);
    set(tables.of_affine_weights, coefficients.affine_weights);
    return tables;
}

}  // namespace abut::solid
