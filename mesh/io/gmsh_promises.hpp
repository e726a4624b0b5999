#pragma once
// Private to the layer; not installed.
#include <string>

namespace abut::mesh {

/// Gmsh makes room for what the heads of sections and blocks promise before it reads them, and ends the process, or hangs,
/// over some binary files. This looks first: throws MeshError unless the file is of a known version and, where it is binary,
/// of this machine's order of bytes; unless the numbers of nodes and elements fit into the file; and unless the sections of
/// nodes and elements of a binary file are whole, block by block.
/// Returns the number of elements that the file promises.
std::size_t check_gmsh_promises(const std::string& name, const std::string& contents);

}  // namespace abut::mesh
