#include <cmath>

#include "abut/base/counted.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

constexpr const char* correct_line = "Correct the line, or write the mesh again.";

/// One line per vertex and per face; colours, normals and textures behind them are numbers that are not read.
class OffReader {
public:
    OffReader(SurfaceMesh& mesh, std::string_view text)
        : mesh_(mesh), n_bytes_(text.size()), words_(mesh.name, text, {.comment = '#'}) {}

    void read() {
        read_head();
        for (std::int64_t i = 0; i < n_vertices_; ++i) read_vertex(i);
        for (std::int64_t i = 0; i < n_faces_; ++i) read_face(i);
        if (!words_.next().empty())
            mesh_.warnings.push_back("line " + std::to_string(words_.line()) + ": what follows " +
                                     counted(n_faces_, "face") + ", as many as the head promises, is not read");
    }

private:
    /// [ST][C][N][4]OFF, then the numbers of vertices, faces and edges; the last may be missing.
    void read_head() {
        const std::string_view keyword = words_.next();
        std::string_view kind = keyword;
        for (const std::string_view letters : {"ST", "C", "N", "4"})
            if (kind.starts_with(letters)) {
                kind.remove_prefix(letters.size());
                is_homogeneous_ = letters == "4";
            }
        if (kind != "OFF") words_.refuse("the file does not begin with OFF, COFF, NOFF, STOFF or 4OFF", "Save it as OFF.");
        std::string_view word = words_.next();
        if (word == "BINARY") words_.refuse("binary OFF is not read", "Save the mesh as text OFF, or as PLY or STL.");
        n_vertices_ = read_count(word, "the number of vertices");
        const std::size_t line = words_.line();
        n_faces_ = read_count(words_.next(), "the number of faces");
        word = words_.line() == line ? words_.next_in_line() : words_.next();
        if (!word.empty()) (void)words_.whole_number(word, "the number of edges");
        words_.skip_line();
        // "0 0 0" and the end of its line; "0" and the end of its line.
        if (n_vertices_ > (n_bytes_ + 1) / 6 || n_faces_ > (n_bytes_ + 1) / 2)
            throw MeshError(mesh_.name + ": line " + std::to_string(line) + ": the file is damaged: it promises " +
                            counted(n_vertices_, "vertex", "vertices") + " and " + counted(n_faces_, "face") + " in " +
                            std::to_string(n_bytes_) + " bytes. Write the mesh again.");
    }
    std::int64_t read_count(std::string_view word, const char* what) {
        const std::int64_t count = words_.whole_number(word, what);
        if (count < 0)
            words_.refuse(std::string(what) + " is " + std::to_string(count) + ", at least 0 is needed", correct_line);
        return count;
    }
    void skip_numbers() {
        for (auto word = words_.next_in_line(); !word.empty(); word = words_.next_in_line())
            (void)words_.number(word, "a colour, a normal or a texture");
    }
    [[nodiscard]] std::string_view first_word(const char* what, std::int64_t i, std::int64_t promised) {
        const std::string_view word = words_.next();
        if (word.empty())
            words_.refuse("the file is truncated: it ends before " + std::string(what) + " " + std::to_string(i) + " of " +
                          std::to_string(promised));
        return word;
    }
    void read_vertex(std::int64_t i) {
        Vector<3> vertex;
        std::string_view word = first_word("vertex", i, n_vertices_);
        for (double& x : vertex) {
            x = words_.number(word, "a coordinate");
            if (!std::isfinite(x))
                words_.refuse("a coordinate of vertex " + std::to_string(i) + " is no finite number", correct_line);
            if (&x != &vertex[2]) word = words_.next_in_line();
        }
        if (is_homogeneous_) {
            const double weight = words_.number(words_.next_in_line(), "a weight");
            vertex /= weight;
            if (!vertex.allFinite())
                words_.refuse(
                    "vertex " + std::to_string(i) + " has no finite place: its weight is " + std::to_string(weight),
                    correct_line);
        }
        skip_numbers();
        mesh_.vertices.push_back(vertex);
    }
    void read_face(std::int64_t i) {
        const std::int64_t n_corners = read_count(first_word("face", i, n_faces_), "the number of corners of a face");
        corners_.clear();
        for (std::int64_t k = 0; k < n_corners; ++k) {
            const std::string_view word = words_.next_in_line();
            if (word.empty())
                words_.refuse("face " + std::to_string(i) + " has " + std::to_string(n_corners) +
                                  " corners, its line names " + std::to_string(k),
                              correct_line);
            const std::int64_t vertex = words_.whole_number(word, "a vertex");
            if (vertex < 0 || vertex >= n_vertices_)
                words_.refuse("face " + std::to_string(i) + " names vertex " + std::to_string(vertex) + ", the file has " +
                                  std::to_string(n_vertices_) + ", counted from 0",
                              correct_line);
            corners_.push_back(static_cast<std::int32_t>(vertex));
        }
        skip_numbers();
        mesh_.faces.append(corners_);
    }

    SurfaceMesh& mesh_;
    std::int64_t n_bytes_;
    TextWords words_;
    std::int64_t n_vertices_ = 0, n_faces_ = 0;
    bool is_homogeneous_ = false;
    std::vector<std::int32_t> corners_;
};

}  // namespace

SurfaceMesh read_off_surface(const std::filesystem::path& path) {
    const std::string contents = file_contents(path);
    SurfaceMesh mesh;
    mesh.name = path.string();
    OffReader(mesh, contents).read();
    return mesh;
}

}  // namespace abut::mesh
