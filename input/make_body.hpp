#pragma once
// Private to the layer.
#include <filesystem>

#include "abut/input/settings.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::input {

/// Name of the cells of a body that none of its regions takes.
inline constexpr const char* rest_of_regions = "rest";

/// The mesh of a body in its place; bodies "<name>", of a file with several "<name>.<body of the file>", with regions
/// "<name>.<region>", with grains "<name>.1" and so on; groups "<name>.<group>". What has common vertices in the file, or is
/// cut into regions or grains, is in BuildReport::joined_bodies. Files are looked for from `folder`, unless `given` (null:
/// none) has the mesh. Throws MeshError, also where a table of BodySettings::parts has no body of the file.
template <int Dim>
[[nodiscard]] mesh::Mesh<Dim> make_body(const BodySettings& body, const std::filesystem::path& folder,
                                        const GivenMeshes* given = nullptr);

/// Position in the scene of a point that is given in the body, before its turn and place [m].
template <int Dim>
[[nodiscard]] Vector<Dim> placed(const BodySettings& body, const Vector<Dim>& point);

/// Settings for the body of this name in the mesh of make_body, from a file with several bodies: its own table, or `body`.
[[nodiscard]] const BodySettings& settings_of(const BodySettings& body, const std::string& name);

/// The table that a body of the mesh comes from; null: none.
[[nodiscard]] const BodySettings* table_of(const std::string& body, const std::vector<BodySettings>& tables);

}  // namespace abut::input
