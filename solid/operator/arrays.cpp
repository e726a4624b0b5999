#include "abut/solid/operator/arrays.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "abut/base/sort_unique.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {
namespace {

/// visit(i, row, weight) is called for every entry by for_each_entry(visit), rows increasing; i in [0, n).
template <class Row, class Weight, class ForEachEntry>
Occurrences<Row> occurrences(std::size_t n, LargeArray<Weight>& weights, const ForEachEntry& for_each_entry) {
    Occurrences<Row> found;
    found.offsets.assign(n + 1, 0);
    for_each_entry([&](std::int32_t i, Row, const Weight&) { ++found.offsets[i + 1]; });
    std::partial_sum(found.offsets.begin(), found.offsets.end(), found.offsets.begin());
    found.rows.resize(static_cast<std::size_t>(found.offsets.back()));
    weights.resize(found.rows.size());
    std::vector<std::int32_t> next(found.offsets.begin(), found.offsets.end() - 1);
    for_each_entry([&](std::int32_t i, Row row, const Weight& weight) {
        found.rows[next[i]] = row;
        weights[next[i]++] = weight;
    });
    return found;
}

template <int Dim>
std::array<double, Dim> to_array(const Vector<Dim>& v) {
    std::array<double, Dim> a;
    for (int j = 0; j < Dim; ++j) a[j] = v[j];
    return a;
}

}  // namespace

template <int Dim>
CcgArrays<Dim>::CcgArrays(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                          const FaceConditions<Dim>& conditions, FreeFaceRule rule, CornerRule corner_rule,
                          std::span<const Kinematics> kinematics, CellForm form) {
    set_faces(mesh, materials);
    set_cells(mesh, materials);
    if (form == CellForm::automatic) simplices = Simplices<Dim>(mesh, materials, conditions, rule, kinematics);
    set_shares(kinematics);
    directed = DirectedCells<Dim>(mesh, materials);
    set_boundary(mesh, materials, conditions, rule, corner_rule, kinematics);
}

template <int Dim>
void CcgArrays<Dim>::set_faces(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    const auto n = static_cast<std::size_t>(mesh.n_faces());
    face_cells.assign(mesh.face_cells.begin(), mesh.face_cells.end());
    stencils.resize(n);
    boundary_index.assign(n, no_face);
    std::vector<std::int32_t> interior;
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
        FaceGeometry<Dim>& face = faces.emplace_back();
        face.area_vector = to_array<Dim>(mesh.face_measure[f] * mesh.face_normal[f]);
        if (mesh.is_boundary(f)) {
            boundary_index[f] = static_cast<BoundaryFace>(boundary_faces.size());
            boundary_faces.push_back(f);
            face_cells[f][1] = face_cells[f][0];
            stencils[f].cells.fill(face_cells[f][0]);
            stencils[f].weights.fill(0.0);
            face.jump_stiffness = 0.0;
            continue;
        }
        interior.push_back(f);
        // |f| eta / h_f with h_f = |f|^(1/(d-1))
        const double eta = materials[mesh.cell_body[face_cells[f][0]]].stabilisation();
        face.jump_stiffness = Dim == 2 ? eta : eta * std::sqrt(mesh.face_measure[f]);
    }
    const auto selected = select_stencils<Dim>(mesh, interior, report);
    for (std::size_t i = 0; i < interior.size(); ++i) stencils[interior[i]] = selected[i];
}

template <int Dim>
void CcgArrays<Dim>::set_cells(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials) {
    half_face_offsets.assign(mesh.cell_faces.offsets.begin(), mesh.cell_faces.offsets.end());
    std::vector<std::int32_t> first_half_face(face_cells.size(), -1);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        if (c == 0 || mesh.cell_body[c] != mesh.cell_body[c - 1]) body_begin.push_back(c);
        const Material& material = materials[mesh.cell_body[c]];
        cells.push_back({1.0 / mesh.cell_measure[c], material.lambda(), material.mu()});
        for (const std::int32_t f : mesh.cell_faces[c]) {
            const auto half_face = static_cast<std::int32_t>(half_faces.size());
            std::int32_t twin = half_face;
            if (first_half_face[f] < 0) {
                first_half_face[f] = half_face;
            } else {
                twin = first_half_face[f];
                half_faces[twin].twin = half_face;
            }
            half_faces.push_back({f, face_cells[f][0], twin});
            lever_arms.push_back(to_array<Dim>(mesh.face_centroid[f] - mesh.cell_centroid[c]));
        }
    }
    body_begin.push_back(n_cells());
    of_cell = occurrences<std::int32_t>(cells.size(), of_cell_weights, [&](const auto& visit) {
        for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
            if (boundary_index[f] == no_face)
                for (int j = 0; j <= Dim; ++j) visit(stencils[f].cells[j], f, stencils[f].weights[j]);
    });
}

/// The affine function with the mean of u_f at its faces is at x_c, off the centroid by o, the sum of (1/(d + 1) - o .
/// n |f|/|c|) u_f. Sums by shares round otherwise than those of centroids, so that whether there are any does not
/// depend on which cells a rank has.
template <int Dim>
void CcgArrays<Dim>::set_shares(std::span<const Kinematics> kinematics) {
    constexpr double rounding = 1e-12;  // of the arms
    constexpr double at_centroid = 1.0 / (Dim + 1);
    LargeArray<std::array<double, 2>> found(faces.size(), {at_centroid, at_centroid});
    bool any = std::ranges::any_of(kinematics, [](Kinematics of_body) { return properties_of(of_body).has_frame; });
    for (std::int32_t c = 0; c < n_cells(); ++c) {
        if (!simplices.contains(c)) continue;
        Vector<Dim> to_centroid = Vector<Dim>::Zero();
        double largest = 0.0;
        for (std::int32_t i = half_face_offsets[c]; i < half_face_offsets[c + 1]; ++i) {
            const Vector<Dim> arm(lever_arms[i].data());
            to_centroid += at_centroid * arm;
            largest = std::max(largest, arm.norm());
        }
        if (to_centroid.norm() <= rounding * largest) continue;
        any = true;
        for (const HalfFace& half_face : half_faces_of(c)) {
            const Vector<Dim> area(faces[half_face.face].area_vector.data());
            const double along = cells[c].inverse_measure * to_centroid.dot(area);
            if (half_face.first == c)
                found[half_face.face][0] -= along;
            else
                found[half_face.face][1] += along;
        }
    }
    if (any && !simplices.cells().empty()) shares = std::move(found);
}

template <int Dim>
void CcgArrays<Dim>::set_boundary(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                                  const FaceConditions<Dim>& conditions, FreeFaceRule rule, CornerRule corner_rule,
                                  std::span<const Kinematics> kinematics) {
    boundary = reconstruct_boundary<Dim>(mesh, stencils, materials, conditions, rule, corner_rule, kinematics);
    set_affine();
    for (const Matrix<Dim>& weight : boundary.weights) boundary_weights.push_back(load_packed<Dim>(weight));
    for (const BoundaryFace b : all_ids<BoundaryFace>(n_boundary())) {
        if (simplices.condensed_face(cell_of(b)) == b) continue;
        row_faces.push_back(b);
        boundary_cells.insert(boundary_cells.end(), boundary.cells.begin() + boundary.offsets[number_of(b)],
                              boundary.cells.begin() + boundary.offsets[number_of(b) + 1]);
    }
    for (const AffineFace<Dim>& face : boundary.affine)
        boundary_cells.insert(boundary_cells.end(), face.stencil.cells.begin(), face.stencil.cells.end());
    sort_unique(boundary_cells);
    boundary_cell_position.assign(cells.size(), -1);
    for (std::size_t i = 0; i < boundary_cells.size(); ++i)
        boundary_cell_position[boundary_cells[i]] = static_cast<std::int32_t>(i);
    of_boundary_cell = occurrences<BoundaryFace>(boundary_cells.size(), boundary_cell_weights, [&](const auto& visit) {
        for (const BoundaryFace b : row_faces)
            for (std::int32_t i = boundary.offsets[number_of(b)]; i < boundary.offsets[number_of(b) + 1]; ++i)
                visit(boundary_cell_position[boundary.cells[i]], b,
                      load_packed<Dim>(Matrix<Dim>(boundary.weights[i].transpose())));
    });
    if (!affine.faces.empty()) set_affine_occurrences();
}

/// Their stencils stand where boundary faces have none.
template <int Dim>
void CcgArrays<Dim>::set_affine() {
    if (boundary.affine.empty()) return;
    affine.cell_index.assign(cells.size(), -1);
    affine.face_index.assign(boundary_faces.size(), -1);
    for (const AffineFace<Dim>& face : boundary.affine) {
        const auto index = static_cast<std::int32_t>(affine.faces.size());
        const std::int32_t cell = cell_of(face.face);
        if (affine.cells.empty() || affine.cells.back().cell != cell) {
            affine.cell_index[cell] = static_cast<std::int32_t>(affine.cells.size());
            affine.cells.push_back({cell, index, index});
        }
        affine.cells.back().end = index + 1;
        affine.face_index[number_of(face.face)] = index;
        affine.faces.push_back(face.face);
        affine_parts.push_back(load_packed<Dim>(face.free_part));
        stencils[face_of(face.face)] = face.stencil;
    }
}

template <int Dim>
void CcgArrays<Dim>::set_affine_occurrences() {
    affine.of_cell = occurrences<std::int32_t>(boundary_cells.size(), affine_weights, [&](const auto& visit) {
        for (std::size_t i = 0; i < affine.faces.size(); ++i) {
            const FaceStencil<Dim>& stencil = stencils[face_of(affine.faces[i])];
            for (std::size_t j = 0; j <= Dim; ++j)
                visit(boundary_cell_position[stencil.cells[j]], static_cast<std::int32_t>(i), stencil.weights[j]);
        }
    });
}

template struct CcgArrays<2>;
template struct CcgArrays<3>;

}  // namespace abut::solid
