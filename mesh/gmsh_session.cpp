#include "abut/mesh/gmsh_session.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <unordered_map>
#include <utility>

#include "abut/geometry/box.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/connected_bodies.hpp"
#include "abut/mesh/messages.hpp"
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
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    std::vector<ElementBlock> blocks;
    for (std::size_t i = 0; i < types.size(); ++i)
        if (!tags[i].empty()) blocks.push_back({types[i], nodes[i].size() / tags[i].size(), std::move(tags[i]), std::move(nodes[i])});
    return blocks;
}

std::int32_t n_elements(int dimension) {
    std::size_t count = 0;
    for (const auto& block : element_blocks(dimension, -1)) count += block.tags.size();
    return static_cast<std::int32_t>(count);
}

void check_first_order(const std::string& name, const ElementBlock& block, bool known) {
    std::string type;
    int dimension = 0, order = 0, n_nodes = 0, n_primary = 0;
    std::vector<double> coordinates;
    gmsh::model::mesh::getElementProperties(block.type, type, dimension, order, n_nodes, coordinates, n_primary);
    if (known && order == 1) return;
    throw MeshError(name + ": element " + std::to_string(block.tags.front()) + " is a '" + type + "' of order " + std::to_string(order) +
                    ", straight-sided elements of order 1 are needed. Save the mesh with gmsh -order 1.");
}

CellShape shape_of(const std::string& name, const ElementBlock& block) {
    const auto found = std::find_if(element_types.begin(), element_types.end(), [&](const ElementType& t) { return t.gmsh_number == block.type; });
    check_first_order(name, block, found != element_types.end());
    return found->shape;
}

/// From Gmsh's node tags to indices into CellSoup::vertices.
class NodeNumbers {
public:
    explicit NodeNumbers(const std::vector<std::size_t>& tags) {
        for (std::size_t i = 0; i < tags.size(); ++i) number_.emplace(tags[i], static_cast<std::int32_t>(i));
        const auto largest = tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end());
        if (largest > 4 * tags.size() + 1000) return;
        dense_.assign(largest + 1, -1);
        for (const auto& [tag, index] : number_) dense_[tag] = index;
    }
    /// -1 for a node that is not there.
    [[nodiscard]] std::int32_t operator()(std::size_t tag) const {
        if (!dense_.empty()) return tag < dense_.size() ? dense_[tag] : -1;
        const auto found = number_.find(tag);
        return found == number_.end() ? -1 : found->second;
    }

private:
    std::unordered_map<std::size_t, std::int32_t> number_;
    std::vector<std::int32_t> dense_;
};

template <int Dim>
void check_flat(const std::string& name, const std::vector<double>& coordinates) {
    if constexpr (Dim == 2) {
        geometry::Box<3> box;
        for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) box.extend(Vector<3>(coordinates[i], coordinates[i + 1], coordinates[i + 2]));
        const double allowed = 1e-12 * (box.upper - box.lower).norm();
        if (coordinates.empty() || !(box.upper.z() - box.lower.z() > allowed)) return;
        throw MeshError(name + ": z runs from " + number(box.lower.z()) + " to " + number(box.upper.z()) + " m in a mesh of dimension 2, " +
                        number(allowed) + " m of spread is allowed. Put the mesh into a plane z = constant, or read it as dimension 3.");
    }
}

template <int Dim>
std::vector<std::size_t> read_nodes(CellSoup<Dim>& soup) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters);
    check_flat<Dim>(soup.name, coordinates);
    soup.vertices.resize(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i)
        for (std::size_t k = 0; k < Dim; ++k) soup.vertices[i][static_cast<Eigen::Index>(k)] = coordinates[3 * i + k];
    soup.vertex_label.assign(tags.begin(), tags.end());
    return tags;
}

std::string group_name(int dimension, int tag) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    return name.empty() ? std::string("physical_") + std::to_string(tag) : name;
}

/// Body of an entity: its place among the physical groups of dimension Dim; -1 outside any group.
std::int32_t body_of_entity(const std::string& mesh_name, int dimension, int entity, const std::vector<int>& body_groups) {
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
    if (groups.empty()) return -1;
    if (groups.size() > 1)
        throw MeshError(mesh_name + ": geometric entity " + std::to_string(entity) + " is in the physical groups '" +
                        group_name(dimension, groups[0]) + "' and '" + group_name(dimension, groups[1]) + "', a cell belongs to one body. Leave it in one of them.");
    return static_cast<std::int32_t>(std::find(body_groups.begin(), body_groups.end(), std::abs(groups[0])) - body_groups.begin());
}

template <int Dim>
void append_cells(CellSoup<Dim>& soup, const ElementBlock& block, const NodeNumbers& number, std::int32_t body) {
    const CellShape shape = shape_of(soup.name, block);
    std::array<std::int32_t, max_cell_vertices> vertices{};
    for (std::size_t i = 0; i < block.tags.size(); ++i) {
        for (std::size_t k = 0; k < block.n_nodes; ++k) {
            vertices[k] = number(block.nodes[i * block.n_nodes + k]);
            if (vertices[k] < 0)
                throw MeshError(soup.name + ": element " + std::to_string(block.tags[i]) + " has the node " +
                                std::to_string(block.nodes[i * block.n_nodes + k]) + ", which is not in the file. Save the mesh again.");
        }
        soup.cell_vertices.append({vertices.data(), block.n_nodes});
        soup.cell_shape.push_back(shape);
        soup.cell_body.push_back(body);
        soup.cell_label.push_back(static_cast<std::int64_t>(block.tags[i]));
    }
}

template <int Dim>
void read_cells(CellSoup<Dim>& soup, const NodeNumbers& number) {
    gmsh::vectorpair groups, entities;
    gmsh::model::getPhysicalGroups(groups, Dim);
    std::vector<int> tags;
    for (const auto& [dimension, tag] : groups) {
        tags.push_back(tag);
        soup.body_names.push_back(group_name(Dim, tag));
    }
    gmsh::model::getEntities(entities, Dim);
    for (const auto& [dimension, entity] : entities) {
        const auto blocks = element_blocks(Dim, entity);
        if (blocks.empty()) continue;
        const std::int32_t body = body_of_entity(soup.name, Dim, entity, tags);
        for (const auto& block : blocks) append_cells(soup, block, number, body);
    }
}

template <int Dim>
void read_group(CellSoup<Dim>& soup, int tag, const NodeNumbers& number) {
    const auto group = static_cast<std::int32_t>(soup.group_names.size());
    soup.group_names.push_back(group_name(Dim - 1, tag));
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(Dim - 1, tag, entities);
    for (const int entity : entities)
        for (const auto& block : element_blocks(Dim - 1, entity)) {
            check_first_order(soup.name, block, true);
            for (std::size_t i = 0; i < block.tags.size(); ++i) {
                typename CellSoup<Dim>::NamedFace face{{}, group};
                for (std::size_t k = 0; k < block.n_nodes; ++k) face.vertices.push_back(number(block.nodes[i * block.n_nodes + k]));
                soup.named_faces.push_back(std::move(face));
            }
        }
}

template <int Dim>
void check_dimension(const std::string& name) {
    const std::int32_t solid = n_elements(3), flat = n_elements(2);
    if (Dim == 2 && solid > 0)
        throw MeshError(name + ": " + std::to_string(solid) + " cells of dimension 3 in what should be a mesh of dimension 2. Read it as dimension 3.");
    if ((Dim == 2 ? flat : solid) == 0)
        throw MeshError(name + ": the mesh is empty: 0 cells of dimension " + std::to_string(Dim) + " (and " + std::to_string(flat) +
                        " of dimension 2), at least 1 is needed. Mesh the part up to dimension " + std::to_string(Dim) +
                        ", and see that its physical groups hold the cells.");
}

}  // namespace

GmshSession::GmshSession() : lock_(gmsh_in_use) {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.RandomSeed", 1);
    gmsh::logger::start();
    gmsh::model::add("abut");
}

GmshSession::~GmshSession() {
    try {
        gmsh::logger::stop();
        gmsh::finalize();
    } catch (...) {  // a destructor has nobody to tell
    }
}

std::string GmshSession::complaints() {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    std::string joined;
    for (const std::string& line : log)
        if (line.starts_with("Error") || line.starts_with("Warning")) joined += std::string(joined.empty() ? "" : "; ") + line;
    return joined;
}

void GmshSession::run(const std::string& name, const std::string& task, const std::string& remedy, const std::function<void()>& calls) const {
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
    const std::string logged = complaints();
    throw MeshError(name + ": " + task + ": Gmsh says: " + (logged.empty() ? what : logged) + ". " + remedy);
}

template <int Dim>
CellSoup<Dim> soup_of_gmsh_model(const std::string& name) {
    check_dimension<Dim>(name);
    CellSoup<Dim> soup;
    soup.name = name;
    const NodeNumbers number(read_nodes(soup));
    read_cells(soup, number);
    name_connected_bodies(soup);
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, Dim - 1);
    for (const auto& [dimension, tag] : groups) read_group(soup, tag, number);
    for (int dimension = 0; dimension < Dim; ++dimension) soup.n_ignored_elements += n_elements(dimension);
    soup.n_ignored_elements = std::max(0, soup.n_ignored_elements - static_cast<std::int32_t>(soup.named_faces.size()));
    return soup;
}

template CellSoup<2> soup_of_gmsh_model<2>(const std::string&);
template CellSoup<3> soup_of_gmsh_model<3>(const std::string&);

}  // namespace abut::mesh
