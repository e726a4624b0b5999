#pragma once
// Private to the layer.
#include <filesystem>

#include "abut/input/settings.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::input {

/// The mesh of a body in its place; bodies "<name>", of a file with several "<name>.<body of the file>"; groups
/// "<name>.<group>". Files are looked for from `folder`. Throws MeshError.
template <int Dim>
[[nodiscard]] mesh::Mesh<Dim> make_body(const BodySettings& body, const std::filesystem::path& folder);

}  // namespace abut::input
