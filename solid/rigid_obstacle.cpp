#include "abut/solid/rigid_obstacle.hpp"

#include <algorithm>
#include <utility>

#include "abut/geometry/polygon.hpp"

namespace abut::solid {

template <int Dim>
contact::RigidObstacle<Dim> rigid_obstacle(const mesh::Mesh<Dim>& mesh, std::function<Vector<Dim>(double time)> path) {
    contact::RigidObstacle<Dim> obstacle{{}, std::move(path)};
    for (const std::int32_t f : mesh.boundary_faces) {
        std::vector<Vector<Dim>>& corners = obstacle.faces.emplace_back();
        for (const std::int32_t v : mesh.face_vertices[f]) corners.push_back(mesh.vertices[v]);
        if (geometry::face_normal<Dim>(corners).dot(mesh.face_normal[f]) < 0.0) std::reverse(corners.begin(), corners.end());
    }
    return obstacle;
}

template contact::RigidObstacle<2> rigid_obstacle<2>(const mesh::Mesh<2>&, std::function<Vector<2>(double)>);
template contact::RigidObstacle<3> rigid_obstacle<3>(const mesh::Mesh<3>&, std::function<Vector<3>(double)>);

}  // namespace abut::solid
