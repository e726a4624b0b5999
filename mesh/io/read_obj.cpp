#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

constexpr const char* correct = "Correct the line, or write the mesh again.";

/// Statements without a face of a surface: data of vertices that are not read, names, display, free-form curves.
constexpr std::array known_statements = {
    "vt",     "vn",    "vp",       "o",          "g",         "s",     "mg",   "usemtl", "mtllib", "usemap",
    "maplib", "bevel", "c_interp", "d_interp",   "lod",       "call",  "csh",  "deg",    "bmat",   "step",
    "cstype", "parm",  "trim",     "hole",       "scrv",      "sp",    "end",  "con",    "bsp",    "bzp",
    "cdc",    "cdp",   "res",      "shadow_obj", "trace_obj", "ctech", "stech"};
/// Elements that are no polygons.
constexpr std::array other_elements = {"l", "p", "curv", "curv2", "surf"};

template <class List>
bool holds(const List& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

class ObjReader {
public:
    ObjReader(SurfaceMesh& mesh, std::string_view text)
        : mesh_(mesh), words_(mesh.name, text, {.comment = '#', .has_continuations = true}) {}

    void read() {
        for (auto word = words_.next(); !word.empty(); word = words_.next()) read_statement(word);
        if (largest_index_ > n_vertices())
            throw MeshError(mesh_.name + ": line " + std::to_string(largest_line_) + ": the face names vertex " +
                            std::to_string(largest_index_) + ", the file has " + std::to_string(n_vertices()) + ". " +
                            correct);
        if (n_unknown_ > 0)
            mesh_.warnings.push_back("line " + std::to_string(unknown_line_) +
                                     " begins with no statement of an OBJ file; lines of that kind that were skipped: " +
                                     std::to_string(n_unknown_));
    }

private:
    [[nodiscard]] std::int64_t n_vertices() const { return static_cast<std::int64_t>(mesh_.vertices.size()); }

    void read_statement(std::string_view keyword) {
        if (keyword == "v") return read_vertex();
        if (keyword == "f" || keyword == "fo") return read_face();
        if (holds(other_elements, keyword))
            ++mesh_.n_ignored_elements;
        else if (!holds(known_statements, keyword) && n_unknown_++ == 0)
            unknown_line_ = words_.line();  // the first
        words_.skip_line();
    }
    /// Behind the coordinates may come a weight or a colour: numbers, too.
    void read_vertex() {
        Vector<3> vertex;
        for (double& x : vertex) {
            x = words_.number(words_.next_in_line(), "a coordinate");
            if (!std::isfinite(x)) words_.refuse("a coordinate is no finite number", correct);
        }
        for (auto word = words_.next_in_line(); !word.empty(); word = words_.next_in_line())
            (void)words_.number(word, "a weight or a colour");
        mesh_.vertices.push_back(vertex);
    }
    void read_face() {
        corners_.clear();
        for (auto word = words_.next_in_line(); !word.empty(); word = words_.next_in_line())
            corners_.push_back(corner(word));
        mesh_.faces.append(corners_);
    }
    /// "7", "7/1", "7//3", "7/1/3", or from the end of what has been read so far, "-1". Vertices may follow the face that
    /// names them: whether they are there is looked at in the end.
    std::int32_t corner(std::string_view word) {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const auto index = whole_number_in(word.substr(0, slash));
        if (!index || *index == 0 || !are_indices(word.substr(slash)))
            words_.refuse(in_quotes(word) +
                              " is no corner of a face: its vertex, counted from 1 (or from the end, -1), is needed, "
                              "like 7, 7/1, 7//3 or 7/1/3",
                          correct);
        if (*index < -n_vertices())
            words_.refuse("the face names vertex " + std::to_string(*index) + ", before it the file has " +
                              std::to_string(n_vertices()),
                          correct);
        if (*index > largest_index_) {
            largest_index_ = *index;
            largest_line_ = words_.line();
        }
        const std::int64_t vertex = *index < 0 ? n_vertices() + *index : *index - 1;
        return static_cast<std::int32_t>(std::min<std::int64_t>(vertex, std::numeric_limits<std::int32_t>::max()));
    }
    /// Whether these are indices of texture and normal: at most two, "/1/3", each may be missing.
    static bool are_indices(std::string_view rest) {
        for (int i = 0; i < 2 && !rest.empty(); ++i) {
            const std::size_t end = std::min(rest.find('/', 1), rest.size());
            if (end > 1 && !whole_number_in(rest.substr(1, end - 1))) return false;
            rest.remove_prefix(end);
        }
        return rest.empty();
    }

    SurfaceMesh& mesh_;
    TextWords words_;
    std::vector<std::int32_t> corners_;
    std::int64_t largest_index_ = 0;
    std::size_t largest_line_ = 0, unknown_line_ = 0, n_unknown_ = 0;
};

}  // namespace

SurfaceMesh read_obj_surface(const std::filesystem::path& path) {
    const std::string contents = file_contents(path);
    SurfaceMesh mesh;
    mesh.name = path.string();
    ObjReader(mesh, contents).read();
    return mesh;
}

}  // namespace abut::mesh
