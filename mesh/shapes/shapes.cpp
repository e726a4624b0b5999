#include "abut/mesh/shapes/shapes.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include "abut/base/messages.hpp"
#include "abut/base/rotation.hpp"
#include "abut/mesh/io/gmsh_functions.hpp"
#include "abut/mesh/io/gmsh_session.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/arguments.hpp"
#include "abut/mesh/shapes/estimate.hpp"

namespace abut::mesh {
namespace {

constexpr double golden_angle = 2.0 * std::numbers::pi * (2.0 - std::numbers::phi);
/// Above this many expected tetrahedra HXT takes over from Gmsh's Delaunay mesher, which needs half a minute there. Not
/// below: HXT gives another mesh each time it runs, even with one thread and a fixed seed.
constexpr double many_tetrahedra = 4e5;
constexpr int frontal_delaunay_2d = 6, delaunay_3d = 1, hxt_3d = 10;

template <class Options>
void check_common(const Options& options) {
    require_length(options.name, "size", options.size);
    require_count(options.name, "variant", options.variant, 0);
    if (!options.refinement) return;
    require_length(options.name, "refinement.size", options.refinement->size);
    require_length(options.name, "refinement.distance", options.refinement->distance);
    require_finite(options.name, "refinement.point", options.refinement->point);
    require_length_or_zero(options.name, "refinement.uniform", options.refinement->uniform);
    if (options.refinement->size > options.size)
        throw MeshError(options.name + ": refinement.size is " + number(options.refinement->size) + " m, at most size = " +
                        number(options.size) + " m is allowed. Lower it, or leave the refinement out.");
}

/// By what factor wanted sizes rise and fall along the edges of a box: nodes of another phase lie elsewhere.
template <int Dim>
struct Waves {
    Vector<Dim> sides;  ///< of the box, one corner of which is the origin
    double phase;       ///< [rad]

    [[nodiscard]] double operator()(const Vector<Dim>& x) const {
        // The mean of f^-Dim over a wave f, to second order: as many cells as without.
        constexpr double height = 0.1, more_cells = 1.0 + 0.25 * Dim * (Dim + 1) * height * height;
        double sum = 0.0;
        for (int i = 0; i < Dim; ++i) sum += std::sin(2.0 * std::numbers::pi * x[i] / sides[i] + phase);
        return std::pow(more_cells, 1.0 / Dim) * (1.0 + height * sum / std::sqrt(static_cast<double>(Dim)));
    }
};

/// Wanted cell size as a function of place.
template <int Dim>
struct SizeField {
    double size;
    std::optional<Refinement<Dim>> refinement;
    std::optional<Waves<Dim>> waves = {};

    [[nodiscard]] double operator()(const Vector<Dim>& x) const { return waves ? (*waves)(x)*even(x) : even(x); }
    /// Without waves.
    [[nodiscard]] double even(const Vector<Dim>& x) const {
        if (!refinement) return size;
        const double way =
            std::clamp(((x - refinement->point).norm() - refinement->uniform) / refinement->distance, 0.0, 1.0);
        return refinement->size + way * (size - refinement->size);
    }
};

template <int Dim>
void set_size(const SizeField<Dim>& field) {
    gmsh().set_option("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh().set_option("Mesh.MeshSizeFromPoints", 0);
    gmsh().set_size([field](double x, double y, double z) {
        Vector<3> point(x, y, z);
        return field(point.head<Dim>());
    });
}

/// About how many cells a part of this volume (area in 2D) gets. Of the refined ball half is taken to lie in the part: its
/// centre is on the surface as a rule.
template <int Dim>
double expected_cells(const SizeField<Dim>& field, double volume) {
    double units = volume / std::pow(field.size, Dim);
    if (field.refinement) {
        constexpr int n_shells = 1000;
        const double thickness = (field.refinement->uniform + field.refinement->distance) / n_shells;
        double rest = volume;
        for (int i = 0; i < n_shells; ++i) {
            const double radius = (i + 0.5) * thickness;
            const double half_shell = std::numbers::pi * (Dim == 2 ? radius : 2.0 * radius * radius) * thickness;
            const double inside = std::min(half_shell, rest);
            const Vector<Dim> at = field.refinement->point + radius * Vector<Dim>::UnitX();
            units += inside * (std::pow(field.even(at), -Dim) - std::pow(field.size, -Dim));
            rest -= inside;
        }
    }
    return cells_in_unit<Dim> * units;
}

template <int Dim>
void choose_algorithms(const std::string& name, const SizeField<Dim>& field, double volume, const MeshOptions& options) {
    const double cells = expected_cells(field, volume);
    check_estimate(
        name, cells, most_meshed_cells, options,
        field.refinement ? "Raise size or refinement.size, lower refinement.distance or refinement.uniform" : "Raise size");
    gmsh().set_option("Mesh.Algorithm", frontal_delaunay_2d);
    gmsh().set_option("Mesh.Algorithm3D", Dim == 3 && cells > many_tetrahedra ? hxt_3d : delaunay_3d);
    gmsh().set_option("Mesh.Optimize", 1);
}

/// Name of the boundary group that the surface (3D) or curve (2D) with this centre of mass belongs to.
using NameOfSide = std::function<std::string(const Vector<3>& centre)>;

template <int Dim>
void name_parts(int tag, const std::string& body_name, const NameOfSide& name_of_side) {
    gmsh().set_physical_name(Dim, gmsh().add_physical_group(Dim, {tag}), body_name);
    std::vector<std::pair<std::string, std::vector<int>>> groups;
    for (const auto& [dimension, side] : gmsh().boundary_of(Dim, tag)) {
        Vector<3> centre;
        gmsh().centre_of_mass(dimension, side, centre[0], centre[1], centre[2]);
        const std::string name = name_of_side(centre);
        if (groups.empty() || std::none_of(groups.begin(), groups.end(), [&](auto& g) { return g.first == name; }))
            groups.push_back({name, {}});
        for (auto& group : groups)
            if (group.first == name) group.second.push_back(side);
    }
    for (const auto& [name, tags] : groups)
        gmsh().set_physical_name(Dim - 1, gmsh().add_physical_group(Dim - 1, tags), name);
}

/// Meshes the part that `add_part` adds to an empty OpenCASCADE model; it returns the tag of its volume (surface in 2D).
/// Gmsh and OpenCASCADE measure with lengths of their own (1e-7 and the like): the part must be of about unit size.
template <int Dim>
CellSoup<Dim> meshed_part(const std::string& name, const SizeField<Dim>& field, const std::function<int()>& add_part,
                          const NameOfSide& name_of_side, const MeshOptions& options) {
    const GmshSession session;
    CellSoup<Dim> soup;
    session.run(name, "meshing failed", "Change size or refinement.", [&] {
        const int tag = add_part();
        gmsh().synchronize_shapes();
        name_parts<Dim>(tag, name, name_of_side);
        choose_algorithms(name, field, gmsh().mass(Dim, tag), options);
        set_size(field);
        gmsh().generate_mesh(Dim);
        soup = soup_of_gmsh_model<Dim>(name);
    });
    soup.n_ignored_elements = 0;  // points and edges of our own model, not something a user gave
    soup.vertex_label.clear();
    soup.cell_label.clear();
    return soup;
}

/// From the frame and the unit in which Gmsh meshes a part to where it belongs: x -> origin + turn (unit x).
template <int Dim>
struct Placement {
    double unit;  ///< [m]
    Vector<Dim> origin;
    Matrix<Dim> turn = Matrix<Dim>::Identity();
};

/// Meshes the part in units of its own size, not turned yet and around the origin, then puts the vertices in their place.
template <int Dim>
Mesh<Dim> placed_part(const std::string& name, const Placement<Dim>& placement, SizeField<Dim> field,
                      const std::function<int()>& add_part, const NameOfSide& name_of_side,
                      const MeshOptions& mesh_options) {
    const auto& [unit, origin, turn] = placement;
    field.size /= unit;
    if (auto& refinement = field.refinement) {
        refinement->point = turn.transpose() * (refinement->point - origin) / unit;
        refinement->size /= unit;
        refinement->distance /= unit;
        refinement->uniform /= unit;
    }
    auto soup = meshed_part<Dim>(name, field, add_part, name_of_side, mesh_options);
    for (Vector<Dim>& vertex : soup.vertices) vertex = origin + turn * (unit * vertex);
    return build_mesh(std::move(soup), mesh_options);
}

Matrix<3> turn_about(const Vector<3>& axis, int variant) {
    return rotation_about(axis.normalized(), variant * golden_angle);
}

/// Name of the side of a box with one corner at the origin.
template <int Dim>
std::string side_of_box(const Vector<3>& centre, const Vector<Dim>& sides) {
    static const std::array<std::string, 6> names = {"xmin", "xmax", "ymin", "ymax", "zmin", "zmax"};
    std::size_t best = 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 2 * Dim; ++i) {
        const double distance = std::abs(centre[i / 2] - (i % 2 == 0 ? 0.0 : sides[i / 2]));
        if (distance >= smallest) continue;
        smallest = distance;
        best = static_cast<std::size_t>(i);
    }
    return names[best];
}

}  // namespace

Mesh<2> disc(const DiscOptions& options, const MeshOptions& mesh_options) {
    check_common(options);
    require_finite(options.name, "centre", options.centre);
    require_length(options.name, "radius", options.radius);
    const Matrix<2> turn = turn_about(Vector<3>::UnitZ(), options.variant).topLeftCorner<2, 2>();
    return placed_part<2>(
        options.name, {options.radius, options.centre, turn}, {options.size, options.refinement},
        [] { return gmsh().add_disk(); }, [](const Vector<3>&) { return "boundary"; }, mesh_options);
}

Mesh<3> cylinder(const CylinderOptions& options, const MeshOptions& mesh_options) {
    check_common(options);
    require_finite(options.name, "centre", options.centre);
    require_length(options.name, "radius", options.radius);
    require_length(options.name, "length", options.length);
    const double length = options.length / options.radius, half = 0.5 * length;
    const auto side = [half](const Vector<3>& at) {
        return at.z() < -0.5 * half ? "bottom" : at.z() > 0.5 * half ? "top" : "side";
    };
    return placed_part<3>(
        options.name, {options.radius, options.centre, turn_about(Vector<3>::UnitZ(), options.variant)},
        {options.size, options.refinement}, [&] { return gmsh().add_cylinder(-half, length); }, side, mesh_options);
}

Mesh<3> sphere(const SphereOptions& options, const MeshOptions& mesh_options) {
    check_common(options);
    require_finite(options.name, "centre", options.centre);
    require_length(options.name, "radius", options.radius);
    const Vector<3> skew(1.0, std::numbers::sqrt2, std::numbers::pi);
    return placed_part<3>(
        options.name, {options.radius, options.centre, turn_about(skew, options.variant)},
        {options.size, options.refinement}, [] { return gmsh().add_sphere(); }, [](const Vector<3>&) { return "boundary"; },
        mesh_options);
}

template <int Dim>
Mesh<Dim> box(const BoxOptions<Dim>& options, const MeshOptions& mesh_options) {
    check_common(options);
    require_finite(options.name, "lower", options.lower);
    require_finite(options.name, "upper", options.upper);
    const Vector<Dim> sides = options.upper - options.lower;
    require_length(options.name, "shortest side", sides.minCoeff());
    const double unit = sides.maxCoeff();
    const Vector<Dim> relative = sides / unit;
    std::optional<Waves<Dim>> waves;
    if (options.variant > 0) waves = Waves<Dim>{relative, options.variant * golden_angle};
    const auto add_part = [&] {
        if constexpr (Dim == 2)
            return gmsh().add_rectangle(relative[0], relative[1]);
        else
            return gmsh().add_box(relative[0], relative[1], relative[2]);
    };
    const auto side = [&](const Vector<3>& centre) { return side_of_box<Dim>(centre, relative); };
    return placed_part<Dim>(options.name, {unit, options.lower}, {options.size, options.refinement, waves}, add_part, side,
                            mesh_options);
}

template Mesh<2> box<2>(const BoxOptions<2>&, const MeshOptions&);
template Mesh<3> box<3>(const BoxOptions<3>&, const MeshOptions&);

}  // namespace abut::mesh
