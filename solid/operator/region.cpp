#include "abut/solid/operator/region.hpp"

#include <algorithm>

#include "abut/base/sort_unique.hpp"

namespace abut::solid {
namespace {

template <int Dim>
Vector<Dim> vector(const std::array<double, Dim>& a) {
    return Vector<Dim>(a.data());
}

template <int Dim>
std::vector<std::int32_t> faces_of(const CcgArrays<Dim>& arrays, const std::vector<std::int32_t>& cells) {
    std::vector<std::int32_t> faces;
    for (const std::int32_t c : cells)
        for (const HalfFace& half_face : arrays.half_faces_of(c)) faces.push_back(half_face.face);
    sort_unique(faces);
    return faces;
}

template <int Dim>
void append_face_cells(const CcgArrays<Dim>& arrays, std::int32_t f, std::vector<std::int32_t>& cells) {
    cells.insert(cells.end(), arrays.face_cells[f].begin(), arrays.face_cells[f].end());
}

/// From the cells whose displacement gradient is wanted back to everything it depends on.
template <int Dim>
void complete_gradients(const CcgArrays<Dim>& arrays, Region<Dim>& region) {
    sort_unique(region.displacement_gradient_cells);
    region.input_cells = region.displacement_gradient_cells;
    for (const std::int32_t f : faces_of(arrays, region.displacement_gradient_cells)) {
        append_face_cells(arrays, f, region.input_cells);
        if (const BoundaryFace b = arrays.boundary_index[f]; b != no_face) {
            if (arrays.simplices.condensed_face(arrays.cell_of(b)) == b) continue;
            const BoundaryReconstruction<Dim>& boundary = arrays.boundary;
            region.reconstructed_boundary.push_back(b);
            region.input_cells.insert(region.input_cells.end(), boundary.cells.begin() + boundary.offsets[number_of(b)],
                                      boundary.cells.begin() + boundary.offsets[number_of(b) + 1]);
        } else {
            region.reconstructed.push_back(f);
            region.input_cells.insert(region.input_cells.end(), arrays.stencils[f].cells.begin(),
                                      arrays.stencils[f].cells.end());
        }
    }
    sort_unique(region.input_cells);
}

/// Appends the cells that affine traces depend on beside the gradients of their own cell.
template <int Dim>
void append_affine_cells(const CcgArrays<Dim>& arrays, Region<Dim>& region) {
    if (arrays.affine.faces.empty()) return;
    for (const std::int32_t c : region.displacement_gradient_cells)
        for (const BoundaryFace b : arrays.affine_faces_of(c)) {
            const auto& cells = arrays.stencils[arrays.face_of(b)].cells;
            region.input_cells.insert(region.input_cells.end(), cells.begin(), cells.end());
        }
    sort_unique(region.input_cells);
}

/// From the cells whose stress is wanted.
template <int Dim>
void complete(const CcgArrays<Dim>& arrays, Region<Dim>& region) {
    sort_unique(region.stress_cells);
    region.displacement_gradient_cells = region.stress_cells;
    for (const std::int32_t f : faces_of(arrays, region.stress_cells))
        append_face_cells(arrays, f, region.displacement_gradient_cells);
    complete_gradients(arrays, region);
    append_affine_cells(arrays, region);
}

/// All boundary faces that share an energy term with b, itself included, increasing.
template <int Dim>
std::vector<BoundaryFace> coupled_faces(const CcgArrays<Dim>& arrays, BoundaryFace b) {
    std::vector<BoundaryFace> coupled;
    for (const HalfFace& half_face : arrays.half_faces_of(arrays.cell_of(b)))
        for (const std::int32_t c : arrays.face_cells[half_face.face])
            for (const HalfFace& other : arrays.half_faces_of(c))
                if (const BoundaryFace g = arrays.boundary_index[other.face]; g != no_face) coupled.push_back(g);
    sort_unique(coupled);
    return coupled;
}

template <int Dim>
Vector<Dim> boundary_area_vector(const CcgArrays<Dim>& arrays, BoundaryFace b) {
    return vector<Dim>(arrays.faces[arrays.face_of(b)].area_vector);
}

/// dI_c(x_f)/dw_b for boundary face b of cell c: this number times the identity; f is the face of the cell's half-face i.
template <int Dim>
double trace_answer(const CcgArrays<Dim>& arrays, std::int32_t half_face, BoundaryFace b) {
    return arrays.cells[arrays.cell_of(b)].inverse_measure *
           boundary_area_vector(arrays, b).dot(vector<Dim>(arrays.lever_arms[half_face]));
}

/// The elastic energy couples faces of one cell; the jump over an interior face those of its two cells.
template <int Dim>
Matrix<Dim> coupling_block(const CcgArrays<Dim>& arrays, BoundaryFace b, BoundaryFace other) {
    const std::int32_t cell = arrays.cell_of(b);
    const bool same_cell = cell == arrays.cell_of(other);
    Matrix<Dim> block = Matrix<Dim>::Zero();
    if (same_cell) {
        const auto& [inverse_measure, lambda, mu] = arrays.cells[cell];
        block = face_stiffness<Dim>(lambda, mu, 1.0 / inverse_measure, boundary_area_vector(arrays, b),
                                    boundary_area_vector(arrays, other));
        if (arrays.directed.contains(cell))
            block += inverse_measure *
                     arrays.directed[cell].between(boundary_area_vector(arrays, b), boundary_area_vector(arrays, other));
    }
    for (std::int32_t i = arrays.half_face_offsets[cell]; i < arrays.half_face_offsets[cell + 1]; ++i) {
        const HalfFace& half_face = arrays.half_faces[i];
        const double stiffness = arrays.faces[half_face.face].jump_stiffness * trace_answer(arrays, i, b);
        const auto [first, second] = arrays.face_cells[half_face.face];
        if (same_cell)
            block += stiffness * trace_answer(arrays, i, other) * Matrix<Dim>::Identity();
        else if (arrays.cell_of(other) == (first == cell ? second : first))
            block -= stiffness * trace_answer(arrays, half_face.twin, other) * Matrix<Dim>::Identity();
    }
    return block;
}

/// Block between corrections: with all faces that answer to them.
template <int Dim>
Matrix<Dim> answered_block(const CcgArrays<Dim>& arrays, BoundaryFace b, BoundaryFace other) {
    const auto row = [&](BoundaryFace face) {
        Matrix<Dim> sum = coupling_block(arrays, face, other);
        arrays.boundary.for_each_answer(other, [&](BoundaryFace answering, const Matrix<Dim>& answer) {
            sum += coupling_block(arrays, face, answering) * answer;
        });
        return sum;
    };
    Matrix<Dim> block = row(b);
    arrays.boundary.for_each_answer(
        b, [&](BoundaryFace face, const Matrix<Dim>& answer) { block += answer.transpose() * row(face); });
    return block;
}

}  // namespace

template <int Dim>
Region<Dim> region_of_faces(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces) {
    Region<Dim> region;
    region.faces.assign(faces.begin(), faces.end());
    for (const BoundaryFace b : faces) region.stress_cells.push_back(arrays.cell_of(b));
    complete(arrays, region);
    return region;
}

template <int Dim>
Region<Dim> region_of_tilted_faces(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces) {
    Region<Dim> region;
    region.faces.assign(faces.begin(), faces.end());
    for (const BoundaryFace b : faces) region.displacement_gradient_cells.push_back(arrays.cell_of(b));
    complete_gradients(arrays, region);
    return region;
}

template <int Dim>
Region<Dim> region_of_cells(const CcgArrays<Dim>& arrays, std::span<const std::int32_t> cells) {
    const auto append_rows = [](auto& rows, const auto& occurrences, std::int32_t i) {
        rows.insert(rows.end(), occurrences.rows.begin() + occurrences.offsets[i],
                    occurrences.rows.begin() + occurrences.offsets[i + 1]);
    };
    Region<Dim> region;
    region.cells.assign(cells.begin(), cells.end());
    for (const std::int32_t c : cells) {
        region.stress_cells.push_back(c);
        append_rows(region.energy_gradient_faces, arrays.of_cell, c);
        if (const std::int32_t position = arrays.boundary_cell_position[c]; position >= 0)
            append_rows(region.faces, arrays.of_boundary_cell, position);
        for (const std::int32_t i : arrays.affine_rows_of(c))
            region.stress_cells.push_back(arrays.cell_of(arrays.affine.faces[static_cast<std::size_t>(i)]));
    }
    sort_unique(region.energy_gradient_faces);
    sort_unique(region.faces);
    for (const std::int32_t f : region.energy_gradient_faces)
        region.stress_cells.insert(region.stress_cells.end(), arrays.face_cells[f].begin(), arrays.face_cells[f].end());
    for (const BoundaryFace b : region.faces) region.stress_cells.push_back(arrays.cell_of(b));
    complete(arrays, region);
    return region;
}

template <int Dim>
contact::FaceCoupling<Dim> face_coupling(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces) {
    contact::FaceCoupling<Dim> coupling;
    for (const BoundaryFace b : faces) {
        for (const BoundaryFace other : coupled_faces(arrays, b)) {
            const auto at = std::lower_bound(faces.begin(), faces.end(), other);
            if (at == faces.end() || *at != other) continue;
            coupling.columns.push_back(static_cast<std::int32_t>(at - faces.begin()));
            coupling.blocks.push_back(answered_block(arrays, b, other));
        }
        coupling.offsets.push_back(static_cast<std::int32_t>(coupling.columns.size()));
    }
    return coupling;
}

template Region<2> region_of_faces(const CcgArrays<2>&, std::span<const BoundaryFace>);
template Region<3> region_of_faces(const CcgArrays<3>&, std::span<const BoundaryFace>);
template Region<2> region_of_tilted_faces(const CcgArrays<2>&, std::span<const BoundaryFace>);
template Region<3> region_of_tilted_faces(const CcgArrays<3>&, std::span<const BoundaryFace>);
template Region<2> region_of_cells(const CcgArrays<2>&, std::span<const std::int32_t>);
template Region<3> region_of_cells(const CcgArrays<3>&, std::span<const std::int32_t>);
template contact::FaceCoupling<2> face_coupling(const CcgArrays<2>&, std::span<const BoundaryFace>);
template contact::FaceCoupling<3> face_coupling(const CcgArrays<3>&, std::span<const BoundaryFace>);

}  // namespace abut::solid
