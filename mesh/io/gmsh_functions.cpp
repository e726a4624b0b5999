// The only source that sees Gmsh: in a library of its own, which GmshFunctions are loaded from, unless libraries are static.
#include "abut/mesh/io/gmsh_functions.hpp"

#include <gmsh.h>

#include <numbers>

extern "C" const abut::mesh::GmshFunctions abut_gmsh_functions;

const abut::mesh::GmshFunctions abut_gmsh_functions{
    .initialize = [] { gmsh::initialize(0, nullptr, false); },
    .finalize = [] { gmsh::finalize(); },
    .set_option = [](const std::string& name, double value) { gmsh::option::setNumber(name, value); },
    .start_log = [] { gmsh::logger::start(); },
    .stop_log = [] { gmsh::logger::stop(); },
    .log =
        [] {
            std::vector<std::string> lines;
            gmsh::logger::get(lines);
            return lines;
        },
    .add_model = [](const std::string& name) { gmsh::model::add(name); },

    .add_physical_group = [](int dimension,
                             const std::vector<int>& tags) { return gmsh::model::addPhysicalGroup(dimension, tags); },
    .set_physical_name = [](int dimension, int tag,
                            const std::string& name) { gmsh::model::setPhysicalName(dimension, tag, name); },
    .physical_name =
        [](int dimension, int tag) {
            std::string name;
            gmsh::model::getPhysicalName(dimension, tag, name);
            return name;
        },
    .physical_groups =
        [](int dimension) {
            abut::mesh::GmshTags groups;
            gmsh::model::getPhysicalGroups(groups, dimension);
            return groups;
        },
    .physical_groups_of =
        [](int dimension, int entity) {
            std::vector<int> groups;
            gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
            return groups;
        },
    .entities_of_group =
        [](int dimension, int group) {
            std::vector<int> entities;
            gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
            return entities;
        },
    .entities =
        [](int dimension) {
            abut::mesh::GmshTags entities;
            gmsh::model::getEntities(entities, dimension);
            return entities;
        },
    .boundary_of =
        [](int dimension, int entity) {
            abut::mesh::GmshTags sides;
            gmsh::model::getBoundary({{dimension, entity}}, sides, false, false);
            return sides;
        },

    .add_discrete_entity = [](int dimension, int tag) { gmsh::model::addDiscreteEntity(dimension, tag); },
    .add_nodes =
        [](int dimension, int entity, const std::vector<std::size_t>& tags, const std::vector<double>& coordinates) {
            gmsh::model::mesh::addNodes(dimension, entity, tags, coordinates);
        },
    .add_elements =
        [](int entity, int type, const std::vector<std::size_t>& nodes) {
            gmsh::model::mesh::addElementsByType(entity, type, {}, nodes);
        },
    .classify_surfaces = [](double angle) { gmsh::model::mesh::classifySurfaces(angle, true, true, std::numbers::pi); },
    .create_geometry = [] { gmsh::model::mesh::createGeometry(); },
    .add_surface_loop = [](const std::vector<int>& surfaces, int tag) { gmsh::model::geo::addSurfaceLoop(surfaces, tag); },
    .add_volume = [](const std::vector<int>& surface_loops, int tag) { gmsh::model::geo::addVolume(surface_loops, tag); },
    .synchronize_discrete = [] { gmsh::model::geo::synchronize(); },

    .add_disk = [] { return gmsh::model::occ::addDisk(0, 0, 0, 1, 1); },
    .add_rectangle = [](double width, double height) { return gmsh::model::occ::addRectangle(0, 0, 0, width, height); },
    .add_box = [](double x, double y, double z) { return gmsh::model::occ::addBox(0, 0, 0, x, y, z); },
    .add_cylinder = [](double bottom,
                       double height) { return gmsh::model::occ::addCylinder(0, 0, bottom, 0, 0, height, 1); },
    .add_sphere = [] { return gmsh::model::occ::addSphere(0, 0, 0, 1); },
    .mass =
        [](int dimension, int tag) {
            double mass = 0.0;
            gmsh::model::occ::getMass(dimension, tag, mass);
            return mass;
        },
    .centre_of_mass = [](int dimension, int tag, double& x, double& y,
                         double& z) { gmsh::model::occ::getCenterOfMass(dimension, tag, x, y, z); },
    .synchronize_shapes = [] { gmsh::model::occ::synchronize(); },

    .set_size =
        [](std::function<double(double, double, double)> size) {
            gmsh::model::mesh::setSizeCallback(
                [size = std::move(size)](int, int, double x, double y, double z) { return size(x, y, z); });
        },
    .generate_mesh = [](int dimension) { gmsh::model::mesh::generate(dimension); },
    .element_types =
        [](int dimension) {
            std::vector<int> types;
            gmsh::model::mesh::getElementTypes(types, dimension);
            return types;
        },
    .element_properties =
        [](int type, std::string& name, int& order) {
            int dimension = 0, n_nodes = 0, n_primary = 0;
            std::vector<double> coordinates;
            gmsh::model::mesh::getElementProperties(type, name, dimension, order, n_nodes, coordinates, n_primary);
        },
    .elements =
        [](int dimension, int entity, std::vector<int>& types, std::vector<std::vector<std::size_t>>& tags,
           std::vector<std::vector<std::size_t>>& nodes) {
            gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
        },
    .nodes =
        [](std::vector<std::size_t>& tags, std::vector<double>& coordinates) {
            std::vector<double> parameters;
            gmsh::model::mesh::getNodes(tags, coordinates, parameters);
        },
};
