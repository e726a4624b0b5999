#include "abut/solid/boundary/boundary_conditions.hpp"

#include <algorithm>

#include "abut/base/error.hpp"

namespace abut::solid {
namespace {

template <int Dim>
Matrix<Dim> projector(const DirichletCondition<Dim>& condition, const Vector<Dim>& normal) {
    if (condition.constraint == Constraint::full) return Matrix<Dim>::Identity();
    if (condition.constraint == Constraint::normal) return normal * normal.transpose();
    Matrix<Dim> chosen = Matrix<Dim>::Zero();
    for (int i = 0; i < Dim; ++i) chosen(i, i) = condition.components[i] ? 1.0 : 0.0;
    if (chosen.isZero(0.0))
        throw BadInput("boundary condition on '" + condition.group +
                       "' prescribes no component. Name at least one, or leave the condition out.");
    return chosen;
}

/// Boundary faces of a group.
template <int Dim>
std::vector<BoundaryFace> boundary_faces_of(const mesh::Mesh<Dim>& mesh, const std::string& group) {
    std::vector<BoundaryFace> boundary;
    for (const std::int32_t face : mesh.group(group).faces) {
        const auto at = std::lower_bound(mesh.boundary_faces.begin(), mesh.boundary_faces.end(), face);
        boundary.push_back(static_cast<BoundaryFace>(at - mesh.boundary_faces.begin()));
    }
    return boundary;
}

template <int Dim>
std::string face_name(const mesh::Mesh<Dim>& mesh, BoundaryFace face) {
    return "face " + std::to_string(mesh_face(mesh, face)) + " of cell " +
           std::to_string(mesh.cell_label[static_cast<std::size_t>(cell_of(mesh, face))]);
}

}  // namespace

template <int Dim>
FaceConditions<Dim> sort_to_faces(const mesh::Mesh<Dim>& mesh, const BoundaryConditions<Dim>& conditions) {
    FaceConditions<Dim> sorted;
    sorted.prescribed.assign(mesh.boundary_faces.size(), Matrix<Dim>::Zero());
    const auto marked = [&](std::span<const std::int32_t> faces) {
        IdVector<BoundaryFace, char> of_faces(mesh.boundary_faces.size(), 0);
        for (const std::int32_t face : faces)
            of_faces[static_cast<BoundaryFace>(std::ranges::lower_bound(mesh.boundary_faces, face) -
                                               mesh.boundary_faces.begin())] = 1;
        return of_faces;
    };
    sorted.joined = marked(conditions.joined_faces);
    sorted.glued = marked(conditions.glued_faces);
    if (!conditions.thick_cells.empty()) sorted.is_thick.assign(static_cast<std::size_t>(mesh.n_cells()), 0);
    for (const std::int32_t cell : conditions.thick_cells) sorted.is_thick[static_cast<std::size_t>(cell)] = 1;
    for (const DirichletCondition<Dim>& condition : conditions.dirichlet) {
        auto& faces = sorted.dirichlet.emplace_back();
        for (const BoundaryFace b : boundary_faces_of(mesh, condition.group)) {
            const Matrix<Dim> added = projector(condition, mesh.face_normal[mesh_face(mesh, b)]);
            if (!(added * sorted.prescribed[b]).isZero(1e-12))
                throw BadInput(
                    "boundary condition on '" + condition.group + "': " + face_name(mesh, b) +
                        " already has a prescribed displacement in that direction. Prescribe each direction once.",
                    {.face_1 = mesh_face(mesh, b), .cell = cell_of(mesh, b)});
            sorted.prescribed[b] += added;
            faces.push_back({b, added});
        }
    }
    for (const TractionCondition<Dim>& condition : conditions.traction) {
        sorted.traction.push_back(boundary_faces_of(mesh, condition.group));
        for (const BoundaryFace b : sorted.traction.back())
            if (sorted.prescribed[b].isIdentity(1e-12))
                throw BadInput("traction on '" + condition.group + "': the displacement of " + face_name(mesh, b) +
                                   " is fully prescribed. Give one or the other.",
                               {.face_1 = mesh_face(mesh, b), .cell = cell_of(mesh, b)});
    }
    return sorted;
}

template FaceConditions<2> sort_to_faces<2>(const mesh::Mesh<2>&, const BoundaryConditions<2>&);
template FaceConditions<3> sort_to_faces<3>(const mesh::Mesh<3>&, const BoundaryConditions<3>&);

}  // namespace abut::solid
