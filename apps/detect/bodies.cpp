#include "apps/detect/bodies.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "abut/base/index.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/geometry/triangulate.hpp"
#include "abut/mesh/io/read_surface.hpp"
#include "abut/mesh/quality.hpp"
#include "apps/detect/placing.hpp"
#include "apps/detect/shapes.hpp"

namespace abut::apps {
namespace {

using mesh::CleanSurface;
using mesh::SurfaceMesh;

SurfaceMesh read_one(const std::string& input, const DetectOptions& options) {
    if (!is_shape(input)) {
        const auto [path, keys] = placed_file(input);
        keys.check_known(placing_keys());
        SurfaceMesh surface = mesh::read_surface(path, {.weld = {},
                                                        .displacement = options.displacement,
                                                        .connected_bodies = options.connected,
                                                        .volume = {.planarity_tolerance = options.planarity_tolerance}});
        if (!keys.empty()) place(surface, keys);
        return surface;
    }
    SurfaceMesh shape = make_shape(input);
    if (options.connected) mesh::name_connected_bodies(shape);
    return shape;
}

std::vector<std::int64_t> labels_of(const SurfaceMesh& surface) {
    std::vector<std::int64_t> labels;
    for (std::int32_t face = 0; face < surface.faces.size(); ++face) labels.push_back(surface.label(face));
    return labels;
}

InputReport examined(const SurfaceMesh& surface, const DetectOptions& options) {
    InputReport report{
        .name = surface.name,
        .health = geometry::check_surface(surface.soup(), {.self_intersections = options.self_intersections,
                                                           .planarity_tolerance = options.planarity_tolerance}),
        .lines = {},
        .n_ignored_elements = surface.n_ignored_elements,
        .warnings = surface.warnings};
    report.lines = geometry::describe(surface.soup(), report.health, labels_of(surface));
    if (surface.n_ignored_elements > 0)
        report.lines.push_back(fmt::format("{} elements of the file are no faces: ignored", surface.n_ignored_elements));
    for (const std::string& warning : surface.warnings) report.lines.push_back("warning of the reader: " + warning);
    return report;
}

/// Calls `read`; where its error names a choice of the library, that of the command line stands there.
template <class Read>
auto with_option_names(const Read& read) {
    try {
        return read();
    } catch (const mesh::MeshError& error) {
        std::string message = error.what();
        for (const auto& [name, option] : {std::pair<std::string, std::string>{"UnusableFaces::skip", "--unusable skip"},
                                           {"SurfaceOptions::displacement", "--displacement"}})
            if (const auto place = message.find(name); place != std::string::npos)
                message.replace(place, name.size(), option);
        throw std::runtime_error(message);
    }
}

void log_lines(const InputReport& report) {
    spdlog::info("{}:", report.name);
    for (const std::string& line : report.lines) spdlog::info("  {}", line);
}

/// The surface without faces that cannot be used. One that is refused is described first.
CleanSurface cleaned(const SurfaceMesh& surface, const InputReport& report, const DetectOptions& options) {
    try {
        return with_option_names([&] { return mesh::clean(surface, report.health, options.unusable); });
    } catch (...) {
        log_lines(report);
        throw;
    }
}

/// Appends faces of a clean surface, with vertices for each body of its own.
class Assembly {
public:
    explicit Assembly(Bodies& bodies) : bodies_(bodies) {}

    void append(const CleanSurface& clean, std::int32_t input, std::int32_t first_body) {
        place_.clear();
        const SurfaceMesh& mesh = clean.mesh;
        for (std::int32_t face = 0; face < mesh.faces.size(); ++face) {
            const std::int32_t body = first_body + mesh.face_body[at(face)];
            for (const auto& corners : pieces(mesh, face)) {
                for (const std::int32_t v : corners) bodies_.surface.face_vertices.push_back(vertex(mesh, v, body));
                append_face(input, clean.input_face[at(face)], mesh.label(face), body);
            }
        }
    }

private:
    /// The face itself; triangles where it will deform, since corners that move do not stay in a plane.
    static std::vector<std::vector<std::int32_t>> pieces(const SurfaceMesh& mesh, std::int32_t face) {
        const std::vector<std::int32_t> corners(mesh.faces[face].begin(), mesh.faces[face].end());
        if (mesh.displacement.empty() || corners.size() == 3) return {corners};
        std::vector<Vector<3>> points;
        for (const std::int32_t v : corners) points.push_back(mesh.vertices[at(v)]);
        std::vector<std::vector<std::int32_t>> triangles;
        for (const auto& [a, b, c] : geometry::cut_into_triangles(points))
            triangles.push_back({corners[at(a)], corners[at(b)], corners[at(c)]});
        return triangles;
    }
    std::int32_t vertex(const SurfaceMesh& mesh, std::int32_t v, std::int32_t body) {
        const auto next = static_cast<std::int32_t>(bodies_.start.size());
        const auto [entry, is_new] = place_.try_emplace({body, v}, next);
        if (!is_new) return entry->second;
        bodies_.start.push_back(mesh.vertices[at(v)]);
        bodies_.vertex_body.push_back(body);
        const bool moves = !mesh.displacement.empty();
        if (moves) bodies_.displacement.resize(at(next), Vector<3>::Zero());
        if (moves) bodies_.displacement.push_back(mesh.displacement[at(v)]);
        return next;
    }
    void append_face(std::int32_t input, std::int32_t face, std::int64_t label, std::int32_t body) {
        auto& surface = bodies_.surface;
        surface.face_offsets.push_back(static_cast<std::int32_t>(surface.face_vertices.size()));
        surface.body.push_back(body);
        surface.stiffness.push_back(1.0);  // deformable: the search never reads how stiff
        bodies_.face_input.push_back(input);
        bodies_.face_of_input.push_back(face);
        bodies_.face_label.push_back(label);
    }

    Bodies& bodies_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> place_;
};

/// Names of bodies that are all different: with that of the input in front, or a number behind, where two would be the same.
std::vector<std::string> all_names(std::span<const CleanSurface> surfaces) {
    std::vector<std::string> names;
    const auto is_used = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
    for (const CleanSurface& surface : surfaces)
        for (const std::string& body : surface.mesh.body_names) {
            const bool is_one_of_several = surface.mesh.body_names.size() > 1;
            const std::string wanted = is_used(body) && is_one_of_several ? surface.mesh.name + "." + body : body;
            std::string name = wanted;
            for (int i = 2; is_used(name); ++i) name = fmt::format("{}_{}", wanted, i);
            names.push_back(name);
        }
    return names;
}

void assemble(Bodies& bodies, std::span<const CleanSurface> surfaces) {
    Assembly assembly(bodies);
    std::int32_t n_bodies = 0;
    for (std::size_t input = 0; input < surfaces.size(); ++input) {
        assembly.append(surfaces[input], static_cast<std::int32_t>(input), n_bodies);
        n_bodies += static_cast<std::int32_t>(surfaces[input].mesh.body_names.size());
    }
    bodies.names = all_names(surfaces);
    if (!bodies.displacement.empty()) bodies.displacement.resize(bodies.start.size(), Vector<3>::Zero());
    bodies.surface.vertices = bodies.start;
    update_faces(bodies, 0);
}

void check_displacement(std::span<const CleanSurface> surfaces, const std::string& name) {
    if (name.empty()) return;
    for (const CleanSurface& surface : surfaces)
        if (!surface.mesh.displacement.empty()) return;
    throw std::runtime_error(fmt::format(
        "--displacement {}: no input has a point array of this name and three components; .vtp and .vtu files can have one.",
        name));
}

}  // namespace

double Bodies::mean_face_size() const {
    double sum = 0.0;
    for (const double area : surface.area) sum += std::sqrt(area);
    return surface.area.empty() ? 0.0 : sum / static_cast<double>(surface.area.size());
}

double Bodies::extent() const {
    geometry::Box<3> box;
    for (const Vector<3>& x : surface.vertices) box.extend(x);
    return box.empty() ? 0.0 : (box.upper - box.lower).norm();
}

Bodies read_bodies(const DetectOptions& options, ReadingTimes& times) {
    Bodies bodies;
    std::vector<CleanSurface> surfaces;
    for (const std::string& input : options.inputs) {
        SurfaceMesh surface;
        {
            const Stopwatch watch(times.reading);
            surface = with_option_names([&] { return read_one(input, options); });
        }
        const Stopwatch watch(times.health);
        InputReport report = examined(surface, options);
        surfaces.push_back(cleaned(surface, report, options));
        const CleanSurface& clean = surfaces.back();
        report.n_used_faces = clean.mesh.faces.size();
        report.n_skipped_faces = clean.n_skipped_faces;
        report.n_cut_faces = clean.n_cut_faces;
        report.n_flat_pieces = clean.n_flat_pieces;
        bodies.inputs.push_back(std::move(report));
    }
    check_displacement(surfaces, options.displacement);
    const Stopwatch watch(times.reading);
    assemble(bodies, surfaces);
    return bodies;
}

void update_faces(Bodies& bodies, int step) {
    auto& surface = bodies.surface;
    const std::size_t n = surface.body.size();
    surface.centroid.resize(n);
    surface.normal.resize(n);
    surface.area.resize(n);
    std::vector<Vector<3>> corners;
    for (std::size_t face = 0; face < n; ++face) {
        corners.clear();
        for (auto i = at(surface.face_offsets[face]); i < at(surface.face_offsets[face + 1]); ++i)
            corners.push_back(surface.vertices[at(surface.face_vertices[i])]);
        surface.centroid[face] = geometry::face_centroid<3>(corners);
        surface.normal[face] = geometry::face_normal<3>(corners);
        surface.area[face] = geometry::face_measure<3>(corners);
        if (surface.normal[face].isZero(0.0) || !(surface.area[face] > 0.0) || !std::isfinite(surface.area[face]))
            throw std::runtime_error(fmt::format(
                "step {}: face {} of {} has the area {:g} m^2; it must be finite and > 0. Check the displacement "
                "and the motion, or take fewer steps of them.",
                step, bodies.face_label[face], bodies.inputs[at(bodies.face_input[face])].name, surface.area[face]));
    }
}

void set_depth(Bodies& bodies, double depth, double distance) {
    constexpr double nothing = 1e-9;  // of the depth: faces that are not rigid must have some
    bodies.surface.cell_depth.assign(bodies.surface.body.size(), std::max(0.25 * (depth - distance), nothing * depth));
}

}  // namespace abut::apps
