#include "abut/mesh/io/gmsh_functions.hpp"
#ifdef ABUT_GMSH_LIBRARY

#include <dlfcn.h>

#include <filesystem>

#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

/// From beside the library of this layer; it stays loaded until the program ends.
const GmshFunctions& loaded_functions() {
    Dl_info here{};
    dladdr(reinterpret_cast<const void*>(&gmsh), &here);
    const std::string path = std::filesystem::path(here.dli_fname).replace_filename(ABUT_GMSH_LIBRARY).string();
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    const void* functions = library ? dlsym(library, "abut_gmsh_functions") : nullptr;
    if (!functions) {
        const char* why = dlerror();
        throw MeshError("Gmsh, which makes this mesh, cannot be loaded: " + std::string(why ? why : path) +
                        ". Install its library (package libgmsh4.8 of Debian 12; beside packages of Abut libabut-gmsh0.1).");
    }
    return *static_cast<const GmshFunctions*>(functions);
}

}  // namespace

const GmshFunctions& gmsh() {
    static const GmshFunctions& functions = loaded_functions();
    return functions;
}

}  // namespace abut::mesh

#else

extern "C" const abut::mesh::GmshFunctions abut_gmsh_functions;

namespace abut::mesh {

const GmshFunctions& gmsh() { return abut_gmsh_functions; }

}  // namespace abut::mesh

#endif
