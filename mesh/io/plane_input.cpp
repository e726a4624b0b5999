#include "abut/mesh/io/plane_input.hpp"

#include "abut/base/messages.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {

void check_lies_in_plane(const std::string& mesh_name, const geometry::Box<3>& box, double tolerance) {
    const double allowed = tolerance * (box.upper - box.lower).norm();
    if (box.empty() || !(box.upper.z() - box.lower.z() > allowed)) return;
    throw MeshError(mesh_name + ": z runs from " + number(box.lower.z()) + " to " + number(box.upper.z()) +
                    " m in a mesh of dimension 2, " + number(allowed) +
                    " m of spread is allowed. Put the mesh into a plane z = constant, read it as dimension 3, or raise "
                    "planarity_tolerance.");
}

}  // namespace abut::mesh
