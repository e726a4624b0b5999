#include "abut/input/make_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/text.hpp"
#include "abut/input/nearest_word.hpp"
#include "abut/input/values.hpp"
#include "abut/mesh/grains.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/io/read_surface.hpp"
#include "abut/mesh/place.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/fill.hpp"
#include "abut/mesh/shapes/gear.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/split_body.hpp"

namespace abut::input {
namespace {

template <int Dim>
std::array<int, Dim> counts_in(const std::array<int, 3>& counts) {
    std::array<int, Dim> result;
    std::copy_n(counts.begin(), Dim, result.begin());
    return result;
}

/// Position of the middle of a shape when Gmsh makes it: a body that turns is made about the origin.
Vector<3> centre(const BodySettings& body) { return body.turn.isZero(0.0) ? body.place : Vector<3>::Zero(); }

/// `origin`: where that of the body is while its mesh is made.
template <int Dim>
std::optional<mesh::Refinement<Dim>> refinement(const BodySettings& body, const Vector<3>& origin) {
    if (!body.refinement) return {};
    return mesh::Refinement<Dim>{head<Dim>(Vector<3>(origin + body.refinement->point)), body.refinement->size,
                                 body.refinement->distance, body.refinement->uniform};
}

/// Most cells that a body of this shape may have where nothing says how many.
double usual_most_cells(Shape shape) {
    if (shape == Shape::structured_box || shape == Shape::fan_disc || shape == Shape::gear)
        return mesh::most_structured_cells;
    return shape == Shape::surface ? mesh::most_filled_cells : mesh::most_meshed_cells;
}

/// Copies of a pattern share the cells that may be made.
mesh::MeshOptions mesh_options(const BodySettings& body) {
    mesh::MeshOptions options{.planarity_tolerance = body.planarity_tolerance,
                              .non_planar = body.non_planar,
                              .shared_vertices = mesh::SharedVertices::separate};
    if (std::isfinite(body.most_cells)) options.most_cells = body.most_cells;
    if (body.n_copies > 1.0) options.most_cells = options.most_cells.value_or(usual_most_cells(body.shape)) / body.n_copies;
    return options;
}

template <int Dim>
mesh::CellShape cells_of(const BodySettings& body) {
    return body.cells.value_or(Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::hexahedron);
}

template <int Dim>
mesh::Mesh<Dim> box(const BodySettings& body) {
    return mesh::box<Dim>({.lower = head<Dim>(body.lower),
                           .upper = head<Dim>(body.upper),
                           .size = body.size,
                           .refinement = refinement<Dim>(body, Vector<3>::Zero()),
                           .variant = body.variant,
                           .name = body.name},
                          mesh_options(body));
}

template <int Dim>
mesh::Mesh<Dim> structured_box(const BodySettings& body) {
    return mesh::structured_box<Dim>(head<Dim>(body.lower), head<Dim>(body.upper), counts_in<Dim>(body.counts),
                                     cells_of<Dim>(body), body.name, mesh_options(body));
}

mesh::Mesh<2> round_body_in_plane(const BodySettings& body) {
    const Vector<2> middle = head<2>(centre(body));
    if (body.shape == Shape::gear)
        return mesh::gear({.centre = middle,
                           .teeth = body.teeth,
                           .radius = body.radius,
                           .bore = body.bore,
                           .pressure_angle = body.pressure_angle,
                           .backlash = body.backlash,
                           .cells = body.cells_per_tooth,
                           .name = body.name},
                          mesh_options(body));
    if (body.shape == Shape::fan_disc)
        return mesh::fan_disc(middle, body.radius, body.sectors, 0.0, body.name, mesh_options(body));
    return mesh::disc({.centre = middle,
                       .radius = body.radius,
                       .size = body.size,
                       .refinement = refinement<2>(body, centre(body)),
                       .variant = body.variant,
                       .name = body.name},
                      mesh_options(body));
}

mesh::Mesh<3> round_body_in_space(const BodySettings& body) {
    if (body.shape == Shape::sphere)
        return mesh::sphere({.centre = centre(body),
                             .radius = body.radius,
                             .size = body.size,
                             .refinement = refinement<3>(body, centre(body)),
                             .variant = body.variant,
                             .name = body.name},
                            mesh_options(body));
    return mesh::cylinder({.centre = centre(body),
                           .radius = body.radius,
                           .length = body.length,
                           .size = body.size,
                           .refinement = refinement<3>(body, centre(body)),
                           .variant = body.variant,
                           .name = body.name},
                          mesh_options(body));
}

bool has_centre(Shape shape) {
    return shape == Shape::disc || shape == Shape::fan_disc || shape == Shape::gear || shape == Shape::cylinder ||
           shape == Shape::sphere;
}

template <int Dim>
mesh::Mesh<Dim> round_body(const BodySettings& body) {
    if constexpr (Dim == 2)
        return round_body_in_plane(body);
    else
        return round_body_in_space(body);
}

/// A file of a surface has no cells, and another key fills it with some.
void refuse_surface(const BodySettings& body) {
    std::string extension = body.mesh.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const auto is_extension = [&](const char* one) { return extension == one; };
    if (std::ranges::none_of(std::array{".stl", ".obj", ".off", ".ply", ".vtp"}, is_extension)) return;
    throw mesh::MeshError(fmt::format(
        "bodies.{0}.mesh: {1} is a surface, without cells. In 3D write surface = \"{1}\" in place of mesh, and size, the "
        "edge length of its cells [m]; unit = \"mm\" where the file is in millimetres.",
        body.name, body.mesh.string()));
}

mesh::Mesh<3> filled_surface(const BodySettings& body, const std::filesystem::path& folder) {
    mesh::SurfaceMesh surface = mesh::read_surface(folder / body.surface);
    for (Vector<3>& x : surface.vertices) x *= body.unit * body.scale;
    return mesh::fill(surface, {.size = body.size, .name = body.name, .keeps_triangles = body.keep_triangles},
                      mesh_options(body));
}

template <int Dim>
mesh::Mesh<Dim> unplaced(const BodySettings& body, const std::filesystem::path& folder, const GivenMeshes* given) {
    if (has_centre(body.shape)) return round_body<Dim>(body);
    if (body.shape == Shape::box) return box<Dim>(body);
    if (body.shape == Shape::structured_box) return structured_box<Dim>(body);
    if constexpr (Dim == 3)
        if (body.shape == Shape::surface) return filled_surface(body, folder);
    if (given) {
        const auto& meshes = given->of<Dim>();
        if (const auto found = meshes.find(body.mesh.string()); found != meshes.end()) return found->second;
        if (given->of<5 - Dim>().contains(body.mesh.string()))
            throw mesh::MeshError(
                fmt::format("bodies.{}.mesh is a mesh of {}D in a scene of {}D. Give one of {}D, or another dim.", body.name,
                            5 - Dim, Dim, Dim));
    }
    refuse_surface(body);
    return mesh::read_mesh<Dim>(folder / body.mesh, mesh_options(body));
}

/// Each cell belongs to the first region that its centroid is in, seen from the origin of the body.
template <int Dim>
mesh::Mesh<Dim> cut_into_regions(const mesh::Mesh<Dim>& mesh, const BodySettings& body) {
    std::vector<const BodySettings*> regions;
    for (const BodySettings& part : body.parts)
        if (part.region) regions.push_back(&part);
    if (regions.empty()) return mesh;
    if (mesh.n_bodies() > 1)
        throw mesh::MeshError(
            fmt::format("bodies.{}.{}.region: {} has {} bodies, and regions are made of one. Leave the region out, and "
                        "give tables to the bodies.",
                        body.name, regions.front()->name, body.mesh.string(), mesh.n_bodies()));
    const Vector<Dim> origin = has_centre(body.shape) ? head<Dim>(centre(body)) : Vector<Dim>::Zero();
    std::vector<std::int32_t> part_of;
    for (const Vector<Dim>& centroid : mesh.cell_centroid) {
        const Vector<3> x = in_3d<Dim>(centroid - origin);
        const auto found =
            std::ranges::find_if(regions, [&](const BodySettings* part) { return (*part->region)(0.0, x) != 0.0; });
        part_of.push_back(static_cast<std::int32_t>(found - regions.begin()));
    }
    std::vector<std::string> names;
    for (const BodySettings* part : regions) names.push_back(part->name);
    if (std::ranges::find(part_of, std::ssize(regions)) != part_of.end()) names.emplace_back(rest_of_regions);
    return mesh::split_body<Dim>(mesh, part_of, std::move(names));
}

/// Names of the grains of a body are numbers, from 1 on.
template <int Dim>
mesh::Mesh<Dim> cut_into_grains(mesh::Mesh<Dim> mesh, const BodySettings& body) {
    if (!body.fracture) return mesh;
    if (mesh.n_bodies() > 1)
        throw mesh::MeshError(
            fmt::format("bodies.{}.fracture: the body has {} parts, and one that breaks is made of one. Leave fracture or "
                        "its parts out.",
                        body.name, mesh.n_bodies()));
    const std::vector<std::int32_t> grains =
        mesh::grains_of<Dim>(mesh, {.size = body.fracture->grain, .seed = static_cast<std::uint32_t>(body.fracture->seed)});
    std::vector<std::string> names;
    for (std::int32_t grain = 0; grain <= *std::ranges::max_element(grains); ++grain)
        names.push_back(std::to_string(grain + 1));
    return mesh::split_body<Dim>(mesh, grains, std::move(names));
}

/// Every table of a body of the file has its body.
template <int Dim>
void check_parts(const mesh::Mesh<Dim>& mesh, const BodySettings& body) {
    for (const BodySettings& part : body.parts)
        if (std::ranges::find(mesh.body_names, part.name) == mesh.body_names.end())
            throw mesh::MeshError(fmt::format("bodies.{}.{}: {} has no body of this name.{}", body.name, part.name,
                                              body.mesh.empty() ? "it" : body.mesh.string(),
                                              hint(part.name, mesh.body_names)));
}

template <int Dim>
void name_parts(mesh::Mesh<Dim>& mesh, const std::string& name) {
    mesh.name = name;
    for (std::string& body : mesh.body_names) body = in_one_line(as_utf8(body));
    for (auto& group : mesh.groups) group.name = in_one_line(as_utf8(group.name));
    if (mesh.n_bodies() == 1)
        mesh.body_names = {name};
    else
        for (std::string& body : mesh.body_names) body = name + "." + body;
    for (auto& group : mesh.groups) group.name = name + "." + group.name;
}

}  // namespace

template <int Dim>
mesh::Mesh<Dim> make_body(const BodySettings& body, const std::filesystem::path& folder, const GivenMeshes* given) {
    mesh::Mesh<Dim> mesh = cut_into_grains<Dim>(cut_into_regions<Dim>(unplaced<Dim>(body, folder, given), body), body);
    const bool turns = !body.turn.isZero(0.0);
    if (turns || (!has_centre(body.shape) && !body.place.isZero(0.0)))
        mesh::place(mesh, turns ? rotation<Dim>(body.turn) : Matrix<Dim>::Identity(), head<Dim>(body.place));
    check_parts(mesh, body);
    name_parts(mesh, body.name);
    return mesh;
}

template <int Dim>
Vector<Dim> placed(const BodySettings& body, const Vector<Dim>& point) {
    return (body.turn.isZero(0.0) ? point : Vector<Dim>(rotation<Dim>(body.turn) * point)) + head<Dim>(body.place);
}

const BodySettings& settings_of(const BodySettings& body, const std::string& name) {
    // A file with one body gives it the name of the table.
    if (name == body.name && body.parts.size() == 1) return body.parts.front();
    for (const BodySettings& part : body.parts)
        if (name == body.name + "." + part.name) return part;
    return body;
}

const BodySettings* table_of(const std::string& body, const std::vector<BodySettings>& tables) {
    const auto found = std::ranges::find_if(
        tables, [&](const BodySettings& table) { return body == table.name || body.starts_with(table.name + "."); });
    return found == tables.end() ? nullptr : &*found;
}

template mesh::Mesh<2> make_body<2>(const BodySettings&, const std::filesystem::path&, const GivenMeshes*);
template mesh::Mesh<3> make_body<3>(const BodySettings&, const std::filesystem::path&, const GivenMeshes*);
template Vector<2> placed<2>(const BodySettings&, const Vector<2>&);
template Vector<3> placed<3>(const BodySettings&, const Vector<3>&);

}  // namespace abut::input
