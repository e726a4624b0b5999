// Only the LGPL parts of CGAL: Stream_support and kernels.
#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/IO/PLY.h>
#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cctype>
#include <cstring>
#include <exception>
#include <limits>
#include <locale>
#include <sstream>
#include <string_view>

#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

struct PolygonSoup {
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> polygons;
};

std::istringstream stream_of(std::string contents) {
    std::istringstream stream(std::move(contents));
    stream.imbue(std::locale::classic());
    return stream;
}

void check_counts(const std::string& name, std::size_t n_bytes, std::size_t n_vertices, std::size_t n_faces) {
    // "0 0 0" and an end of line; a face is no shorter.
    if (n_vertices / 2 + n_faces / 2 > n_bytes)
        throw MeshError(name + ": the file is damaged: it promises " + std::to_string(n_vertices) + " vertices and " +
                        std::to_string(n_faces) + " faces in " + std::to_string(n_bytes) + " bytes. Write the mesh again.");
}

bool read_off(const std::string& name, const std::string& contents, PolygonSoup& soup) {
    auto head = stream_of(contents);
    const CGAL::File_scanner_OFF scanner(head);
    if (head.fail()) return false;
    check_counts(name, contents.size(), scanner.size_of_vertices(), scanner.size_of_facets());
    auto stream = stream_of(contents);
    return CGAL::IO::read_OFF(stream, soup.points, soup.polygons, CGAL::parameters::verbose(false));
}

/// The vertices and the faces alone: CGAL 5.5 gives up on statements that it does not know, lines and points among them.
std::string vertices_and_faces(const std::string& contents, std::int32_t& n_ignored) {
    std::string kept;
    kept.reserve(contents.size());
    for (std::size_t begin = 0; begin < contents.size();) {
        const std::size_t end = std::min(contents.find('\n', begin), contents.size());
        std::string_view line(contents.data() + begin, end - begin);
        begin = end + 1;
        line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
        const std::string_view keyword = line.substr(0, line.find_first_of(" \t\r"));
        if (keyword == "l" || keyword == "p") ++n_ignored;
        if (keyword == "v" || keyword == "f") kept.append(line).push_back('\n');
    }
    return kept;
}

bool read_obj(const std::string& contents, PolygonSoup& soup, std::int32_t& n_ignored) {
    auto stream = stream_of(vertices_and_faces(contents, n_ignored));
    return CGAL::IO::read_OBJ(stream, soup.points, soup.polygons, CGAL::parameters::verbose(false));
}

bool read_ply(const std::string& contents, PolygonSoup& soup) {
    auto stream = stream_of(contents);
    return CGAL::IO::read_PLY(stream, soup.points, soup.polygons, CGAL::parameters::verbose(false));
}

constexpr std::size_t stl_head = 84, stl_triangle = 50;  ///< bytes of a binary STL file

/// 4 bytes at that position, the smallest first.
template <class Value>
Value value_at(const std::string& contents, std::size_t position) {
    std::uint32_t bits = 0;
    for (std::size_t i = 4; i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(contents[position + i]);
    Value value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// Some binary files begin with "solid" too, but then their length gives them away.
bool is_ascii_stl(const std::string& contents) {
    if (contents.size() >= stl_head &&
        contents.size() == stl_head + stl_triangle * std::size_t{value_at<std::uint32_t>(contents, 80)})
        return false;
    const std::size_t start = std::min(contents.find_first_not_of(" \t\r\n"), contents.size());
    return contents.compare(start, 5, "solid") == 0;
}

/// Not through CGAL, whose map from places to vertices takes a NaN for some other vertex.
void read_binary_stl(const std::string& name, const std::string& contents, SurfaceMesh& mesh) {
    if (contents.size() < stl_head)
        throw MeshError(name + ": is no STL file: it has " + std::to_string(contents.size()) +
                        " bytes, does not begin with 'solid', and the head of a binary one alone has 84. Write the mesh "
                        "again.");
    const std::size_t n_triangles = value_at<std::uint32_t>(contents, 80);
    if (contents.size() < stl_head + stl_triangle * n_triangles)
        throw MeshError(name + ": the file is truncated: " + std::to_string(n_triangles) + " triangles need " +
                        std::to_string(stl_head + stl_triangle * n_triangles) + " bytes, it has " +
                        std::to_string(contents.size()) + ". Write the mesh again.");
    if (3 * n_triangles > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw MeshError(name + ": has " + std::to_string(n_triangles) +
                        " triangles, at most 715827882 are allowed. Coarsen the surface.");
    for (std::size_t triangle = 0; triangle < n_triangles; ++triangle) {
        std::array<std::int32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t position = stl_head + stl_triangle * triangle + 12 * (i + 1);  // behind the normal
            corners[i] = static_cast<std::int32_t>(mesh.vertices.size());
            mesh.vertices.push_back({value_at<float>(contents, position), value_at<float>(contents, position + 4),
                                     value_at<float>(contents, position + 8)});
        }
        mesh.faces.append(corners);
    }
}

bool read_ascii_stl(const std::string& contents, PolygonSoup& soup) {
    auto stream = stream_of(contents);
    return CGAL::IO::read_STL(stream, soup.points, soup.polygons, CGAL::parameters::verbose(false));
}

bool read_with_cgal(const std::string& name, const std::string& extension, const std::string& contents, PolygonSoup& soup,
                    std::int32_t& n_ignored) {
    if (extension == ".off") return read_off(name, contents, soup);
    if (extension == ".obj") return read_obj(contents, soup, n_ignored);
    if (extension == ".ply") return read_ply(contents, soup);
    return read_ascii_stl(contents, soup);
}

/// What is no index of 32 bits is none of a vertex.
void append(SurfaceMesh& mesh, const PolygonSoup& soup) {
    for (const Point& point : soup.points) mesh.vertices.push_back({point.x(), point.y(), point.z()});
    std::vector<std::int32_t> corners;
    for (const auto& polygon : soup.polygons) {
        corners.clear();
        for (const std::size_t v : polygon)
            corners.push_back(v < soup.points.size() ? static_cast<std::int32_t>(v)
                                                     : static_cast<std::int32_t>(std::min<std::size_t>(
                                                           v, std::numeric_limits<std::int32_t>::max())));
        mesh.faces.append(corners);
    }
}

[[noreturn]] void refuse(const std::string& name, const std::string& extension, const std::string& reason) {
    throw MeshError(name + ": cannot be read as " + extension + ": " + reason +
                    ". See that the file is whole, and write the mesh again.");
}

}  // namespace

SurfaceMesh read_polygon_file(const std::filesystem::path& path, const std::string& extension) {
    const std::string contents = file_contents(path);
    SurfaceMesh mesh;
    mesh.name = path.string();
    if (extension == ".stl" && !is_ascii_stl(contents)) {
        read_binary_stl(mesh.name, contents, mesh);
        return mesh;
    }
    PolygonSoup soup;
    try {
        if (!read_with_cgal(mesh.name, extension, contents, soup, mesh.n_ignored_elements))
            refuse(mesh.name, extension,
                   "behind " + std::to_string(soup.points.size()) + " vertices and " + std::to_string(soup.polygons.size()) +
                       " faces it ends early, holds a word where a number should be, or names a vertex that is not there");
    } catch (const MeshError&) {
        throw;
    } catch (const std::exception& error) {
        refuse(mesh.name, extension, error.what());
    }
    append(mesh, soup);
    return mesh;
}

}  // namespace abut::mesh
