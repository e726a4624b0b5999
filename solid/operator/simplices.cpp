#include "abut/solid/operator/simplices.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::solid {

template <int Dim>
Simplices<Dim>::Simplices(const mesh::Mesh<Dim>& mesh, std::span<const Material> materials,
                          const FaceConditions<Dim>& conditions, FreeFaceRule rule, std::span<const Kinematics> kinematics) {
    std::vector<bool> suits;
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body)
        suits.push_back(materials[static_cast<std::size_t>(body)].is_isotropic() &&
                        !properties_of(kinematics, static_cast<std::size_t>(body)).finite_strains);
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (mesh.cell_faces[c].size() != Dim + 1) suits[static_cast<std::size_t>(mesh.cell_body[c])] = false;
    all_ = true;
    bool any = false;
    for (const bool of_body : suits) all_ = all_ && of_body, any = any || of_body;
    if (!any) return;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        cells_.emplace_back().faces.fill(-1);
        if (suits[static_cast<std::size_t>(mesh.cell_body[c])]) set_cell(mesh, c);
    }
    condensed_face_.assign(cells_.size(), no_face);
    if (rule == FreeFaceRule::local_equilibrium) condense(mesh, conditions);
}

template <int Dim>
void Simplices<Dim>::set_cell(const mesh::Mesh<Dim>& mesh, std::int32_t cell) {
    for (std::size_t i = 0; i <= Dim; ++i) {
        const std::int32_t face = mesh.cell_faces[cell][i];
        const auto [first, second] = mesh.face_cells[face];
        cells_[cell].faces[i] = face;
        cells_[cell].neighbours[i] = mesh.is_boundary(face) ? cell : first == cell ? second : first;
    }
}

template <int Dim>
void Simplices<Dim>::condense(const mesh::Mesh<Dim>& mesh, const FaceConditions<Dim>& conditions) {
    std::vector<int> n_boundary(cells_.size(), 0);
    for (const BoundaryFace b : boundary_faces(mesh)) ++n_boundary[cell_of(mesh, b)];
    for (const BoundaryFace b : boundary_faces(mesh)) {  // increasing with their cells
        const std::int32_t cell = cell_of(mesh, b);
        if (!contains(cell) || n_boundary[cell] > 1 || !conditions.prescribed[b].isZero(0.0) || conditions.joined[b])
            continue;
        condensed_.push_back({cell, b});
        condensed_face_[cell] = b;
    }
}

template class Simplices<2>;
template class Simplices<3>;

}  // namespace abut::solid
