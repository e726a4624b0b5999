#include "abut/mesh/shapes/surface_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "abut/base/messages.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/surface_builder.hpp"

namespace abut::mesh {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

using Ring = std::vector<std::int32_t>;
using Plane = Vector<2>;

Plane on_circle(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

Ring add_ring(SurfaceBuilder& builder, const std::vector<Plane>& points, double z) {
    Ring ring;
    for (const Plane& x : points) ring.push_back(builder.add_vertex({x.x(), x.y(), z}));
    return ring;
}

void check(const TorusOptions& o) {
    require_length(o.name, "radius", o.radius);
    require_length(o.name, "tube_radius", o.tube_radius);
    require_less(o.name, "tube_radius", o.tube_radius, "radius", o.radius);
    require_count(o.name, "n_around", o.n_around, 3);
    require_count(o.name, "n_tube", o.n_tube, 3);
    require_size(o.name, 2.0 * o.n_around * o.n_tube);
    require_axis(o.name, o.axis);
    require_finite(o.name, "centre", o.centre);
}

void check(const GearOptions& o) {
    require_length(o.name, "bore_radius", o.bore_radius);
    require_length(o.name, "tip_radius", o.tip_radius);
    require_length(o.name, "thickness", o.thickness);
    require_less(o.name, "bore_radius", o.bore_radius, "root_radius", o.root_radius);
    require_less(o.name, "root_radius", o.root_radius, "tip_radius", o.tip_radius);
    if (!(o.tooth_share > 0.0 && o.tooth_share < 0.5))
        throw MeshError(o.name + ": tooth_share is " + number(o.tooth_share) +
                        ", more than 0 and less than 0.5 is needed. Change the argument.");
    if (!std::isfinite(o.turn))
        throw MeshError(o.name + ": turn is " + number(o.turn) + " rad, a finite angle is needed. Change the argument.");
    require_count(o.name, "n_teeth", o.n_teeth, 3);
    require_count(o.name, "n_flank", o.n_flank, 1);
    require_count(o.name, "n_radial", o.n_radial, 1);
    require_count(o.name, "n_axial", o.n_axial, 1);
    require_size(o.name, 16.0 * o.n_teeth * o.n_flank * (o.n_radial + o.n_axial));
    require_axis(o.name, o.axis);
    require_finite(o.name, "centre", o.centre);
}

/// Tooth by tooth: up, along the tip, down, along the root; straight lines of n_flank pieces.
std::vector<Plane> gear_outline(const GearOptions& o) {
    std::vector<Plane> corners;
    const double pitch = two_pi / o.n_teeth;
    for (int tooth = 0; tooth < o.n_teeth; ++tooth) {
        const double middle = o.turn + pitch * tooth;
        corners.push_back(on_circle(o.root_radius, middle - o.tooth_share * pitch));
        corners.push_back(on_circle(o.tip_radius, middle - 0.5 * o.tooth_share * pitch));
        corners.push_back(on_circle(o.tip_radius, middle + 0.5 * o.tooth_share * pitch));
        corners.push_back(on_circle(o.root_radius, middle + o.tooth_share * pitch));
    }
    std::vector<Plane> outline;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (int k = 0; k < o.n_flank; ++k) {
            const double t = static_cast<double>(k) / o.n_flank;
            outline.push_back((1.0 - t) * corners[i] + t * corners[(i + 1) % corners.size()]);
        }
    return outline;
}

/// The outline shrunk towards the bore: t = 0 at the bore, 1 at the outline.
std::vector<Plane> between(const std::vector<Plane>& bore, const std::vector<Plane>& outline, double t) {
    std::vector<Plane> ring;
    for (std::size_t i = 0; i < bore.size(); ++i) ring.push_back((1.0 - t) * bore[i] + t * outline[i]);
    return ring;
}

void check(const SheetOptions& o) {
    require_length(o.name, "size_x", o.size_x);
    require_length(o.name, "size_y", o.size_y);
    if (!(o.amplitude >= 0.0) || !std::isfinite(o.amplitude) || !std::isfinite(o.n_waves))
        throw MeshError(o.name + ": amplitude is " + number(o.amplitude) + " m with " + number(o.n_waves) +
                        " waves, a finite length from 0 on and a finite number are needed. Change the arguments.");
    require_count(o.name, "n_x", o.n_x, 1);
    require_count(o.name, "n_y", o.n_y, 1);
    require_size(o.name, 2.0 * o.n_x * o.n_y);
    require_finite(o.name, "corner", o.corner);
}

void check(const BarrelOptions& o) {
    require_length(o.name, "radius", o.radius);
    require_length(o.name, "length", o.length);
    require_count(o.name, "n_side", o.n_side, 1);
    require_count(o.name, "n_along", o.n_along, 1);
    require_size(o.name, 8.0 * o.n_side * o.n_along + 4.0 * o.n_side * o.n_side);
    require_axis(o.name, o.axis);
    require_finite(o.name, "centre", o.centre);
}

/// Point (i, j) of the grid from -n to n in steps of 2, on the disc: squares around the middle become circles, evenly
/// divided.
Plane on_disc(double radius, int n, int i, int j) {
    const int square = std::max(std::abs(i), std::abs(j));
    if (square == 0) return Plane::Zero();
    double eighths = 0.0;  // of the way around its square, from the middle of the right side
    if (i == square && j != -square)
        eighths = static_cast<double>(j) / square;
    else if (j == square)
        eighths = 2.0 - static_cast<double>(i) / square;
    else if (i == -square)
        eighths = 4.0 - static_cast<double>(j) / square;
    else
        eighths = 6.0 + static_cast<double>(i) / square;
    return on_circle(radius * square / n, 0.25 * std::numbers::pi * eighths);
}

/// The grid on the rim, counter-clockwise from the corner at the lower right.
std::vector<std::array<int, 2>> rim_of_grid(int n) {
    std::vector<std::array<int, 2>> rim;
    for (int k = -n; k < n; k += 2) rim.push_back({n, k});
    for (int k = -n; k < n; k += 2) rim.push_back({-k, n});
    for (int k = -n; k < n; k += 2) rim.push_back({-n, -k});
    for (int k = -n; k < n; k += 2) rim.push_back({k, -n});
    return rim;
}

std::vector<Plane> rim_of_disc(double radius, int n) {
    std::vector<Plane> rim;
    for (const auto& [i, j] : rim_of_grid(n)) rim.push_back(on_disc(radius, n, i, j));
    return rim;
}

/// A disc at z whose rim is there already; its triangles run counter-clockwise seen from +z, or from -z.
void add_cap(SurfaceBuilder& builder, const Ring& rim, double radius, double z, int n, bool faces_up) {
    std::vector<std::int32_t> grid(static_cast<std::size_t>((n + 1) * (n + 1)), -1);
    const auto place = [n](int i, int j) { return static_cast<std::size_t>((i + n) / 2 * (n + 1) + (j + n) / 2); };
    const auto edge = rim_of_grid(n);
    for (std::size_t k = 0; k < edge.size(); ++k) grid[place(edge[k][0], edge[k][1])] = rim[k];
    const auto vertex = [&](int i, int j) {
        std::int32_t& index = grid[place(i, j)];
        if (index < 0) {
            const Plane x = on_disc(radius, n, i, j);
            index = builder.add_vertex({x.x(), x.y(), z});
        }
        return index;
    };
    for (int i = -n; i < n; i += 2)
        for (int j = -n; j < n; j += 2) {
            std::array corners = {vertex(i, j), vertex(i + 2, j), vertex(i + 2, j + 2), vertex(i, j + 2)};
            if (!faces_up) std::swap(corners[1], corners[3]);
            const bool is_cut_from_first = (i + 1 >= 0) == (j + 1 >= 0);  // towards the middle, so that no corner is cut off
            if (is_cut_from_first)
                builder.add_quadrangle(corners[0], corners[1], corners[2], corners[3]);
            else
                builder.add_quadrangle(corners[1], corners[2], corners[3], corners[0]);
        }
}

}  // namespace

SurfaceMesh torus_surface(const TorusOptions& options) {
    check(options);
    SurfaceBuilder builder(options.name, options.centre, options.axis);
    std::vector<Ring> rings(static_cast<std::size_t>(options.n_around));
    for (std::size_t i = 0; i < rings.size(); ++i) {
        const double u = two_pi * static_cast<double>(i) / options.n_around;
        for (int j = 0; j < options.n_tube; ++j) {
            const Plane tube = on_circle(options.tube_radius, two_pi * j / options.n_tube);
            const Plane x = on_circle(options.radius + tube.x(), u);
            rings[i].push_back(builder.add_vertex({x.x(), x.y(), tube.y()}));
        }
    }
    for (std::size_t i = 0; i < rings.size(); ++i) builder.add_band(rings[(i + 1) % rings.size()], rings[i]);
    return std::move(builder).mesh();
}

SurfaceMesh gear_surface(const GearOptions& options) {
    check(options);
    SurfaceBuilder builder(options.name, options.centre, options.axis);
    const std::vector<Plane> outline = gear_outline(options);
    std::vector<Plane> bore;
    for (const Plane& x : outline) bore.push_back(options.bore_radius * x.normalized());
    // Around the section: up the outline, in over the top, down the bore, out over the bottom.
    std::vector<Ring> rings;
    const auto add = [&](double t, double height) {
        rings.push_back(add_ring(builder, between(bore, outline, t), (height - 0.5) * options.thickness));
    };
    for (int k = 0; k < options.n_axial; ++k) add(1.0, static_cast<double>(k) / options.n_axial);
    for (int k = 0; k < options.n_radial; ++k) add(1.0 - static_cast<double>(k) / options.n_radial, 1.0);
    for (int k = 0; k < options.n_axial; ++k) add(0.0, 1.0 - static_cast<double>(k) / options.n_axial);
    for (int k = 0; k < options.n_radial; ++k) add(static_cast<double>(k) / options.n_radial, 0.0);
    for (std::size_t i = 0; i < rings.size(); ++i) builder.add_band(rings[i], rings[(i + 1) % rings.size()]);
    return std::move(builder).mesh();
}

SurfaceMesh sheet_surface(const SheetOptions& options) {
    check(options);
    SurfaceBuilder builder(options.name, options.corner, 2);
    const auto vertex = [&](int i, int j) { return static_cast<std::int32_t>(i * (options.n_y + 1) + j); };
    for (int i = 0; i <= options.n_x; ++i)
        for (int j = 0; j <= options.n_y; ++j) {
            const double s = static_cast<double>(i) / options.n_x, t = static_cast<double>(j) / options.n_y;
            const double wave = std::sin(two_pi * options.n_waves * s) * std::cos(two_pi * options.n_waves * t);
            builder.add_vertex({s * options.size_x, t * options.size_y, options.amplitude * wave});
        }
    for (int i = 0; i < options.n_x; ++i)
        for (int j = 0; j < options.n_y; ++j)
            builder.add_quadrangle(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    return std::move(builder).mesh();
}

SurfaceMesh barrel_surface(const BarrelOptions& options) {
    check(options);
    SurfaceBuilder builder(options.name, options.centre, options.axis);
    const std::vector<Plane> rim = rim_of_disc(options.radius, options.n_side);
    std::vector<Ring> rings;
    for (int k = 0; k <= options.n_along; ++k)
        rings.push_back(add_ring(builder, rim, (static_cast<double>(k) / options.n_along - 0.5) * options.length));
    for (std::size_t k = 0; k + 1 < rings.size(); ++k) builder.add_band(rings[k], rings[k + 1]);
    if (options.closed) {
        add_cap(builder, rings.back(), options.radius, 0.5 * options.length, options.n_side, true);
        add_cap(builder, rings.front(), options.radius, -0.5 * options.length, options.n_side, false);
    }
    return std::move(builder).mesh();
}

}  // namespace abut::mesh
