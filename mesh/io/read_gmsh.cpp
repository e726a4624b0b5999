#include "abut/mesh/io/read_gmsh.hpp"

#include <gmsh.h>

#include <cstdint>
#include <cstring>
#include <functional>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/gmsh_session.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

struct Header {
    std::string version;
    bool binary = false;
};

Header read_header(const std::string& name, const std::string& contents) {
    std::istringstream start(contents.substr(0, 256));
    start.imbue(std::locale::classic());
    std::string section;
    Header header;
    int file_type = -1;
    start >> section >> header.version >> file_type;
    if (section != "$MeshFormat")
        throw MeshError(name + ": is not a Gmsh mesh file: it starts with '" + section.substr(0, 20) +
                        "', '$MeshFormat' is needed. Save it with gmsh -format msh41.");
    if ((header.version != "2.2" && header.version != "4.1") || (file_type != 0 && file_type != 1))
        throw MeshError(name + ": has the Gmsh format '" + header.version +
                        "', 2.2 and 4.1 can be read. Save it with gmsh -format msh41.");
    header.binary = file_type == 1;
    return header;
}

/// Where the contents of a section begin: behind the line with its name.
std::size_t section_start(const std::string& name, const std::string& contents, const std::string& section) {
    const auto start = contents.find("\n$" + section);
    const auto end = contents.rfind("\n$End" + section);
    if (start == std::string::npos || end == std::string::npos || end < start)
        throw MeshError(name + ": the file is truncated: '$" + (start == std::string::npos ? "" : "End") + section +
                        "' is missing after " + std::to_string(contents.size()) + " bytes. Write the mesh again.");
    return contents.find('\n', start + 1) + 1;
}

/// The number of elements that the head of the section $Elements promises.
std::uint64_t promised_elements(const Header& header, const std::string& contents, std::size_t start) {
    std::uint64_t counts[2] = {0, 0};
    if (header.version == "4.1" && header.binary) {
        if (start + sizeof counts <= contents.size()) std::memcpy(counts, contents.data() + start, sizeof counts);
        return counts[1];
    }
    std::istringstream line(contents.substr(start, 128));
    line.imbue(std::locale::classic());
    line >> counts[0];
    if (header.version == "4.1") line >> counts[1];
    return header.version == "4.1" ? counts[1] : counts[0];
}

void check_number_of_elements(const std::string& name, std::uint64_t promised) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes);
    std::uint64_t found = 0;
    for (const auto& of_type : tags) found += of_type.size();
    if (found < promised)
        throw MeshError(name + ": the file is damaged: " + std::to_string(found) +
                        " elements could be read, its header promises " + std::to_string(promised) +
                        ". Write the mesh again.");
}

}  // namespace

void in_gmsh_file(const std::filesystem::path& path, const std::function<void()>& read) {
    const std::string name = path.string();
    std::uint64_t promised = 0;
    {
        const std::string contents = file_contents(path);
        const Header header = read_header(name, contents);
        section_start(name, contents, "Nodes");
        promised = promised_elements(header, contents, section_start(name, contents, "Elements"));
    }
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
