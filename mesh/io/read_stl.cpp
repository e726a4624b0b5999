#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>

#include "abut/base/counted.hpp"
#include "abut/mesh/io/binary_values.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

constexpr std::size_t stl_head = 84, stl_triangle = 50;  ///< bytes of a binary STL file

/// A keyword in small letters: files in capitals are about as old as the format.
std::string keyword(std::string_view word) {
    std::string small(word);
    std::ranges::transform(small, small.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return small;
}

/// Some binary files begin with "solid" too, but then their length gives them away.
bool is_ascii_stl(const std::string& contents) {
    if (contents.size() >= stl_head && contents.size() == stl_head + stl_triangle * std::size_t{binary_value<std::uint32_t>(
                                                                                        contents, 80, ByteOrder::little)})
        return false;
    const std::size_t start = std::min(contents.find_first_not_of("\xEF\xBB\xBF \t\r\n"), contents.size());
    return keyword(std::string_view(contents).substr(start, 5)) == "solid";
}

void read_binary_stl(const std::string& contents, SurfaceMesh& mesh) {
    const std::string& name = mesh.name;
    if (contents.size() < stl_head)
        throw MeshError(name + ": is no STL file: it has " + std::to_string(contents.size()) +
                        " bytes, does not begin with 'solid', and the head of a binary one alone has 84. Write the mesh "
                        "again.");
    const std::size_t n_triangles = binary_value<std::uint32_t>(contents, 80, ByteOrder::little);
    if (contents.size() < stl_head + stl_triangle * n_triangles)
        throw MeshError(
            name + ": the file is truncated: " + counted(std::int64_t(n_triangles), "triangle needs", "triangles need") +
            " " + std::to_string(stl_head + stl_triangle * n_triangles) + " bytes, it has " +
            std::to_string(contents.size()) + ". Write the mesh again.");
    if (3 * n_triangles > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
        throw MeshError(name + ": has " + std::to_string(n_triangles) +
                        " triangles, at most 715827882 are allowed. Coarsen the surface.");
    for (std::size_t triangle = 0; triangle < n_triangles; ++triangle) {
        std::array<std::int32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t position = stl_head + stl_triangle * triangle + 12 * (i + 1);  // behind the normal
            corners[i] = static_cast<std::int32_t>(mesh.vertices.size());
            Vector<3> vertex;
            for (std::size_t k = 0; k < 3; ++k)
                vertex[static_cast<std::ptrdiff_t>(k)] = binary_value<float>(contents, position + 4 * k, ByteOrder::little);
            mesh.vertices.push_back(vertex);
        }
        mesh.faces.append(corners);
    }
}

/// solid <name>, then facet normal x y z, outer loop, vertex x y z (three times), endloop, endfacet, and so on, endsolid
/// <name>; another solid may follow.
class AsciiStlReader {
public:
    AsciiStlReader(SurfaceMesh& mesh, std::string_view text) : mesh_(mesh), words_(mesh.name, text, {}) {}

    void read() {
        bool inside = false, ended = false;
        for (auto text = words_.next(); !text.empty(); text = words_.next()) {
            const std::string word = keyword(text);
            if (word == "solid" || word == "endsolid") {
                inside = word == "solid";
                ended = ended || !inside;
                words_.skip_line();  // its name
            } else if (word == "facet") {
                read_facet();
            } else if (word == "vertex" || word == "endfacet" || word == "endloop") {
                words_.refuse(in_quotes(text) + " stands outside a facet");
            }
        }
        if (inside || !ended)
            words_.refuse("the file is truncated: 'endsolid' is missing behind " + std::to_string(mesh_.faces.size()) +
                          " facets");
    }

private:
    [[nodiscard]] std::string facet() const { return "facet " + std::to_string(mesh_.faces.size()) + ": "; }

    void read_facet() {
        std::array<std::int32_t, 3> corners{};
        std::size_t n_corners = 0;
        auto text = words_.next();
        for (; !text.empty() && keyword(text) != "endfacet"; text = words_.next()) {
            const std::string word = keyword(text);
            if (word == "normal") {
                for (int i = 0; i < 3; ++i) (void)words_.next();  // not read, whatever it says
            } else if (word == "vertex") {
                if (n_corners == 3) words_.refuse(facet() + "it has more than 3 vertices");
                corners[n_corners++] = read_vertex();
            } else if (word != "outer" && word != "loop" && word != "endloop") {
                words_.refuse(facet() + in_quotes(text) + " is no word of a facet");
            }
        }
        if (text.empty()) words_.refuse(facet() + "the file is truncated, 'endfacet' is missing");
        if (n_corners != 3) words_.refuse(facet() + "it has " + std::to_string(n_corners) + " vertices, 3 are needed");
        mesh_.faces.append(corners);
    }
    std::int32_t read_vertex() {
        Vector<3> vertex;
        for (double& x : vertex) x = words_.number(words_.next(), "a coordinate");
        mesh_.vertices.push_back(vertex);
        return static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
    }

    SurfaceMesh& mesh_;
    TextWords words_;
};

}  // namespace

SurfaceMesh read_stl_surface(const std::filesystem::path& path) {
    const std::string contents = file_contents(path);
    SurfaceMesh mesh;
    mesh.name = path.string();
    if (is_ascii_stl(contents))
        AsciiStlReader(mesh, contents).read();
    else
        read_binary_stl(contents, mesh);
    return mesh;
}

}  // namespace abut::mesh
