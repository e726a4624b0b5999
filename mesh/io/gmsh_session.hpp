#pragma once
// Private to the layer; not installed.
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Gmsh, initialised, quiet, with one thread and a fixed seed, for as long as this object lives; an empty model is current.
/// Gmsh has one state per process: a second session waits for the first to end. The host must not hold Gmsh open itself.
/// Gmsh sets the C locale of the process; the session puts back the one it found.
class GmshSession {
public:
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;

    /// Runs Gmsh calls; whatever they throw becomes a MeshError "<name>: <task>: <Gmsh's errors and warnings>. <remedy>".
    void run(const std::string& name, const std::string& task, const std::string& remedy,
             const std::function<void()>& calls) const;
    /// What Gmsh has logged so far: "Error: ...", "Warning: ...".
    [[nodiscard]] static std::vector<std::string> errors();
    [[nodiscard]] static std::vector<std::string> warnings();

private:
    std::unique_lock<std::mutex> lock_;
    std::string locale_before_;
};

/// The cells of dimension Dim of Gmsh's current model. A body is a physical group of dimension Dim; cells outside any group
/// make one body for each connected component. Boundary groups are the physical groups of dimension Dim - 1. A group without
/// a name is called "physical_<tag>". Labels are Gmsh's element and node tags. Throws MeshError: see read_gmsh.
template <int Dim>
[[nodiscard]] CellSoup<Dim> soup_of_gmsh_model(const std::string& name);

/// The triangles and quadrangles of Gmsh's current model, in space. A body is a physical group of dimension 2; elements
/// outside any group have the body -1. Empty if there are none. Throws MeshError: see read_gmsh.
[[nodiscard]] CellSoup<3> surface_of_gmsh_model(const std::string& name);

/// Whether Gmsh's current model has elements of that dimension.
[[nodiscard]] bool has_gmsh_elements(int dimension);

/// Opens a .msh file in a session and, when all is there that its head promises, calls `read`. Throws MeshError: see
/// read_gmsh.
void in_gmsh_file(const std::filesystem::path& path, const std::function<void()>& read);

}  // namespace abut::mesh
