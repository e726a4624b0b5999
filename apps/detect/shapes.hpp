#pragma once
#include <string>

#include "abut/mesh/surface_mesh.hpp"

namespace abut::apps {

/// Whether a text names a generated shape rather than a file: "torus", "gear:n=4000", ...
[[nodiscard]] bool is_shape(const std::string& text);

/// The surface that "torus:n=4000,radius=2,x=1" asks for (mesh/shapes/surface_shapes.hpp). `n` is about the number of faces;
/// the other keys of every input place it (`place`). Throws BadInput naming the shape, the key and what is allowed;
/// mesh::MeshError for a value that the shape cannot have.
[[nodiscard]] mesh::SurfaceMesh make_shape(const std::string& text);

/// Shapes and their keys for --help, one shape per line.
[[nodiscard]] std::string shapes_help();

}  // namespace abut::apps
