#include "abut/mesh/io/other_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace abut::mesh {
namespace {

enum class Tool { gmsh, gmsh_mesher, meshio };

struct Format {
    const char* extension;
    const char* owner;
    Tool tool;
};
constexpr std::array<Format, 16> formats = {{{".inp", "an input file of Abaqus", Tool::meshio},
                                             {".vtk", "a legacy file of VTK", Tool::meshio},
                                             {".exo", "a mesh of Exodus", Tool::meshio},
                                             {".e", "a mesh of Exodus", Tool::meshio},
                                             {".xdmf", "a mesh of XDMF", Tool::meshio},
                                             {".mesh", "a mesh of Medit", Tool::gmsh},
                                             {".med", "a mesh of Salome", Tool::gmsh},
                                             {".bdf", "an input file of Nastran", Tool::gmsh},
                                             {".nas", "an input file of Nastran", Tool::gmsh},
                                             {".unv", "a mesh of I-deas", Tool::gmsh},
                                             {".cgns", "a mesh of CGNS", Tool::gmsh},
                                             {".geo", "a geometry of Gmsh, not meshed yet", Tool::gmsh_mesher},
                                             {".step", "a geometry, not meshed yet", Tool::gmsh_mesher},
                                             {".stp", "a geometry, not meshed yet", Tool::gmsh_mesher},
                                             {".iges", "a geometry, not meshed yet", Tool::gmsh_mesher},
                                             {".brep", "a geometry, not meshed yet", Tool::gmsh_mesher}}};

std::string command(Tool tool, const std::filesystem::path& path, const std::string& wanted) {
    const std::string from = path.filename().string(), stem = path.stem().string();
    if (tool == Tool::gmsh_mesher) return "gmsh " + from + " -3 -o " + stem + ".msh (-2 for a mesh in the plane)";
    if (tool == Tool::gmsh) return "gmsh " + from + " -save -o " + stem + ".msh";
    return "meshio convert " + from + " " + stem + (wanted == ".msh" ? ".msh --output-format gmsh22" : wanted);
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
    return "the extension '" + extension + "' is that of " + found->owner +
           ", which is not read. Convert it: " + command(found->tool, path, wanted);
}

}  // namespace abut::mesh
