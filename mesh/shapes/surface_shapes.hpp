#pragma once
#include <cstdint>
#include <string>

#include "abut/mesh/surface_mesh.hpp"

namespace abut::mesh {

// Surfaces made by formula, of triangles, outward, one body each; those called closed are watertight. The same everywhere up
// to the rounding of sin and cos. All throw MeshError naming the argument, its value and what is allowed, for lengths that
// are not finite and > 0, counts below their least or beyond mesh::max_surface_faces triangles, an axis other than 0, 1, 2.
// `axis` is that of rotation: 0, 1 or 2 for x, y, z.

inline constexpr std::int32_t max_surface_faces = 200'000'000;

struct TorusOptions {
    Vector<3> centre = Vector<3>::Zero();
    double radius = 1.0;       ///< R [m], of the circle within the tube
    double tube_radius = 0.3;  ///< r [m], < R
    int n_around = 48;         ///< around the axis, at least 3
    int n_tube = 16;           ///< around the tube, at least 3
    int axis = 2;
    std::string name = "torus";
};
/// Closed, genus 1, 2 n_around n_tube triangles; volume 2 pi^2 R r^2 less O(1/n^2).
[[nodiscard]] SurfaceMesh torus_surface(const TorusOptions& options);

struct GearOptions {
    Vector<3> centre = Vector<3>::Zero();
    int n_teeth = 20;          ///< at least 3
    double bore_radius = 0.3;  ///< [m]
    double root_radius = 0.8;  ///< [m], > bore_radius
    double tip_radius = 1.0;   ///< [m], > root_radius
    double tooth_share = 0.3;  ///< of the pitch at the tip; the foot has twice that; in (0, 0.5)
    double thickness = 0.2;    ///< [m] along the axis
    int n_flank = 2;           ///< pieces of each of the four straight lines of a tooth's outline, at least 1
    int n_radial = 3;          ///< rings between bore and outline, at least 1
    int n_axial = 4;           ///< layers along the axis, at least 1
    double turn = 0.0;         ///< angle of the middle of the first tooth [rad]
    int axis = 2;
    std::string name = "gear";
};
/// A wheel with straight flanks and a bore. Closed, genus 1, 16 n_teeth n_flank (n_radial + n_axial) triangles. Where
/// outline and bore run along straight lines the volume is exact: thickness (area of the outline - area of the bore's
/// polygon).
[[nodiscard]] SurfaceMesh gear_surface(const GearOptions& options);

struct SheetOptions {
    Vector<3> corner = Vector<3>::Zero();
    double size_x = 1.0, size_y = 1.0;  ///< [m]
    int n_x = 32, n_y = 32;             ///< cells, at least 1
    double amplitude = 0.05;            ///< of the waves [m], >= 0
    double n_waves = 3.0;               ///< along each side, finite
    std::string name = "sheet";
};
/// Open, facing z: z = amplitude sin(2 pi n_waves x / size_x) cos(2 pi n_waves y / size_y); 2 n_x n_y triangles.
[[nodiscard]] SurfaceMesh sheet_surface(const SheetOptions& options);

struct BarrelOptions {
    Vector<3> centre = Vector<3>::Zero();
    double radius = 1.0;
    double length = 2.0;  ///< along the axis [m]
    int n_side = 8;       ///< a quarter of the triangles' edges around the axis, at least 1
    int n_along = 16;     ///< at least 1
    bool closed = true;   ///< with caps
    int axis = 2;
    std::string name = "barrel";
};
/// A circular cylinder. 8 n_side n_along triangles on the side and 2 n_side^2 on each cap, whose n_side x n_side grid is
/// mapped to the disc ring by ring: no fan. Volume: length times the regular polygon of 4 n_side corners.
[[nodiscard]] SurfaceMesh barrel_surface(const BarrelOptions& options);

struct SphereSurfaceOptions {
    Vector<3> centre = Vector<3>::Zero();
    double radius = 1.0;
    int n_subdivisions = 4;  ///< of an icosahedron, 0 to 11
    std::string name = "sphere";
};
/// Closed, 20 4^n triangles with their corners on the sphere.
[[nodiscard]] SurfaceMesh sphere_surface(const SphereSurfaceOptions& options);

struct RandomTrianglesOptions {
    int n = 1000;  ///< at least 1
    std::uint64_t seed = 1;
    Vector<3> lower = Vector<3>::Zero();
    double box_size = 1.0;  ///< side of the cube of their centres [m]
    double size = 0.05;     ///< side of the cube around its centre in which the corners of a triangle lie [m]
    std::string name = "random triangles";
};
/// Triangles that share no vertex, corners evenly distributed. The same bits for a seed everywhere (a splitmix64 of our
/// own).
[[nodiscard]] SurfaceMesh random_triangles(const RandomTrianglesOptions& options);

}  // namespace abut::mesh
