#include "abut/solid/ccg/region.hpp"

#include <algorithm>

namespace abut::solid {
namespace {

template <int Dim>
Vector<Dim> vector(const std::array<double, Dim>& a) {
    return Eigen::Map<const Vector<Dim>>(a.data());
}

/// From the cells whose stress is wanted back to everything it depends on.
template <int Dim>
void complete(const CcgArrays<Dim>& arrays, Region<Dim>& region) {
    const auto faces_of = [&](const std::vector<std::int32_t>& cells) {
        std::vector<std::int32_t> faces;
        for (const std::int32_t c : cells)
            for (const Slot& slot : arrays.slots_of(c)) faces.push_back(slot.face);
        sort_unique(faces);
        return faces;
    };
    const auto append_sides = [&](std::vector<std::int32_t>& cells, std::int32_t f) {
        cells.insert(cells.end(), arrays.sides[f].begin(), arrays.sides[f].end());
    };
    sort_unique(region.stress_cells);
    region.gradient_cells = region.stress_cells;
    for (const std::int32_t f : faces_of(region.stress_cells)) append_sides(region.gradient_cells, f);
    sort_unique(region.gradient_cells);
    region.loaded_cells = region.gradient_cells;
    for (const std::int32_t f : faces_of(region.gradient_cells)) {
        append_sides(region.loaded_cells, f);
        if (const std::int32_t b = arrays.boundary_place[f]; b >= 0) {
            const BoundaryReconstruction<Dim>& boundary = arrays.boundary;
            region.reconstructed_boundary.push_back(b);
            region.loaded_cells.insert(region.loaded_cells.end(), boundary.cells.begin() + boundary.offsets[b],
                                       boundary.cells.begin() + boundary.offsets[b + 1]);
        } else {
            region.reconstructed.push_back(f);
            region.loaded_cells.insert(region.loaded_cells.end(), arrays.stencils[f].cells.begin(),
                                       arrays.stencils[f].cells.end());
        }
    }
    sort_unique(region.loaded_cells);
}

/// Places in the boundary of all boundary faces that share an energy term with b, itself included, increasing.
template <int Dim>
std::vector<std::int32_t> coupled_faces(const CcgArrays<Dim>& arrays, std::int32_t b) {
    std::vector<std::int32_t> coupled;
    for (const Slot& slot : arrays.slots_of(arrays.cell_of(b)))
        for (const std::int32_t c : arrays.sides[slot.face])
            for (const Slot& other : arrays.slots_of(c))
                if (const std::int32_t place = arrays.boundary_place[other.face]; place >= 0) coupled.push_back(place);
    sort_unique(coupled);
    return coupled;
}

template <int Dim>
Vector<Dim> boundary_area_vector(const CcgArrays<Dim>& arrays, std::int32_t b) {
    return vector<Dim>(arrays.faces[arrays.boundary_faces[b]].area_vector);
}

/// dI_c(x_f)/dw_b for boundary face b of cell c: this number times the identity; f is the face of the cell's slot i.
template <int Dim>
double trace_answer(const CcgArrays<Dim>& arrays, std::int32_t slot, std::int32_t b) {
    return arrays.cells[arrays.cell_of(b)].inverse_measure *
           boundary_area_vector(arrays, b).dot(vector<Dim>(arrays.arms[slot]));
}

/// The elastic energy couples faces of one cell; the jump over an interior face those of its two cells.
template <int Dim>
Matrix<Dim> coupling_block(const CcgArrays<Dim>& arrays, std::int32_t b, std::int32_t other) {
    const std::int32_t cell = arrays.cell_of(b);
    const bool same_cell = cell == arrays.cell_of(other);
    Matrix<Dim> block = Matrix<Dim>::Zero();
    if (same_cell) {
        const auto& [inverse_measure, lambda, mu] = arrays.cells[cell];
        block = face_stiffness<Dim>(lambda, mu, 1.0 / inverse_measure, boundary_area_vector(arrays, b),
                                    boundary_area_vector(arrays, other));
    }
    for (std::int32_t i = arrays.slot_offsets[cell]; i < arrays.slot_offsets[cell + 1]; ++i) {
        const Slot& slot = arrays.slots[i];
        const double stiffness = arrays.faces[slot.face].jump_stiffness * trace_answer(arrays, i, b);
        const auto [first, second] = arrays.sides[slot.face];
        if (same_cell)
            block += stiffness * trace_answer(arrays, i, other) * Matrix<Dim>::Identity();
        else if (arrays.cell_of(other) == (first == cell ? second : first))
            block -= stiffness * trace_answer(arrays, slot.opposite, other) * Matrix<Dim>::Identity();
    }
    return block;
}

}  // namespace

template <int Dim>
Region<Dim> region_of_faces(const CcgArrays<Dim>& arrays, std::span<const std::int32_t> faces) {
    Region<Dim> region;
    region.faces.assign(faces.begin(), faces.end());
    for (const std::int32_t b : faces) region.stress_cells.push_back(arrays.cell_of(b));
    complete(arrays, region);
    return region;
}

template <int Dim>
Region<Dim> region_of_cells(const CcgArrays<Dim>& arrays, std::span<const std::int32_t> cells) {
    const auto append_rows = [](std::vector<std::int32_t>& rows, const auto& occurrences, std::int32_t i) {
        rows.insert(rows.end(), occurrences.rows.begin() + occurrences.offsets[i],
                    occurrences.rows.begin() + occurrences.offsets[i + 1]);
    };
    Region<Dim> region;
    region.cells.assign(cells.begin(), cells.end());
    for (const std::int32_t c : cells) {
        region.stress_cells.push_back(c);
        append_rows(region.force_faces, arrays.of_cell, c);
        if (const std::int32_t place = arrays.boundary_cell_place[c]; place >= 0)
            append_rows(region.faces, arrays.of_boundary_cell, place);
    }
    sort_unique(region.force_faces);
    sort_unique(region.faces);
    for (const std::int32_t f : region.force_faces)
        region.stress_cells.insert(region.stress_cells.end(), arrays.sides[f].begin(), arrays.sides[f].end());
    for (const std::int32_t b : region.faces) region.stress_cells.push_back(arrays.cell_of(b));
    complete(arrays, region);
    return region;
}

template <int Dim>
contact::FaceCoupling<Dim> face_coupling(const CcgArrays<Dim>& arrays, std::span<const std::int32_t> faces) {
    contact::FaceCoupling<Dim> coupling;
    for (const std::int32_t b : faces) {
        for (const std::int32_t other : coupled_faces(arrays, b)) {
            const auto at = std::lower_bound(faces.begin(), faces.end(), other);
            if (at == faces.end() || *at != other) continue;
            coupling.columns.push_back(static_cast<std::int32_t>(at - faces.begin()));
            coupling.blocks.push_back(coupling_block(arrays, b, other));
        }
        coupling.offsets.push_back(static_cast<std::int32_t>(coupling.columns.size()));
    }
    return coupling;
}

template Region<2> region_of_faces(const CcgArrays<2>&, std::span<const std::int32_t>);
template Region<3> region_of_faces(const CcgArrays<3>&, std::span<const std::int32_t>);
template Region<2> region_of_cells(const CcgArrays<2>&, std::span<const std::int32_t>);
template Region<3> region_of_cells(const CcgArrays<3>&, std::span<const std::int32_t>);
template contact::FaceCoupling<2> face_coupling(const CcgArrays<2>&, std::span<const std::int32_t>);
template contact::FaceCoupling<3> face_coupling(const CcgArrays<3>&, std::span<const std::int32_t>);

}  // namespace abut::solid
