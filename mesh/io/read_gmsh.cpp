#include "abut/mesh/io/read_gmsh.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "abut/geometry/box.hpp"
#include "abut/mesh/connected_bodies.hpp"
#include "abut/mesh/io/msh_file.hpp"
#include "abut/mesh/io/msh_soup.hpp"
#include "abut/mesh/io/other_formats.hpp"
#include "abut/mesh/io/plane_input.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

std::int32_t count_32(std::size_t n) {
    return static_cast<std::int32_t>(std::min<std::size_t>(n, std::numeric_limits<std::int32_t>::max()));
}

/// Throws unless elements are of order 1 or 2, and none of the other dimensions' kinds.
void check_order(const MshFile& file, const MshBlock& block) {
    if (block.type.order <= 2) return;
    throw MeshError(file.name + ": element " + std::to_string(block.labels.front()) + " is a " + block.type.name +
                    " of order " + std::to_string(block.type.order) +
                    ", those of orders 1 and 2 can be read. Mesh the part again with gmsh -order 1.");
}

/// Body of the cells of a block: its index among the physical groups of the dimension; -1 outside any group.
std::int32_t body_of(const MshFile& file, const MshBlock& block, const std::vector<std::int32_t>& body_groups) {
    if (block.groups.empty()) return -1;
    const auto name = [&](std::size_t i) { return file.name_of({block.type.dimension, block.groups[i]}); };
    if (block.groups.size() > 1)
        throw MeshError(file.name + ": geometric entity " + std::to_string(block.entity) + " is in the physical groups '" +
                        name(0) + "' and '" + name(1) + "', a cell belongs to one body. Leave it in one of them.");
    return static_cast<std::int32_t>(std::ranges::find(body_groups, block.groups[0]) - body_groups.begin());
}

template <int Dim>
void take_nodes(CellSoup<Dim>& soup, MshFile& file, double planarity_tolerance) {
    geometry::Box<3> box;
    soup.vertices.reserve(file.vertices.size());
    for (const Vector<3>& vertex : file.vertices) {
        box.extend(vertex);
        soup.vertices.push_back(vertex.head<Dim>());
    }
    soup.vertex_label = std::move(file.vertex_label);
    if (Dim == 2) check_lies_in_plane(soup.name, box, planarity_tolerance);
}

/// Elements of `dimension` as cells, or as faces of a surface in space.
template <int Dim>
void take_cells(CellSoup<Dim>& soup, const MshFile& file, std::int32_t dimension) {
    std::vector<std::int32_t> body_groups;
    for (const auto& [group_dimension, tag] : file.groups)
        if (group_dimension == dimension) {
            body_groups.push_back(tag);
            soup.body_names.push_back(file.name_of({dimension, tag}));
        }
    std::size_t n_curved = 0;
    for (const MshBlock& block : file.blocks) {
        if (block.type.dimension != dimension || block.size() == 0) continue;
        check_order(file, block);
        if (block.type.order == 2) n_curved += block.size();
        const std::int32_t body = body_of(file, block, body_groups);
        const std::size_t n = block.type.n_corners;
        for (std::size_t i = 0; i < block.size(); ++i) {
            soup.cell_vertices.append({block.nodes.data() + i * n, n});
            soup.cell_shape.push_back(*block.type.shape);
            soup.cell_body.push_back(body);
            soup.cell_label.push_back(block.labels[i]);
        }
    }
    if (n_curved > 0) soup.warnings.push_back(about_order_2(n_curved));
}

template <int Dim>
void take_boundary_groups(CellSoup<Dim>& soup, const MshFile& file) {
    for (const MshGroup& group : file.groups) {
        if (group.first != Dim - 1) continue;
        const auto index = static_cast<std::int32_t>(soup.group_names.size());
        soup.group_names.push_back(file.name_of(group));
        for (const MshBlock& block : file.blocks) {
            if (block.type.dimension != Dim - 1 || std::ranges::find(block.groups, group.second) == block.groups.end())
                continue;
            if (block.size() > 0) check_order(file, block);
            const auto n = static_cast<std::ptrdiff_t>(block.type.n_corners);
            for (auto node = block.nodes.begin(); node != block.nodes.end(); node += n)
                soup.named_faces.push_back({{node, node + n}, index});
        }
    }
}

/// Elements that are neither cells nor in a boundary group.
std::int32_t n_ignored_elements(const MshFile& file, std::int32_t dimension) {
    std::size_t count = 0;
    for (const MshBlock& block : file.blocks)
        if (block.type.dimension < dimension - 1 || (block.type.dimension == dimension - 1 && block.groups.empty()))
            count += block.size();
    return count_32(count);
}

template <int Dim>
void check_dimension(const MshFile& file) {
    if (Dim == 2 && file.n_elements(3) > 0)
        throw MeshError(file.name + ": " + std::to_string(file.n_elements(3)) +
                        " cells of dimension 3 in what should be a mesh of dimension 2. Read it as dimension 3.");
    if (file.n_elements(Dim) == 0)
        throw MeshError(file.name + ": the mesh is empty: 0 cells of dimension " + std::to_string(Dim) + " (and " +
                        std::to_string(file.n_elements(2)) + " of dimension 2), at least 1 is needed. Mesh the part up to " +
                        "dimension " + std::to_string(Dim) + ", and see that its physical groups hold the cells.");
}

}  // namespace

template <int Dim>
CellSoup<Dim> soup_of_msh(MshFile file, double planarity_tolerance) {
    check_dimension<Dim>(file);
    CellSoup<Dim> soup;
    soup.name = file.name;
    soup.warnings = file.warnings;
    take_nodes(soup, file, planarity_tolerance);
    take_cells(soup, file, Dim);
    name_connected_bodies(soup);
    take_boundary_groups(soup, file);
    soup.n_ignored_elements = n_ignored_elements(file, Dim);
    return soup;
}

CellSoup<3> surface_soup_of_msh(MshFile file) {
    CellSoup<3> soup;
    soup.name = file.name;
    soup.warnings = file.warnings;
    take_nodes(soup, file, 0.0);  // of no plane
    take_cells(soup, file, 2);
    soup.n_ignored_elements = count_32(file.n_elements(0) + file.n_elements(1));
    return soup;
}

template <int Dim>
Mesh<Dim> read_gmsh(const std::filesystem::path& path, const MeshOptions& options) {
    return build_mesh(soup_of_msh<Dim>(read_msh_file(path), options.planarity_tolerance), options);
}

template CellSoup<2> soup_of_msh<2>(MshFile, double);
template CellSoup<3> soup_of_msh<3>(MshFile, double);
template Mesh<2> read_gmsh<2>(const std::filesystem::path&, const MeshOptions&);
template Mesh<3> read_gmsh<3>(const std::filesystem::path&, const MeshOptions&);

}  // namespace abut::mesh
