#pragma once
// Private to the layer; not installed.
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace abut::mesh {

/// Dimension and tag of entities of Gmsh.
using GmshTags = std::vector<std::pair<int, int>>;

/// Functions of Gmsh with the arguments that vary here, to be called during a GmshSession; they throw what Gmsh throws.
struct GmshFunctions {
    void (*initialize)();
    void (*finalize)();
    void (*set_option)(const std::string& name, double value);
    void (*start_log)();
    void (*stop_log)();
    std::vector<std::string> (*log)();
    void (*add_model)(const std::string& name);

    int (*add_physical_group)(int dimension, const std::vector<int>& tags);
    void (*set_physical_name)(int dimension, int tag, const std::string& name);
    std::string (*physical_name)(int dimension, int tag);
    GmshTags (*physical_groups)(int dimension);
    std::vector<int> (*physical_groups_of)(int dimension, int entity);
    std::vector<int> (*entities_of_group)(int dimension, int group);
    GmshTags (*entities)(int dimension);
    GmshTags (*boundary_of)(int dimension, int entity);

    // Discrete surfaces and what they enclose
    void (*add_discrete_entity)(int dimension, int tag);
    void (*add_nodes)(int dimension, int entity, const std::vector<std::size_t>& tags,
                      const std::vector<double>& coordinates);
    void (*add_elements)(int entity, int type, const std::vector<std::size_t>& nodes);
    /// Cuts the discrete surfaces into patches at edges sharper than `angle` [rad]; create_geometry gives each patch
    /// parameters
    void (*classify_surfaces)(double angle);
    void (*create_geometry)();
    void (*add_surface_loop)(const std::vector<int>& surfaces, int tag);
    void (*add_volume)(const std::vector<int>& surface_loops, int tag);
    void (*synchronize_discrete)();

    // Shapes of OpenCASCADE: the tag of the new one
    int (*add_disk)();  ///< of radius 1 about the origin
    int (*add_rectangle)(double width, double height);
    int (*add_box)(double x, double y, double z);
    int (*add_cylinder)(double bottom, double height);  ///< of radius 1 about the z axis
    int (*add_sphere)();                                ///< of radius 1 about the origin
    double (*mass)(int dimension, int tag);
    void (*centre_of_mass)(int dimension, int tag, double& x, double& y, double& z);
    void (*synchronize_shapes)();

    void (*set_size)(std::function<double(double x, double y, double z)> size);
    void (*generate_mesh)(int dimension);
    std::vector<int> (*element_types)(int dimension);
    void (*element_properties)(int type, std::string& name, int& order);
    void (*elements)(int dimension, int entity, std::vector<int>& types, std::vector<std::vector<std::size_t>>& tags,
                     std::vector<std::vector<std::size_t>>& nodes);
    void (*nodes)(std::vector<std::size_t>& tags, std::vector<double>& coordinates);
};

/// The library of Gmsh brings a hundred others along, and to load them takes longer than all else that a program starts
/// with: it is loaded at the first call. Throws MeshError where that fails.
[[nodiscard]] const GmshFunctions& gmsh();

}  // namespace abut::mesh
