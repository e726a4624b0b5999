#pragma once
// Private to the layer.
#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/input/formula.hpp"
#include "abut/input/given_keys.hpp"
#include "abut/input/given_meshes.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/run/options.hpp"
#include "abut/run/steps/preset.hpp"
#include "abut/run/values/outputs.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/options/erosion_limits.hpp"

/// Settings of a scene file, key by key and for both dimensions: of vectors in the plane z is 0, and turns are about z.
namespace abut::input {

/// Components of a vector that count in a dimension.
template <int Dim>
[[nodiscard]] Vector<Dim> head(const Vector<3>& vector) {
    return vector.head<Dim>();
}

/// A table of the file with a name of its own.
struct Named {
    std::string name;
    std::string where;  ///< Fault::where
};

/// A vector whose components may be formulas.
using FieldSettings = std::array<Formula, 3>;

enum class Shape { none, disc, fan_disc, gear, box, structured_box, cylinder, sphere, file, surface };

struct RefinementSettings {
    Vector<3> point = Vector<3>::Zero();  ///< [m]
    double size = 0.0;                    ///< [m]
    double distance = 0.0;                ///< [m]
    double uniform = 0.0;                 ///< [m]
};

/// Pieces that a body may break into, and what holds them together.
struct FractureSettings {
    double grain = 0.0;                                        ///< [m]
    double strength = 0.0;                                     ///< [Pa]
    double fracture_energy = 0.0;                              ///< [J/m^2]
    double weibull = std::numeric_limits<double>::infinity();  ///< modulus [-]
    int seed = 0;
};

/// A material that bodies may share.
struct MaterialSettings : Named {
    solid::Material material;
    std::shared_ptr<GivenKey> table{};  ///< read where a body is made of it
    GivenKeys given{};
};

struct BodySettings : Named {
    Shape shape = Shape::none;
    std::filesystem::path mesh;
    std::filesystem::path surface;
    double unit = 1.0;   ///< of the lengths of `surface` [m]
    double scale = 1.0;  ///< of `surface` [-]
    bool keep_triangles = false;
    mesh::NonPlanarFaces non_planar = mesh::NonPlanarFaces::fail;
    double planarity_tolerance = mesh::MeshOptions{}.planarity_tolerance;  ///< [-]
    double most_cells = run::not_given;
    double radius = 1.0;                  ///< [m]
    double length = 1.0;                  ///< [m]
    double size = 0.1;                    ///< [m]
    Vector<3> lower = Vector<3>::Zero();  ///< [m]
    Vector<3> upper = Vector<3>::Ones();  ///< [m]
    std::array<int, 3> counts{};
    std::optional<mesh::CellShape> cells;
    int sectors = 12;
    int teeth = 12;
    double bore = 0.1;                               ///< [m]
    double pressure_angle = std::numbers::pi / 9.0;  ///< [rad]
    double backlash = 0.0;                           ///< [m]
    int cells_per_tooth = 4;
    int variant = 0;
    std::optional<RefinementSettings> refinement;
    std::optional<FractureSettings> fracture;
    Vector<3> place = Vector<3>::Zero();  ///< [m]
    Vector<3> turn = Vector<3>::Zero();   ///< axis times angle [rad]
    std::string material_name;            ///< empty: all values are its own
    solid::Material material;
    solid::Kinematics kinematics = solid::Kinematics::small;
    Vector<3> velocity = Vector<3>::Zero();   ///< [m/s]
    Vector<3> spin = Vector<3>::Zero();       ///< [rad/s]
    std::optional<Formula> temperature_rise;  ///< of t, x, y, z [K]
    solid::ErosionLimits erosion;             ///< beyond which its cells leave
    bool has_material = false;                ///< Young's modulus and density are given
    std::optional<bool> self;                 ///< whether it touches itself; not given: as Settings::self says
    std::vector<BodySettings> parts;          ///< bodies of `mesh` or regions with a table of their own, by their names
    std::optional<Formula> region;            ///< of a part: not 0 where its cells have their centroids, in x, y, z [m]
    std::string pattern;                      ///< PatternSettings::path of that which made it; empty: none did
    std::string pattern_where;                ///< Fault::where
    double n_copies = 1.0;                    ///< that `pattern` makes
    GivenKeys given{};                        ///< its own and those of its material
};

/// Copies of a body in a row, a grid, a ring or at places.
struct PatternSettings {
    std::string where;  ///< Fault::where
    std::string path;   ///< "patterns[0]"
    std::string body;
    std::vector<int> count;           ///< of a grid one for each direction
    std::optional<Vector<3>> step;    ///< [m]
    std::optional<Vector<3>> shift;   ///< [m]
    std::optional<Vector<3>> centre;  ///< [m]
    std::optional<Vector<3>> angle;   ///< axis times angle [rad]
    std::vector<Vector<3>> places;    ///< [m]
    std::vector<Vector<3>> turns;     ///< axis times angle [rad]; none, or one for each of `places`
};

/// A plane that the scene is one half of: bodies are where its normal points to.
struct SymmetrySettings {
    std::string where;                     ///< Fault::where
    std::string path;                      ///< "symmetry[0]"
    Vector<3> point = Vector<3>::Zero();   ///< [m]
    Vector<3> normal = Vector<3>::Zero();  ///< [-]
};

enum class ObstacleShape { none, plane, box, polygon, surface };

struct ObstacleSettings : Named {
    ObstacleShape shape = ObstacleShape::none;
    Vector<3> point = Vector<3>::Zero();                          ///< [m]
    Vector<3> normal = Vector<3>::Zero();                         ///< [-]
    double half_width = std::numeric_limits<double>::infinity();  ///< [m]
    Vector<3> lower = Vector<3>::Zero();                          ///< [m]
    Vector<3> upper = Vector<3>::Ones();                          ///< [m]
    std::vector<Vector<3>> corners;                               ///< [m]
    std::filesystem::path surface;
    double unit = 1.0;   ///< of the lengths of `surface` [m]
    double scale = 1.0;  ///< of `surface` [-]
    bool inside = false;
    Vector<3> place = Vector<3>::Zero();     ///< [m]
    Vector<3> turn = Vector<3>::Zero();      ///< axis times angle [rad]
    Vector<3> velocity = Vector<3>::Zero();  ///< [m/s]
    std::optional<FieldSettings> path;       ///< [m]
    Vector<3> spin = Vector<3>::Zero();      ///< [rad/s]
    std::optional<FieldSettings> rotation;   ///< axis times angle [rad]
    std::optional<Vector<3>> pivot;          ///< [m]; not given: the middle of the box around it
    bool is_symmetry = false;                ///< the other half of the scene, for contact: it has no friction
};

struct SupportSettings : Named {
    std::string group;
    solid::Constraint constraint = solid::Constraint::full;
    std::array<bool, 3> components{};
    FieldSettings value;  ///< [m]
};

struct TractionSettings : Named {
    std::string group;
    std::optional<FieldSettings> value;  ///< [Pa]
    std::optional<Formula> pressure;     ///< [Pa], instead of `value`
    std::optional<bool> follows;
};

struct AnchorSettings {
    std::string where;                    ///< Fault::where
    std::string body;                     ///< empty: the ground
    Vector<3> point = Vector<3>::Zero();  ///< [m]
    double radius = 0.0;                  ///< [m]
    GivenKeys given{};
};

struct SpringSettings : Named {
    AnchorSettings from;
    AnchorSettings to;
    double stiffness = 0.0;          ///< [N/m]
    double length = run::not_given;  ///< [m]; not given: the distance of its ends
    double damping = 0.0;            ///< [N s/m]
};

struct MomentSettings : Named {
    std::string body;
    std::optional<FieldSettings> value;  ///< of t [N m]
    double damping = 0.0;                ///< [N m s]
};

/// Names of bodies or obstacles.
struct IgnoredPair {
    std::array<std::string, 2> names;
    std::string where;  ///< Fault::where
};

/// Overlap at the start: an error, or resolved over a time.
enum class Interference { refuse, resolve };

/// Settings of what acts between two bodies, obstacles or groups of boundary faces: `bodies` and `groups` together name two.
struct PairSettings {
    std::vector<std::string> bodies;  // or obstacles
    std::vector<std::string> groups;
    std::string where;  ///< Fault::where
    contact::Friction friction;
    bool has_friction = false;  ///< a law of its own is given
    Interference interference = Interference::refuse;
    double interference_time = 0.0;  ///< [s]; 0: not given
    GivenKeys given{};
};

/// Two bodies or groups of boundary faces that are glued: `bodies` and `groups` together name two.
struct BondSettings {
    std::vector<std::string> bodies;
    std::vector<std::string> groups;
    std::string where;                                          ///< Fault::where
    double strength = std::numeric_limits<double>::infinity();  ///< [Pa]
    double fracture_energy = 0.0;                               ///< [J/m^2]
    bool is_of_copies = false;                                  ///< one of many, of which those hold that touch at rest
    GivenKeys given{};
};

struct ProbeSettings : Named {
    std::string body;
    std::optional<Vector<3>> point;  ///< [m]
    bool in_body = false;            ///< whether `point` is seen from the body, before it is turned and placed
    bool contact = false;
    GivenKeys given{};
};

struct Settings {
    std::filesystem::path file;
    std::vector<std::string> set;               ///< values that replace those of the file, as given
    std::shared_ptr<const GivenMeshes> meshes;  ///< null: none
    std::string title;
    std::string comment;
    int dim = 0;                            ///< 2 or 3; 0: not known
    Vector<3> gravity = Vector<3>::Zero();  ///< [m/s^2]
    double energy_scale = 0.0;              ///< [J]
    bool contact = true;
    bool self = false;  ///< of [contact]: whether bodies touch themselves that do not say so
    std::vector<IgnoredPair> ignored_pairs;
    std::vector<PairSettings> pairs;
    std::vector<BondSettings> bonds;
    std::vector<MaterialSettings> materials;
    std::vector<BodySettings> bodies;
    std::vector<PatternSettings> patterns;
    std::vector<SymmetrySettings> symmetries;
    std::vector<ObstacleSettings> obstacles;
    std::vector<SupportSettings> supports;
    std::vector<TractionSettings> tractions;
    std::vector<SpringSettings> springs;
    std::vector<MomentSettings> moments;
    std::vector<ProbeSettings> probes;
    bool forces = false;
    int sample_interval = 0;
    run::FrameFields fields;
    std::optional<run::Preset> preset;  ///< in the options already
    run::RunOptions options;
    GivenKeys given{};  ///< of no table, [run], [contact] and [output], by their paths: "contact.friction"
};

}  // namespace abut::input
