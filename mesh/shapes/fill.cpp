#include "abut/mesh/shapes/fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/base/index.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/health/surface_health.hpp"
#include "abut/geometry/triangulate.hpp"
#include "abut/mesh/io/gmsh_functions.hpp"
#include "abut/mesh/io/gmsh_session.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/arguments.hpp"
#include "abut/mesh/shapes/estimate.hpp"

namespace abut::mesh {
namespace {

constexpr int gmsh_triangle = 2, surface_tag = 1, volume_tag = 1;
constexpr int mesher_2d = 1, mesher_3d = 1;  // MeshAdapt and Delaunay: same bits each time, and the fewest slivers
constexpr double least_quality = 0.5;        // in Gmsh's measure, of cells that are not optimised
constexpr double sharp_edge = 40.0 * std::numbers::pi / 180.0;
constexpr double least_volume = 0.5, good_volume = 0.9;  // of the cells, over that inside the surface

void refuse(const SurfaceMesh& surface, const std::string& what) {
    throw MeshError(surface.name + ": " + what +
                    " A body is filled where one closed surface is around it. Mend the file; abut detect says what "
                    "else is wrong with it.");
}

void check_closed(const SurfaceMesh& surface) {
    const auto health = geometry::check_surface(surface.soup());
    const auto require_none = [&](std::size_t n, const char* one, const char* several, const std::string& of_what) {
        if (n > 0) refuse(surface, counted(std::int64_t(n), one, several) + " " + of_what + ", 0 are allowed.");
    };
    require_none(health.unusable_faces.size(), "face", "faces", "cannot be used");
    require_none(health.boundary_edges.size(), "edge belongs", "edges belong", "to one face alone");
    require_none(health.non_manifold_edges.size(), "edge belongs", "edges belong", "to more than two faces");
    require_none(health.inconsistent_edges.size(), "edge is", "edges are", "run along the same way by both faces beside it");
    const std::vector<bool> cavities = cavities_of(surface, health);
    if (const std::ptrdiff_t n = std::ranges::count(cavities, false); n != 1)
        throw MeshError(surface.name + ": it has " + std::to_string(n) +
                        " outer surfaces, and one with its cavities is filled. Give each a file and a body of its own. A "
                        "cavity looks the other way than the surface around it: turn its faces around.");
}

/// Surface whose polygons are cut into triangles; all faces must be usable.
SurfaceMesh in_triangles(const SurfaceMesh& surface) {
    SurfaceMesh cut = surface;
    cut.faces = {};
    cut.face_body.clear();
    cut.face_label.clear();
    const auto append = [&](std::int32_t face, std::array<std::int32_t, 3> corners) {
        cut.faces.append(corners);
        cut.face_body.push_back(surface.face_body[static_cast<std::size_t>(face)]);
        cut.face_label.push_back(surface.label(face));
    };
    for (std::int32_t face = 0; face < surface.faces.size(); ++face) {
        const auto corners = surface.faces[face];
        std::vector<Vector<3>> points;
        for (const std::int32_t v : corners) points.push_back(surface.vertices[static_cast<std::size_t>(v)]);
        if (corners.size() == 3)
            append(face, {corners[0], corners[1], corners[2]});
        else
            for (const auto& [a, b, c] : geometry::cut_into_triangles(points))
                append(face, {corners[static_cast<std::size_t>(a)], corners[static_cast<std::size_t>(b)],
                              corners[static_cast<std::size_t>(c)]});
    }
    return cut;
}

/// Closed, of triangles, and with one vertex at each place, whatever the file has.
SurfaceMesh prepared(SurfaceMesh surface) {
    weld(surface);
    check_closed(surface);
    return in_triangles(surface);
}

struct Measures {
    double volume = 0.0, area = 0.0;
};
Measures measures_of(const SurfaceMesh& surface) {
    Measures measures;
    const Vector<3>& origin = surface.vertices[static_cast<std::size_t>(surface.faces.values.front())];
    const auto corner = [&](std::int32_t face, std::size_t i) {
        return Vector<3>(surface.vertices[static_cast<std::size_t>(surface.faces[face][i])] - origin);
    };
    for (std::int32_t face = 0; face < surface.faces.size(); ++face) {
        const Vector<3> a = corner(face, 0), b = corner(face, 1), c = corner(face, 2);
        measures.volume += a.dot(b.cross(c)) / 6.0;
        measures.area += 0.5 * (b - a).cross(c - a).norm();
    }
    measures.volume = std::abs(measures.volume);
    return measures;
}

/// Cells grow from triangles that stay to `size` where these are smaller.
double expected_cells(const SurfaceMesh& surface, const Measures& measures, const FillOptions& options) {
    // Of equilateral triangles of the mean area.
    const double edge = std::sqrt(4.0 / std::numbers::sqrt3 * measures.area / surface.faces.size());
    const double size = options.keeps_triangles ? std::min(options.size, edge) : options.size;
    return cells_in_unit<3> * measures.volume / std::pow(size, 3);
}

/// Gmsh measures with lengths of its own: it gets the surface about the origin and of about unit size.
struct Frame {
    Vector<3> origin;
    double unit;  ///< [m]
};

Frame frame_of(const SurfaceMesh& surface) {
    Vector<3> lower = surface.vertices.front(), upper = lower;
    for (const Vector<3>& x : surface.vertices) {
        lower = lower.cwiseMin(x);
        upper = upper.cwiseMax(x);
    }
    return {0.5 * (lower + upper), (upper - lower).maxCoeff()};
}

/// Corners of the triangles of each part of a surface, counted from 1.
std::vector<std::vector<std::size_t>> corners_of_parts(const SurfaceMesh& surface) {
    const auto health = geometry::check_surface(surface.soup());
    std::vector<std::vector<std::size_t>> corners(health.components.size());
    for (std::int32_t face = 0; face < surface.faces.size(); ++face)
        for (const std::int32_t vertex : surface.faces[face])
            corners[at(health.face_component[at(face)])].push_back(at(vertex) + 1);
    return corners;
}

/// A geometric surface per part: Gmsh leaves the inside of a cavity out by the surfaces that bound it.
void add_surfaces(const SurfaceMesh& surface, const Frame& frame) {
    int tag = surface_tag;
    for (const std::vector<std::size_t>& corners : corners_of_parts(surface)) {
        std::vector<std::size_t> nodes = corners;
        sort_unique(nodes);
        std::vector<double> coordinates;
        for (const std::size_t node : nodes)
            for (int i = 0; i < 3; ++i)
                coordinates.push_back((surface.vertices[node - 1][i] - frame.origin[i]) / frame.unit);
        gmsh().add_discrete_entity(2, tag);
        gmsh().add_nodes(2, tag, nodes, coordinates);
        gmsh().add_elements(tag, gmsh_triangle, corners);
        ++tag;
    }
}

void mesh_inside(const FillOptions& options, const Frame& frame) {
    if (!options.keeps_triangles) {
        gmsh().classify_surfaces(sharp_edge);
        gmsh().create_geometry();
    }
    std::vector<int> surfaces;
    for (const auto& [dimension, tag] : gmsh().entities(2)) surfaces.push_back(tag);
    gmsh().add_surface_loop(surfaces, surface_tag);
    gmsh().add_volume({surface_tag}, volume_tag);
    gmsh().synchronize_discrete();
    gmsh().set_physical_name(3, gmsh().add_physical_group(3, {volume_tag}), options.name);
    gmsh().set_physical_name(2, gmsh().add_physical_group(2, surfaces), "boundary");
    gmsh().set_option("Mesh.Algorithm", mesher_2d);
    gmsh().set_option("Mesh.Algorithm3D", mesher_3d);
    gmsh().set_option("Mesh.Optimize", 1);
    gmsh().set_option("Mesh.OptimizeThreshold", least_quality);
    gmsh().set_option("Mesh.MeshSizeMax", options.size / frame.unit);
    if (!options.keeps_triangles) gmsh().set_option("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh().generate_mesh(3);
}

CellSoup<3> soup_inside(const SurfaceMesh& surface, const FillOptions& options) {
    const Frame frame = frame_of(surface);
    CellSoup<3> soup;
    {
        const GmshSession session;
        session.run(surface.name, "filling failed",
                    "Mend the surface; abut detect --self-intersections finds where it cuts itself.", [&] {
                        add_surfaces(surface, frame);
                        mesh_inside(options, frame);
                        soup = soup_of_gmsh_model<3>(options.name);
                    });
    }
    soup.n_ignored_elements = 0;
    soup.vertex_label.clear();
    soup.cell_label.clear();
    for (Vector<3>& x : soup.vertices) x = Vector<3>(frame.origin + frame.unit * x);
    return soup;
}

double volume_of(const Mesh<3>& mesh) { return std::accumulate(mesh.cell_measure.begin(), mesh.cell_measure.end(), 0.0); }

/// Cells inside the surface once it is remeshed, or why there are none.
struct Remeshed {
    std::optional<CellSoup<3>> soup;
    std::string why;
};
Remeshed remeshed(const SurfaceMesh& surface, const FillOptions& options) {
    try {
        return {soup_inside(surface, options), ""};
    } catch (const MeshError& error) {
        return {std::nullopt, error.what()};
    }
}

void check_size(const SurfaceMesh& surface, const Measures& measures, const FillOptions& options,
                const MeshOptions& mesh_options) {
    check_estimate(options.name, expected_cells(surface, measures, options), most_filled_cells, mesh_options,
                   "Raise size, give the unit of the file, unit = \"mm\" for millimetres, or coarsen " + surface.name);
}

/// The triangles of the surface are faces of the mesh.
Mesh<3> with_triangles(const SurfaceMesh& surface, const Measures& measures, FillOptions options,
                       const MeshOptions& mesh_options) {
    options.keeps_triangles = true;
    check_size(surface, measures, options, mesh_options);
    return build_mesh(soup_inside(surface, options), mesh_options);
}

}  // namespace

Mesh<3> fill(const SurfaceMesh& given, const FillOptions& options, const MeshOptions& mesh_options) {
    require_length(options.name, "size", options.size);
    const SurfaceMesh surface = prepared(given);
    const Measures measures = measures_of(surface);
    if (options.keeps_triangles) return with_triangles(surface, measures, options, mesh_options);
    check_size(surface, measures, options, mesh_options);
    Remeshed found = remeshed(surface, options);
    if (found.soup) {
        Mesh<3> mesh = build_mesh(std::move(*found.soup), mesh_options);
        const double share = volume_of(mesh) / measures.volume;
        if (share > least_volume && share < 1.0 / least_volume) {
            if (share < good_volume || share > 1.0 / good_volume)
                mesh.report.warnings.push_back(options.name + ": its cells fill " + number(share) +
                                               " of the volume inside " + surface.name +
                                               ". A smaller size follows its curves more closely");
            return mesh;
        }
        found.why = "its cells fill " + number(share) + " of the volume";
    }
    Mesh<3> mesh = with_triangles(surface, measures, options, mesh_options);
    mesh.report.warnings.push_back(
        options.name + ": " + surface.name + " cannot be remeshed (" + found.why +
        "). Its triangles stay as they are: cells beside them have their size, whatever `size` is");
    return mesh;
}

}  // namespace abut::mesh
