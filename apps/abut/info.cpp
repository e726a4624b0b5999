#include "apps/abut/info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/base/error.hpp"
#include "abut/input/scene_file.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/io/read_mesh.hpp"
#include "abut/mesh/io/read_surface.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "apps/abut/info_lines.hpp"
#include "apps/abut/results_info.hpp"

namespace abut::apps {
namespace {

namespace fs = std::filesystem;

template <class Points>
std::string box_of(const Points& points) {
    auto lower = points.front(), upper = points.front();
    for (const auto& point : points) lower = lower.cwiseMin(point), upper = upper.cwiseMax(point);
    return fmt::format("({:g}) to ({:g}) m", fmt::join(lower, ", "), fmt::join(upper, ", "));
}

std::string shapes_of(const mesh::MeshQuality& quality) {
    std::vector<std::string> parts;
    for (std::size_t shape = 0; shape < quality.n_cells_of.size(); ++shape)
        if (quality.n_cells_of[shape] > 0)
            parts.push_back(
                fmt::format("{} {}", quality.n_cells_of[shape], mesh::name(static_cast<mesh::CellShape>(shape))));
    return fmt::format("{}", fmt::join(parts, ", "));
}

template <int Dim>
double measure_of_body(const mesh::Mesh<Dim>& mesh, std::int32_t body) {
    double measure = 0.0;
    for (std::size_t c = 0; c < mesh.cell_body.size(); ++c)
        if (mesh.cell_body[c] == body) measure += mesh.cell_measure[c];
    return measure;
}

/// Cells, sizes, shapes; not the bodies one by one.
template <int Dim>
std::string mesh_lines(const mesh::Mesh<Dim>& mesh) {
    const mesh::MeshQuality quality = mesh::quality(mesh);
    const auto cell = [&](std::int32_t index) { return mesh.cell_label[static_cast<std::size_t>(index)]; };
    return info_line("cells", fmt::format("{}: {}", mesh.n_cells(), shapes_of(quality))) +
           info_line("faces", fmt::format("{}, {} of them on the boundary", mesh.n_faces(), mesh.boundary_faces.size())) +
           info_line("vertices", fmt::format("{}", mesh.vertices.size())) + info_line("box", box_of(mesh.vertices)) +
           info_line("smallest cell",
                     fmt::format("{:.4g} m^{}, cell {}", quality.smallest_measure, Dim, cell(quality.smallest_cell))) +
           info_line("worst cell", fmt::format("aspect {:.3g} (1 is ideal), cell {}", quality.worst_aspect_ratio,
                                               cell(quality.worst_cell)));
}

template <int Dim>
std::string group_lines(const mesh::Mesh<Dim>& mesh) {
    std::string text;
    for (const auto& group : mesh.groups)
        text += info_line(fmt::format("group '{}'", group.name), fmt::format("{} boundary faces", group.faces.size()));
    return text;
}

template <int Dim>
std::string mesh_info(const fs::path& path) {
    const auto mesh = mesh::read_mesh<Dim>(path, {.non_planar = mesh::NonPlanarFaces::split});
    std::string text = fmt::format("{}: a mesh in {}D\n", path.string(), Dim) + mesh_lines(mesh);
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body)
        text += info_line(fmt::format("body '{}'", mesh.body_names[static_cast<std::size_t>(body)]),
                          fmt::format("{}, {:.6g} m^{}", counted(std::ranges::count(mesh.cell_body, body), "cell"),
                                      measure_of_body(mesh, body), Dim));
    text += group_lines(mesh);
    if (mesh.report.n_non_planar_faces > 0)
        text += info_line("not planar",
                          fmt::format("{}, by up to {:.2g} of their size: a run refuses them unless they "
                                      "are split (non_planar = \"split\")",
                                      counted(mesh.report.n_non_planar_faces, "face"), mesh.report.worst_planarity));
    if (mesh.report.n_turned_cells > 0)
        text += info_line("turned", counted(mesh.report.n_turned_cells, "cell") + ", given inside out (clockwise)");
    for (const std::string& warning : mesh.report.warnings) text += info_line("warning", warning);
    return text;
}

/// Files of surfaces tell no unit, and programs that draw write millimetres most often. Nothing where it is small.
std::string unit_line(const mesh::SurfaceMesh& surface, const fs::path& path) {
    constexpr double doubtful = 5.0;  // [m]
    if (surface.vertices.empty()) return "";
    Vector<3> lower = surface.vertices.front(), upper = lower;
    for (const Vector<3>& x : surface.vertices) {
        lower = lower.cwiseMin(x);
        upper = upper.cwiseMax(x);
    }
    const double extent = (upper - lower).maxCoeff();
    if (extent < doubtful) return "";
    return info_line("unit?", fmt::format("{:.3g} m long as it stands. If it is in millimetres: unit = \"mm\" in a scene, "
                                          "{}:unit=mm for abut detect",
                                          extent, path.filename().string()));
}

std::string surface_info(const fs::path& path) {
    const mesh::SurfaceMesh surface = mesh::read_surface(path);
    const auto health = geometry::check_surface(surface.soup());
    std::string text = fmt::format("{}: a surface\n", path.string());
    text += info_line("bodies", fmt::format("{}", fmt::join(surface.body_names, ", ")));
    text += info_line("sound", health.sound() ? "yes" : "no: what is wrong is below");
    for (const std::string& line : geometry::describe(surface.soup(), health)) text += info_line("", line);
    text += unit_line(surface, path);
    for (const std::string& warning : surface.warnings) text += info_line("warning", warning);
    return text;
}

/// Content of a file that may hold a mesh or a surface; of a surface also why it is no mesh. Throws with all reasons if it
/// holds neither.
std::string mesh_or_surface_info(const fs::path& path) {
    std::vector<std::string> reasons;
    for (const auto& mesh_info_of : {mesh_info<3>, mesh_info<2>}) {
        try {
            return mesh_info_of(path);
        } catch (const Error& error) {
            reasons.emplace_back(error.what());
        }
    }
    try {
        return surface_info(path) + info_line("no mesh", reasons.front());
    } catch (const Error& error) {
        throw BadInput(fmt::format("{}: it cannot be read\n  as a mesh in 3D: {}\n  as a mesh in 2D: {}\n  as a surface: {}",
                                   path.string(), reasons[0], reasons[1], error.what()));
    }
}

template <int Dim>
std::string scene_info(const fs::path& path, const input::SceneFile& file) {
    const run::Scene<Dim> scene = file.scene<Dim>();
    std::string text = fmt::format("{}: a scene in {}D\n", path.string(), Dim) + mesh_lines(scene.mesh);
    for (std::int32_t body = 0; body < scene.mesh.n_bodies(); ++body) {
        const auto b = static_cast<std::size_t>(body);
        const double mass = scene.solid.materials[b].density * measure_of_body(scene.mesh, body);
        const auto kinematics = solid::kinematics_of(scene.solid.kinematics, b);
        text += info_line(
            fmt::format("body '{}'", scene.mesh.body_names[b]),
            fmt::format("{}, {:.6g} kg, {}, at ({:g}) m/s", counted(std::ranges::count(scene.mesh.cell_body, body), "cell"),
                        mass, run::name_of(kinematics), fmt::join(scene.velocity[b], ", ")));
    }
    text += group_lines(scene.mesh);
    text += info_line("obstacles", fmt::format("{}", scene.solid.obstacles.size()));
    text += info_line("contact", scene.contact ? "on" : "off");
    return text + fmt::format("`abut check {}` says what a run would take.\n", path.string());
}

std::string scene_info(const fs::path& path) {
    const input::SceneFile file(path);
    return file.dimension() == 2 ? scene_info<2>(path, file) : scene_info<3>(path, file);
}

}  // namespace

std::string info(const fs::path& path) {
    if (fs::is_directory(path)) return results_info(path);
    if (!fs::exists(path)) throw BadInput(fmt::format("{}: there is no such file.", path.string()));
    std::string extension = path.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".toml") return scene_info(path);
    if (extension == ".msh" || extension == ".vtu") return mesh_or_surface_info(path);
    for (const char* surface : {".stl", ".obj", ".off", ".ply", ".vtp"})
        if (extension == surface) return surface_info(path);
    try {
        return mesh_info<3>(path);  // says what is wrong with the extension, and what converts the file
    } catch (const Error& error) {
        throw BadInput(
            fmt::format("{}\nA scene (.toml), a mesh (.msh, .vtu), a surface (.stl, .obj, .off, .ply, .vtp) or a folder of "
                        "results can be "
                        "looked at.",
                        error.what()));
    }
}

}  // namespace abut::apps
