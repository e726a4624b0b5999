#include "abut/mesh/surface_mesh.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/disjoint_sets.hpp"
#include "abut/base/error.hpp"
#include "abut/base/index.hpp"
#include "abut/geometry/merged_vertices.hpp"
#include "abut/geometry/triangulate.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

using geometry::FaceFault;

bool is_vertex(const SurfaceMesh& mesh, std::int32_t index) { return index >= 0 && at(index) < mesh.vertices.size(); }

/// Keeps the vertices for which `keeps` is not 0; their new numbers, -1 for the others.
std::vector<std::int32_t> drop_vertices(SurfaceMesh& mesh, const std::vector<char>& keeps) {
    std::vector<std::int32_t> number(mesh.vertices.size(), -1);
    std::int32_t n = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (keeps[v] == 0) continue;
        mesh.vertices[at(n)] = mesh.vertices[v];
        if (!mesh.displacement.empty()) mesh.displacement[at(n)] = mesh.displacement[v];
        number[v] = n++;
    }
    mesh.vertices.resize(at(n));
    if (!mesh.displacement.empty()) mesh.displacement.resize(at(n));
    return number;
}

std::string unused_name(const std::string& wanted, const std::vector<std::string>& used) {
    std::string name = wanted;
    for (int i = 2; std::find(used.begin(), used.end(), name) != used.end(); ++i)
        name = wanted + std::string("_") + std::to_string(i);
    return name;
}

bool have_common_name(std::span<const SurfaceMesh> meshes) {
    std::vector<std::string> names;
    for (const SurfaceMesh& mesh : meshes) names.insert(names.end(), mesh.body_names.begin(), mesh.body_names.end());
    std::sort(names.begin(), names.end());
    return std::adjacent_find(names.begin(), names.end()) != names.end();
}

void append(SurfaceMesh& all, const SurfaceMesh& mesh) {
    const auto first_vertex = static_cast<std::int32_t>(all.vertices.size());
    const auto first_body = static_cast<std::int32_t>(all.body_names.size() - mesh.body_names.size());
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
        std::vector<std::int32_t> corners(mesh.faces[face].begin(), mesh.faces[face].end());
        for (std::int32_t& v : corners) v = is_vertex(mesh, v) ? v + first_vertex : -1;
        all.faces.append(corners);
        all.face_body.push_back(mesh.face_body[at(face)] + first_body);
    }
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    all.n_ignored_elements += mesh.n_ignored_elements;
    all.warnings.insert(all.warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
}

void append_displacement(SurfaceMesh& all, const SurfaceMesh& mesh) {
    all.displacement.insert(all.displacement.end(), mesh.displacement.begin(), mesh.displacement.end());
    all.displacement.resize(all.vertices.size(), Vector<3>::Zero());
}

[[noreturn]] void refuse_faces(const SurfaceMesh& mesh, const geometry::SurfaceReport& health) {
    constexpr std::size_t most = 5;
    const std::size_t n = health.unusable_faces.size();
    std::string message =
        mesh.name + ": " + std::to_string(n) + " of " + counted(health.n_faces, "face") + " cannot be used: ";
    for (std::size_t i = 0; i < std::min(n, most); ++i) {
        const std::int32_t face = health.unusable_faces[i];
        message += (i > 0 ? "; face " : "face ") + std::to_string(mesh.label(face)) + " " +
                   geometry::describe(mesh.soup(), face, health.faults[at(face)]);
    }
    message += n > most ? "; and " + std::to_string(n - most) + " more. " : ". ";
    const bool any_is_concave = std::ranges::any_of(health.unusable_faces, [&](std::int32_t face) {
        return health.faults[at(face)] == geometry::FaceFault::non_convex;
    });
    throw MeshError(message + "Mend the surface" + (any_is_concave ? ", cut faces that are not convex into triangles" : "") +
                    ", or have such faces left out: UnusableFaces::skip.");
}

/// The corners of a usable face but those at the place of the one before.
std::vector<std::int32_t> corners_without_repeats(const SurfaceMesh& mesh, std::span<const std::int32_t> places,
                                                  std::int32_t face) {
    std::vector<std::int32_t> corners;
    for (const std::int32_t v : mesh.faces[face])
        if (corners.empty() || places[at(corners.back())] != places[at(v)]) corners.push_back(v);
    while (corners.size() > 1 && places[at(corners.back())] == places[at(corners.front())]) corners.pop_back();
    return corners;
}

class Cleaning {
public:
    Cleaning(const SurfaceMesh& mesh, const geometry::SurfaceReport& health) : mesh_(mesh), health_(health) {
        clean_.mesh.name = mesh.name;
        clean_.mesh.vertices = mesh.vertices;
        clean_.mesh.displacement = mesh.displacement;
        clean_.mesh.body_names = mesh.body_names;
        clean_.mesh.n_ignored_elements = mesh.n_ignored_elements;
        clean_.mesh.warnings = mesh.warnings;
        clean_.n_skipped_faces = static_cast<std::int32_t>(health.unusable_faces.size());
    }

    CleanSurface result() && {
        auto non_planar = health_.non_planar_faces.begin();
        for (std::int32_t face = 0; face < mesh_.faces.size(); ++face) {
            if (health_.faults[at(face)] != FaceFault::none) continue;
            const auto corners = corners_without_repeats(mesh_, health_.merged_vertices, face);
            const bool is_cut = non_planar != health_.non_planar_faces.end() && *non_planar == face;
            if (is_cut) ++non_planar;
            if (is_cut)
                append_pieces(corners, face);
            else
                append(corners, face);
        }
        return std::move(clean_);
    }

private:
    void append(std::span<const std::int32_t> corners, std::int32_t face) {
        clean_.mesh.faces.append(corners);
        clean_.mesh.face_body.push_back(mesh_.face_body[at(face)]);
        clean_.mesh.face_label.push_back(mesh_.label(face));
        clean_.input_face.push_back(face);
    }
    void append_pieces(const std::vector<std::int32_t>& corners, std::int32_t face) {
        std::vector<Vector<3>> points;
        for (const std::int32_t v : corners) points.push_back(mesh_.vertices[at(v)]);
        ++clean_.n_cut_faces;
        for (const geometry::LocalTriangle& cut : geometry::cut_into_triangles(points)) {
            const std::array<std::int32_t, 3> piece = {corners[at(cut[0])], corners[at(cut[1])], corners[at(cut[2])]};
            if (is_usable({points[at(cut[0])], points[at(cut[1])], points[at(cut[2])]}))
                append(piece, face);
            else
                ++clean_.n_flat_pieces;
        }
    }
    static bool is_usable(const std::array<Vector<3>, 3>& corners) {
        constexpr std::array<std::int32_t, 2> offsets = {0, 3};
        constexpr std::array<std::int32_t, 3> vertices = {0, 1, 2};
        return geometry::face_faults({corners, offsets, vertices})[0] == FaceFault::none;
    }

    const SurfaceMesh& mesh_;
    const geometry::SurfaceReport& health_;
    CleanSurface clean_;
};

}  // namespace

std::int32_t weld(SurfaceMesh& mesh) {
    const std::vector<std::int32_t> places = geometry::merged_vertices<3>(mesh.vertices);
    std::vector<std::int32_t> target(places);
    std::vector<char> keeps(places.size(), 1);
    std::int32_t n_dropped = 0;
    for (std::size_t v = 0; v < places.size(); ++v) {
        const bool moves_apart = !mesh.displacement.empty() && mesh.displacement[v] != mesh.displacement[at(places[v])];
        if (moves_apart) target[v] = static_cast<std::int32_t>(v);
        if (target[v] == static_cast<std::int32_t>(v)) continue;
        keeps[v] = 0;
        ++n_dropped;
    }
    const auto n_before = static_cast<std::int32_t>(places.size());
    const std::vector<std::int32_t> number = drop_vertices(mesh, keeps);
    for (std::int32_t& v : mesh.faces.values) v = v >= 0 && v < n_before ? number[at(target[at(v)])] : -1;
    return n_dropped;
}

void name_connected_bodies(SurfaceMesh& mesh) {
    const std::vector<std::int32_t> places = geometry::merged_vertices<3>(mesh.vertices);
    DisjointSets connected(places.size());
    for (std::size_t v = 0; v < places.size(); ++v) connected.join(places[v], static_cast<std::int32_t>(v));
    const auto first_vertex = [&](std::int32_t face) {
        const auto corners = mesh.faces[face];
        const auto found = std::find_if(corners.begin(), corners.end(), [&](std::int32_t v) { return is_vertex(mesh, v); });
        return found == corners.end() ? -1 : *found;
    };
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
        const std::int32_t first = first_vertex(face);
        for (const std::int32_t v : mesh.faces[face])
            if (is_vertex(mesh, v)) connected.join(first, v);
    }
    std::unordered_map<std::int32_t, std::int32_t> body_of_set;
    mesh.body_names.clear();
    mesh.face_body.assign(at(mesh.faces.size()), 0);
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
        const std::int32_t first = first_vertex(face);
        const auto next = static_cast<std::int32_t>(mesh.body_names.size());
        const auto [entry, is_new] = body_of_set.emplace(first < 0 ? -1 : connected.find(first), next);
        if (is_new) mesh.body_names.push_back(std::string("body_") + std::to_string(next + 1));
        mesh.face_body[at(face)] = entry->second;
    }
}

SurfaceMesh combine(std::span<const SurfaceMesh> meshes) {
    SurfaceMesh all;
    const bool add_prefix = have_common_name(meshes);
    const bool moves =
        std::any_of(meshes.begin(), meshes.end(), [](const SurfaceMesh& mesh) { return !mesh.displacement.empty(); });
    for (const SurfaceMesh& mesh : meshes) {
        all.name += (all.name.empty() ? "" : " + ") + mesh.name;
        for (const std::string& body : mesh.body_names)
            all.body_names.push_back(unused_name(add_prefix ? mesh.name + "." + body : body, all.body_names));
        append(all, mesh);
        if (moves) append_displacement(all, mesh);
    }
    return all;
}

SurfaceMesh boundary_of(const Mesh<3>& mesh, std::span<const Vector<3>> displacement) {
    SurfaceMesh surface;
    surface.name = mesh.name;
    surface.body_names = mesh.body_names;
    surface.n_ignored_elements = mesh.report.n_ignored_elements;
    surface.warnings = mesh.report.warnings;
    if (mesh.report.n_turned_cells > 0)
        surface.warnings.push_back(std::to_string(mesh.report.n_turned_cells) +
                                   " cells are given inside out (clockwise) and are turned");
    std::vector<std::int32_t> number(mesh.vertices.size(), -1);
    std::vector<std::int32_t> corners;
    for (const std::int32_t face : mesh.boundary_faces) {
        corners.clear();
        for (const std::int32_t v : mesh.face_vertices[face]) {
            if (number[at(v)] < 0) {
                number[at(v)] = static_cast<std::int32_t>(surface.vertices.size());
                surface.vertices.push_back(mesh.vertices[at(v)]);
                if (!displacement.empty()) surface.displacement.push_back(displacement[at(v)]);
            }
            corners.push_back(number[at(v)]);
        }
        const std::int32_t cell = mesh.face_cells[at(face)][0];
        surface.faces.append(corners);
        surface.face_body.push_back(mesh.cell_body[at(cell)]);
        surface.face_label.push_back(mesh.cell_label[at(cell)]);
    }
    return surface;
}

CleanSurface clean(const SurfaceMesh& mesh, const geometry::SurfaceReport& health, UnusableFaces policy) {
    if (health.n_faces != mesh.faces.size() || at(health.n_vertices) != mesh.vertices.size())
        throw BadInput(mesh.name + ": has " + counted(mesh.faces.size(), "face") + " and " +
                       counted(std::ssize(mesh.vertices), "vertex", "vertices") + ", but the health is that of " +
                       counted(health.n_faces, "face") + " and " + counted(health.n_vertices, "vertex", "vertices") +
                       ". Give that of this surface.");
    if (!health.unusable_faces.empty() && (policy == UnusableFaces::fail || health.n_usable() == 0))
        refuse_faces(mesh, health);
    if (health.n_usable() == 0)
        throw MeshError(mesh.name +
                        ": the surface is empty: it has 0 faces, at least 1 is needed. Write the surface again.");
    return Cleaning(mesh, health).result();
}

std::vector<bool> cavities_of(const SurfaceMesh& mesh, const geometry::SurfaceReport& health) {
    const auto& parts = health.components;
    std::vector<geometry::Box<3>> boxes(parts.size());
    for (std::int32_t face = 0; face < mesh.faces.size(); ++face)
        if (const std::int32_t part = health.face_component[at(face)]; part >= 0)
            for (const std::int32_t v : mesh.faces[face]) boxes[at(part)].extend(mesh.vertices[at(v)]);
    const auto is_around = [&](std::size_t outer, std::size_t inner) {
        return all_at_most(boxes[outer].lower, boxes[inner].lower) && all_at_most(boxes[inner].upper, boxes[outer].upper);
    };
    std::vector<bool> cavities(parts.size(), false);
    for (std::size_t inner = 0; inner < parts.size(); ++inner)
        for (std::size_t outer = 0; outer < parts.size(); ++outer)
            if (parts[outer].volume * parts[inner].volume < 0.0 && is_around(outer, inner)) cavities[inner] = true;
    return cavities;
}

}  // namespace abut::mesh
