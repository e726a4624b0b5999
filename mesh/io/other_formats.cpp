#include "abut/mesh/io/other_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace abut::mesh {
namespace {

enum class Tool { gmsh, gmsh_mesher, gmsh_in_metres, meshio, none };

struct Format {
    const char* extension;
    const char* owner;
    Tool tool;  ///< what keeps bodies and groups
};
constexpr std::array<Format, 20> formats = {{{".inp", "an input file of Abaqus", Tool::meshio},
                                             {".vtk", "a legacy file of VTK", Tool::meshio},
                                             {".exo", "a mesh of Exodus", Tool::meshio},
                                             {".e", "a mesh of Exodus", Tool::meshio},
                                             {".xdmf", "a mesh of XDMF", Tool::meshio},
                                             {".mesh", "a mesh of Medit", Tool::meshio},
                                             {".med", "a mesh of Salome", Tool::meshio},
                                             {".bdf", "an input file of Nastran", Tool::meshio},
                                             {".nas", "an input file of Nastran", Tool::meshio},
                                             {".su2", "a mesh of SU2", Tool::meshio},
                                             {".unv", "a mesh of I-deas", Tool::gmsh},
                                             {".cgns", "a mesh of CGNS", Tool::gmsh},
                                             {".key", "an input file of LS-DYNA", Tool::none},
                                             {".k", "an input file of LS-DYNA", Tool::none},
                                             {".geo", "a geometry of Gmsh, not meshed yet", Tool::gmsh_mesher},
                                             {".step", "a geometry, not meshed yet", Tool::gmsh_in_metres},
                                             {".stp", "a geometry, not meshed yet", Tool::gmsh_in_metres},
                                             {".iges", "a geometry, not meshed yet", Tool::gmsh_mesher},
                                             {".brep", "a geometry, not meshed yet", Tool::gmsh_mesher},
                                             {".igs", "a geometry, not meshed yet", Tool::gmsh_mesher}}};

/// `wanted` is .msh for cells, .vtu for a surface, which has no groups.
std::string remedy(const Format& format, const std::filesystem::path& path, const std::string& wanted) {
    const std::string from = path.filename().string(), stem = path.stem().string();
    switch (format.tool) {
        case Tool::none:
            return "No converter is known. Write the mesh as .unv, .inp or .bdf where it was made, and convert that.";
        case Tool::gmsh_mesher:
            return "Convert it: gmsh " + from + " -3 -o " + stem + ".msh (-2 for a mesh in the plane)";
        case Tool::gmsh_in_metres:  // it meshes them in millimetres, whatever the unit of the file is (4.8.4)
            return "Convert it: gmsh " + from + " -setstring Geometry.OCCTargetUnit M -3 -o " + stem +
                   ".msh (-2 for a mesh in the plane; without -setstring lengths are in millimetres)";
        case Tool::gmsh:
            return "Convert it: gmsh " + from + " -save -o " + stem + ".msh" +
                   (std::string_view(format.extension) == ".cgns" ? " (that of Debian is built without CGNS)" : "");
        case Tool::meshio:
            break;
    }
    if (wanted != ".msh") return "Convert it: meshio convert " + from + " " + stem + wanted + " (package meshio-tools)";
    return "Convert it with its groups (package python3-meshio): python3 -c 'import sys, meshio; from abut import solid; "
           "solid.mesh(meshio.read(sys.argv[1])).write_vtu(sys.argv[2])' " +
           from + " " + stem + ".vtu";
}

}  // namespace

std::string small_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension;
}

std::string about_order_2(std::size_t n_elements) {
    return std::to_string(n_elements) +
           " elements are of order 2: their nodes between corners are left out, so that edges and faces are straight";
}

std::string about_extension(const std::filesystem::path& path, const std::string& wanted, const std::string& known) {
    const std::string extension = path.extension().string();
    const auto found = std::ranges::find(formats, small_extension(path), &Format::extension);
    if (found == formats.end())
        return "the extension '" + extension + "' is none of " + known + " can be read. Convert the file or rename it.";
    return "the extension '" + extension + "' is that of " + found->owner + ", which is not read. " +
           remedy(*found, path, wanted);
}

}  // namespace abut::mesh
