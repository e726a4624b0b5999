#include "abut/mesh/io/gmsh_session.hpp"

#include <algorithm>
#include <array>
#include <clocale>
#include <cmath>
#include <cstddef>
#include <exception>
#include <iterator>
#include <utility>

#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/connected_bodies.hpp"
#include "abut/mesh/io/gmsh_functions.hpp"
#include "abut/mesh/io/node_numbers.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

std::mutex gmsh_in_use;

struct ElementType {
    int gmsh_number;
    CellShape shape;
};
constexpr std::array<ElementType, n_cell_shapes> element_types = {{{2, CellShape::triangle},
                                                                   {3, CellShape::quadrangle},
                                                                   {4, CellShape::tetrahedron},
                                                                   {5, CellShape::hexahedron},
                                                                   {6, CellShape::prism},
                                                                   {7, CellShape::pyramid}}};

/// Elements of one type of one geometric entity, as Gmsh hands them out.
struct ElementBlock {
    int type;
    std::size_t n_nodes;  ///< of one element
    std::vector<std::size_t> tags;
    std::vector<std::size_t> nodes;
};

std::vector<ElementBlock> element_blocks(int dimension, int entity) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh().elements(dimension, entity, types, tags, nodes);
    std::vector<ElementBlock> blocks;
    for (std::size_t i = 0; i < types.size(); ++i)
        if (!tags[i].empty())
            blocks.push_back({types[i], nodes[i].size() / tags[i].size(), std::move(tags[i]), std::move(nodes[i])});
    return blocks;
}

bool has_elements(int dimension) { return !gmsh().element_types(dimension).empty(); }

std::int32_t n_elements(int dimension, int entity = -1) {
    std::size_t count = 0;
    for (const auto& block : element_blocks(dimension, entity)) count += block.tags.size();
    return static_cast<std::int32_t>(count);
}

void check_first_order(const std::string& name, const ElementBlock& block, bool is_known) {
    std::string type;
    int order = 0;
    gmsh().element_properties(block.type, type, order);
    const std::string element = name + ": element " + std::to_string(block.tags.front()) + " is a '" + type + "'";
    if (order != 1)
        throw MeshError(element + " of order " + std::to_string(order) +
                        ", straight-sided elements of order 1 are needed. Save the mesh with gmsh -order 1.");
    if (!is_known)
        throw MeshError(
            element +
            ", cells can be triangles, quadrangles, tetrahedra, hexahedra, prisms and pyramids. Mesh the part with these.");
}

CellShape shape_of(const std::string& name, const ElementBlock& block) {
    const auto found = std::find_if(element_types.begin(), element_types.end(),
                                    [&](const ElementType& t) { return t.gmsh_number == block.type; });
    check_first_order(name, block, found != element_types.end());
    return found->shape;
}

template <int Dim>
std::vector<std::size_t> read_nodes(CellSoup<Dim>& soup) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    gmsh().nodes(tags, coordinates);
    soup.vertices.resize(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
        for (std::size_t k = 0; k < Dim; ++k) soup.vertices[i][static_cast<std::ptrdiff_t>(k)] = coordinates[3 * i + k];
    soup.vertex_label.assign(tags.begin(), tags.end());
    return tags;
}

std::string group_name(int dimension, int tag) {
    const std::string name = gmsh().physical_name(dimension, tag);
    return name.empty() ? std::string("physical_") + std::to_string(tag) : name;
}

/// Body of an entity: its index among the physical groups of dimension Dim; -1 outside any group.
std::int32_t body_of_entity(const std::string& mesh_name, int dimension, int entity, const std::vector<int>& body_groups) {
    const std::vector<int> groups = gmsh().physical_groups_of(dimension, entity);
    if (groups.empty()) return -1;
    if (groups.size() > 1)
        throw MeshError(mesh_name + ": geometric entity " + std::to_string(entity) + " is in the physical groups '" +
                        group_name(dimension, groups[0]) + "' and '" + group_name(dimension, groups[1]) +
                        "', a cell belongs to one body. Leave it in one of them.");
    return static_cast<std::int32_t>(std::find(body_groups.begin(), body_groups.end(), std::abs(groups[0])) -
                                     body_groups.begin());
}

template <int Dim>
void append_cells(CellSoup<Dim>& soup, const ElementBlock& block, const NodeNumbers<std::size_t>& number,
                  std::int32_t body) {
    const CellShape shape = shape_of(soup.name, block);
    std::array<std::int32_t, max_cell_vertices> vertices{};
    for (std::size_t i = 0; i < block.tags.size(); ++i) {
        for (std::size_t k = 0; k < block.n_nodes; ++k) {
            vertices[k] = number(block.nodes[i * block.n_nodes + k]);
            if (vertices[k] < 0)
                throw MeshError(soup.name + ": element " + std::to_string(block.tags[i]) + " has the node " +
                                std::to_string(block.nodes[i * block.n_nodes + k]) +
                                ", which is not in the file. Save the mesh again.");
        }
        soup.cell_vertices.append({vertices.data(), block.n_nodes});
        soup.cell_shape.push_back(shape);
        soup.cell_body.push_back(body);
        soup.cell_label.push_back(static_cast<std::int64_t>(block.tags[i]));
    }
}

template <int Dim>
void read_cells(CellSoup<Dim>& soup, const NodeNumbers<std::size_t>& number) {
    constexpr int dimension = Dim;
    std::vector<int> tags;
    for (const auto& [group_dimension, tag] : gmsh().physical_groups(dimension)) {
        tags.push_back(tag);
        soup.body_names.push_back(group_name(dimension, tag));
    }
    for (const auto& [entity_dimension, entity] : gmsh().entities(dimension)) {
        const auto blocks = element_blocks(dimension, entity);
        if (blocks.empty()) continue;
        const std::int32_t body = body_of_entity(soup.name, dimension, entity, tags);
        for (const auto& block : blocks) append_cells(soup, block, number, body);
    }
}

template <int Dim>
void read_group(CellSoup<Dim>& soup, int tag, const NodeNumbers<std::size_t>& number) {
    const auto group = static_cast<std::int32_t>(soup.group_names.size());
    soup.group_names.push_back(group_name(Dim - 1, tag));
    for (const int entity : gmsh().entities_of_group(Dim - 1, tag))
        for (const auto& block : element_blocks(Dim - 1, entity)) {
            check_first_order(soup.name, block, true);
            for (std::size_t i = 0; i < block.tags.size(); ++i) {
                typename CellSoup<Dim>::NamedFace face{{}, group};
                for (std::size_t k = 0; k < block.n_nodes; ++k)
                    face.vertices.push_back(number(block.nodes[i * block.n_nodes + k]));
                soup.named_faces.push_back(std::move(face));
            }
        }
}

/// Elements that are neither cells nor in a boundary group.
template <int Dim>
std::int32_t n_ignored_elements() {
    std::int32_t count = 0;
    for (int dimension = 0; dimension < Dim - 1; ++dimension) count += n_elements(dimension);
    for (const auto& [dimension, entity] : gmsh().entities(Dim - 1))
        if (gmsh().physical_groups_of(dimension, entity).empty()) count += n_elements(dimension, entity);
    return count;
}

template <int Dim>
void check_dimension(const std::string& name) {
    if (Dim == 2 && has_elements(3))
        throw MeshError(name + ": " + std::to_string(n_elements(3)) +
                        " cells of dimension 3 in what should be a mesh of dimension 2. Read it as dimension 3.");
    if (!has_elements(Dim))
        throw MeshError(name + ": the mesh is empty: 0 cells of dimension " + std::to_string(Dim) + " (and " +
                        std::to_string(n_elements(2)) +
                        " of dimension 2), at least 1 is needed. Mesh the part up to dimension " + std::to_string(Dim) +
                        ", and see that its physical groups hold the cells.");
}

}  // namespace

GmshSession::GmshSession() : lock_(gmsh_in_use), locale_before_(std::setlocale(LC_ALL, nullptr)) {
    gmsh().initialize();
    gmsh().set_option("General.Terminal", 0);
    gmsh().set_option("General.NumThreads", 1);
    gmsh().set_option("Mesh.RandomSeed", 1);
    gmsh().start_log();
    gmsh().add_model("abut");
}

GmshSession::~GmshSession() {
    try {
        gmsh().stop_log();
        gmsh().finalize();
    } catch (...) {  // a destructor has nobody to tell
    }
    std::setlocale(LC_ALL, locale_before_.c_str());
}

namespace {

std::vector<std::string> logged(const char* level) {
    std::vector<std::string> found;
    std::ranges::copy_if(gmsh().log(), std::back_inserter(found),
                         [&](const std::string& line) { return line.starts_with(level); });
    return found;
}

}  // namespace

std::vector<std::string> GmshSession::errors() { return logged("Error"); }
std::vector<std::string> GmshSession::warnings() { return logged("Warning"); }

void GmshSession::run(const std::string& name, const std::string& task, const std::string& remedy,
                      const std::function<void()>& calls) const {
    std::string what;
    try {
        calls();
        return;
    } catch (const MeshError&) {
        throw;
    } catch (const std::exception& error) {
        what = error.what();
    } catch (const std::string& error) {
        what = error;
    } catch (...) {
        what = "unknown error";
    }
    std::string said;
    for (const auto& lines : {errors(), warnings()})
        for (const std::string& line : lines) said += (said.empty() ? "" : "; ") + line;
    if (said.empty()) said = what;
    throw MeshError(name + ": " + task + ": Gmsh says: " + said + ". " + remedy);
}

template <int Dim>
CellSoup<Dim> soup_of_gmsh_model(const std::string& name) {
    check_dimension<Dim>(name);
    CellSoup<Dim> soup;
    soup.name = name;
    const NodeNumbers<std::size_t> number(read_nodes(soup));
    read_cells(soup, number);
    name_connected_bodies(soup);
    for (const auto& [dimension, tag] : gmsh().physical_groups(Dim - 1)) read_group(soup, tag, number);
    soup.n_ignored_elements = n_ignored_elements<Dim>();
    return soup;
}

template CellSoup<2> soup_of_gmsh_model<2>(const std::string&);
template CellSoup<3> soup_of_gmsh_model<3>(const std::string&);

}  // namespace abut::mesh
