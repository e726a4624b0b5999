#include "abut/mesh/outline.hpp"

namespace abut::mesh {

template <int Dim>
Mesh<Dim> outline_of(const Mesh<Dim>& mesh) {
    Mesh<Dim> outline;
    outline.name = mesh.name;
    outline.body_names = mesh.body_names;
    for (const BoundaryGroup& group : mesh.groups) outline.groups.push_back({group.name, {}});
    outline.report = mesh.report;
    return outline;
}

template Mesh<2> outline_of(const Mesh<2>&);
template Mesh<3> outline_of(const Mesh<3>&);

}  // namespace abut::mesh
