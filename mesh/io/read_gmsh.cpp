#include "abut/mesh/io/read_gmsh.hpp"

#include <gmsh.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/gmsh_promises.hpp"
#include "abut/mesh/io/gmsh_session.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

void check_number_of_elements(const std::string& name, std::size_t promised) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes);
    std::size_t found = 0;
    for (const auto& of_type : tags) found += of_type.size();
    if (found < promised)
        throw MeshError(name + ": the file is damaged: " + std::to_string(found) +
                        " elements could be read, its header promises " + std::to_string(promised) +
                        ". Write the mesh again.");
}

}  // namespace

void in_gmsh_file(const std::filesystem::path& path, const std::function<void()>& read) {
    const std::string name = path.string();
    const std::size_t promised = check_gmsh_promises(name, file_contents(path));
    const GmshSession session;
    session.run(name, "cannot be read", "Write the mesh again.", [&] {
        gmsh::merge(name);
        if (!GmshSession::errors().empty()) throw Diverged("errors, logged");
        check_number_of_elements(name, promised);
        read();
    });
}

template <int Dim>
Mesh<Dim> read_gmsh(const std::filesystem::path& path, const MeshOptions& options) {
    CellSoup<Dim> soup;
    in_gmsh_file(path, [&] {
        soup = soup_of_gmsh_model<Dim>(path.string());
        soup.warnings = GmshSession::warnings();
    });
    return build_mesh(std::move(soup), options);
}

template Mesh<2> read_gmsh<2>(const std::filesystem::path&, const MeshOptions&);
template Mesh<3> read_gmsh<3>(const std::filesystem::path&, const MeshOptions&);

}  // namespace abut::mesh
