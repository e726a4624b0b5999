#pragma once
// Private to the layer; not installed.
#include <string>

#include "abut/geometry/box.hpp"

namespace abut::mesh {

/// Throws MeshError unless the box around all points of an input lies in a plane z = constant, up to `tolerance` times its
/// diagonal (MeshOptions::planarity_tolerance), as a mesh of dimension 2 must. An empty box does, and one with NaN
/// bounds is left to `check_soup`.
void check_lies_in_plane(const std::string& mesh_name, const geometry::Box<3>& box, double tolerance);

}  // namespace abut::mesh
