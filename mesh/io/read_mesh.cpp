#include "abut/mesh/io/read_mesh.hpp"

#include "abut/mesh/io/other_formats.hpp"
#include "abut/mesh/io/read_gmsh.hpp"
#include "abut/mesh/io/read_vtu.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {

template <int Dim>
Mesh<Dim> read_mesh(const std::filesystem::path& path, const MeshOptions& options) {
    const std::string extension = small_extension(path);
    if (extension == ".msh") return read_gmsh<Dim>(path, options);
    if (extension == ".vtu") return read_vtu<Dim>(path, options);
    throw MeshError(path.string() + ": " + about_extension(path, ".msh", "a mesh file, .msh and .vtu"));
}

template Mesh<2> read_mesh<2>(const std::filesystem::path&, const MeshOptions&);
template Mesh<3> read_mesh<3>(const std::filesystem::path&, const MeshOptions&);

}  // namespace abut::mesh
