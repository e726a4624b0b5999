#pragma once
// Private to the layer; not installed.
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/io/msh_types.hpp"

namespace abut::mesh {

/// Elements of one type, of one geometric entity and in the same physical groups.
struct MshBlock {
    MshType type;
    std::int32_t entity;               ///< tag of the geometric entity, of the dimension of the type
    std::vector<std::int32_t> groups;  ///< tags of physical groups, above 0, increasing
    std::vector<std::int64_t> labels;  ///< tags of the elements
    std::vector<std::int32_t>
        nodes;  ///< (n type.n_corners) indices into MshFile::vertices; nodes on edges and faces left out

    [[nodiscard]] std::size_t size() const { return labels.size(); }
};

/// A physical group: dimension and tag.
using MshGroup = std::pair<std::int32_t, std::int32_t>;

/// Content of a Gmsh file, in the order of the file, except blocks: by dimension, entity, type.
struct MshFile {
    std::string name;  ///< path, for messages
    std::vector<Vector<3>> vertices;
    std::vector<std::int64_t> vertex_label;
    std::vector<MshBlock> blocks;
    std::set<MshGroup> groups;  ///< those that elements or geometric entities are in
    std::map<MshGroup, std::string> group_names;
    std::vector<std::string> warnings;

    /// "physical_<tag>" for a group without a name.
    [[nodiscard]] std::string name_of(const MshGroup& group) const;
    /// Number of elements of a dimension.
    [[nodiscard]] std::size_t n_elements(std::int32_t dimension) const;
};

/// Reads format 2.0 to 2.2 or 4.1, text or binary of either order of bytes. Sections that are neither nodes, elements,
/// entities nor physical names are skipped. A node that stands twice is read once, with a warning. The end of the last line
/// may be missing. Memory is taken for what the file holds, not for what it promises.
/// Throws MeshError with the path, the line (text) or the byte (binary), what is wrong and what to do.
[[nodiscard]] MshFile read_msh_file(const std::filesystem::path& path);

}  // namespace abut::mesh
