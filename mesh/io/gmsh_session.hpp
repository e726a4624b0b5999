#pragma once
// Private to the layer; not installed.
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
    /// Messages that Gmsh has logged so far: "Error: ...", "Warning: ...".
    [[nodiscard]] static std::vector<std::string> errors();
    [[nodiscard]] static std::vector<std::string> warnings();

private:
    std::unique_lock<std::mutex> lock_;
    std::string locale_before_;
};

/// The cells of dimension Dim of Gmsh's current model. A body is a physical group of dimension Dim; cells outside any group
/// make one body for each connected component. Boundary groups are the physical groups of dimension Dim - 1. A group without
/// a name is called "physical_<tag>". Labels are Gmsh's element and node tags. Throws MeshError.
template <int Dim>
[[nodiscard]] CellSoup<Dim> soup_of_gmsh_model(const std::string& name);

}  // namespace abut::mesh
