#pragma once
#include <functional>
#include <mutex>
#include <string>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Gmsh, initialised, quiet, with one thread and a fixed seed, for as long as this object lives; an empty model is current.
/// Gmsh has one state a process: a second session waits for the first to end. The host must not hold Gmsh open itself.
class GmshSession {
public:
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;

    /// Runs Gmsh calls; whatever they throw becomes a MeshError "<name>: <task>: <Gmsh's errors and warnings>. <remedy>".
    void run(const std::string& name, const std::string& task, const std::string& remedy, const std::function<void()>& calls) const;
    /// Errors and warnings that Gmsh has logged so far, joined with "; ".
    [[nodiscard]] static std::string complaints();

private:
    std::unique_lock<std::mutex> lock_;
};

/// The cells of dimension Dim of Gmsh's current model. A body is a physical group of dimension Dim; cells outside any group
/// make one body for each connected component. Boundary groups are the physical groups of dimension Dim - 1. A group without
/// a name is called "physical_<tag>". Labels are Gmsh's element and node tags. Throws MeshError: see read_gmsh.
template <int Dim>
[[nodiscard]] CellSoup<Dim> soup_of_gmsh_model(const std::string& name);

}  // namespace abut::mesh
