#include "abut/mesh/io/vtk_input.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <string_view>
#include <utility>

#include "abut/base/counted.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/text_words.hpp"
#include "abut/mesh/io/vtk_file.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

using Node = VtkFile::Node;

/// A kind of cells in a piece: the section that holds them, the attribute that counts them and, where the section does not
/// say it, their type.
struct CellKind {
    const char *section, *count;
    VtkCell type;
};
constexpr std::array<CellKind, 1> kinds_of_grid = {{{"Cells", "NumberOfCells", vtk_empty_cell}}};
constexpr std::array<CellKind, 4> kinds_of_poly_data = {{{"Verts", "NumberOfVerts", vtk_poly_vertex},
                                                         {"Lines", "NumberOfLines", vtk_poly_line},
                                                         {"Polys", "NumberOfPolys", vtk_polygon},
                                                         {"Strips", "NumberOfStrips", vtk_triangle_strip}}};

/// Tuples [begin, end) of arrays behind those of others of the same names, or as the first ones.
void append_tuples(std::vector<VtkArray>& arrays, const std::vector<VtkArray>& more, std::size_t begin, std::size_t end) {
    if (arrays.empty())
        for (const VtkArray& array : more) arrays.push_back({array.name, array.n_components, {}});
    for (std::size_t i = 0; i < more.size(); ++i) {
        const auto at = [&](std::size_t tuple) {
            return more[i].values.begin() + static_cast<std::ptrdiff_t>(tuple * more[i].n_components);
        };
        arrays[i].values.insert(arrays[i].values.end(), at(begin), at(end));
    }
}

bool are_alike(const std::vector<VtkArray>& a, const std::vector<VtkArray>& b) {
    return std::ranges::equal(a, b, [](const VtkArray& one, const VtkArray& other) {
        return one.name == other.name && one.n_components == other.n_components;
    });
}

/// The pieces of a file, one after the other.
class Reader {
public:
    Reader(const std::string& name, std::string_view contents, VtkKind kind)
        : file_(name, contents, kind), is_grid_(kind == VtkKind::unstructured_grid) {}

    VtkGrid read() {
        const Node grid = file_.grid();
        for (const Node field : grid.children("FieldData"))
            for (const Node array : field.children("DataArray")) read_number_of_body(array);
        const auto pieces = grid.children("Piece");
        has_one_piece_ = std::distance(pieces.begin(), pieces.end()) == 1;
        for (const Node piece : pieces) read_piece(piece);
        join_cells();
        return std::move(grid_);
    }

private:
    /// All pieces together: each has points and cells of its own. No point and no cell takes less than a byte.
    std::size_t count_of_piece(Node piece, const char* key) {
        const double n = file_.count(piece, key, 0.0);
        n_in_all_ += n;
        if (n_in_all_ > file_.n_bytes_at_most())
            file_.refuse_damage(
                piece, "it promises " + count_text(n) + " as " + key + " in " + count_text(file_.n_bytes()) + " bytes");
        return static_cast<std::size_t>(n);
    }

    void read_number_of_body(Node array) {
        const std::size_t n = file_.n_values(array, file_.count(array, "NumberOfTuples", 0.0));
        const std::string name = array.attribute("Name").value();
        if (n == 1 && name.starts_with(body_prefix))
            grid_.body_numbers.push_back(
                {name.substr(std::string_view(body_prefix).size()), 1, file_.values<double>(array, 1)});
    }

    void read_piece(Node piece) {
        const std::span<const CellKind> kinds =
            is_grid_ ? std::span<const CellKind>(kinds_of_grid) : std::span<const CellKind>(kinds_of_poly_data);
        const std::size_t n_points = count_of_piece(piece, "NumberOfPoints");
        std::array<std::size_t, 4> n{};
        for (std::size_t i = 0; i < kinds.size(); ++i) n[i] = count_of_piece(piece, kinds[i].count);
        const std::size_t n_cells = n[0] + n[1] + n[2] + n[3];
        if (!has_one_piece_ && n_points + n_cells == 0) return;  // may have other arrays than the rest

        const auto point_data = arrays_of(piece.child("PointData"), n_points);
        const auto cell_data = arrays_of(piece.child("CellData"), n_cells);
        if (!is_first_ && !(are_alike(point_data, grid_.point_data) && are_alike(cell_data, grid_.cell_data)))
            file_.refuse(piece, "the arrays of this piece are not those of the first one");
        is_first_ = false;
        append_tuples(grid_.point_data, point_data, 0, n_points);
        append_tuples(grid_.cell_data, cell_data, 0, 0);
        const std::size_t first_point = grid_.points.size();
        if (n_points > 0) read_points(piece, n_points);
        std::size_t begin = 0;
        for (std::size_t i = 0; i < kinds.size(); ++i) {
            append_tuples(cells_[i].cell_data, cell_data, begin, begin + n[i]);
            if (n[i] > 0) read_cells(piece, kinds[i], n[i], first_point, cells_[i]);
            begin += n[i];
        }
    }
    void read_points(Node piece, std::size_t n_points) {
        const auto arrays = file_.first_step_of(piece.child("Points"));
        if (arrays.empty()) file_.refuse(piece, "<Points> holds no array");
        const auto x = file_.values<double>(arrays[0], n_points);
        if (x.size() != 3 * n_points)
            file_.refuse(arrays[0], counted(std::int64_t(n_points), "point has", "points have") + " " +
                                        counted(std::int64_t(x.size()), "coordinate") + ", 3 of each are needed");
        for (std::size_t i = 0; i < n_points; ++i) grid_.points.emplace_back(x[3 * i], x[3 * i + 1], x[3 * i + 2]);
        if (grid_.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
            throw MeshError(file_.name() + ": has " + std::to_string(grid_.points.size()) +
                            " points, at most 2147483647 are allowed. Coarsen the mesh.");
    }
    void read_cells(Node piece, const CellKind& kind, std::size_t n, std::size_t first_point, VtkGrid& cells) {
        const auto arrays = file_.first_step_of(piece.child(kind.section));
        const auto array = [&](std::string_view wanted) {
            const auto found =
                std::ranges::find_if(arrays, [&](Node node) { return node.attribute("Name").value() == wanted; });
            if (found == arrays.end())
                file_.refuse(piece, std::string("<") + kind.section + "> holds no array '" + std::string(wanted) + "'");
            return *found;
        };
        const Node offsets = array("offsets"), connectivity = array("connectivity");
        const auto ends = file_.values<std::int64_t>(offsets, n);
        const auto types = kind.type == vtk_empty_cell ? file_.values<std::int64_t>(array("types"), n)
                                                       : std::vector<std::int64_t>(n, kind.type);
        for (std::size_t i = 0; i < n; ++i)
            if (ends[i] < (i == 0 ? 0 : ends[i - 1]) || static_cast<double>(ends[i]) > file_.n_bytes_at_most())
                file_.refuse_damage(offsets, "the offset " + std::to_string(ends[i]) +
                                                 " is none of vertices of cells in a file of " +
                                                 count_text(file_.n_bytes()) + " bytes");
        const auto corners = file_.values<std::int64_t>(connectivity, static_cast<std::size_t>(ends.back()));
        const std::int64_t before = std::ssize(cells.corners);
        for (const std::int64_t end : ends) cells.cell_ends.push_back(before + end);
        for (const std::int64_t corner : corners) {
            const bool is_there = corner >= 0 && corner < std::ssize(grid_.points) - static_cast<std::int64_t>(first_point);
            if (!is_there && !has_one_piece_)
                file_.refuse(connectivity, "a cell has the point " + std::to_string(corner) + ", the piece has " +
                                               std::to_string(grid_.points.size() - first_point));
            cells.corners.push_back(is_there ? corner + static_cast<std::int64_t>(first_point) : corner);
        }
        cells.cell_types.insert(cells.cell_types.end(), types.begin(), types.end());
    }
    /// Kind by kind.
    void join_cells() {
        for (VtkGrid& cells : cells_) {
            if (cells.n_cells() == 0) continue;
            if (grid_.n_cells() == 0) {
                std::swap(grid_.cell_types, cells.cell_types);
                std::swap(grid_.cell_ends, cells.cell_ends);
                std::swap(grid_.corners, cells.corners);
                std::swap(grid_.cell_data, cells.cell_data);
                continue;
            }
            const std::int64_t before = std::ssize(grid_.corners);
            for (const std::int64_t end : cells.cell_ends) grid_.cell_ends.push_back(before + end);
            grid_.corners.insert(grid_.corners.end(), cells.corners.begin(), cells.corners.end());
            grid_.cell_types.insert(grid_.cell_types.end(), cells.cell_types.begin(), cells.cell_types.end());
            append_tuples(grid_.cell_data, cells.cell_data, 0, cells.n_cells());
        }
    }

    std::vector<VtkArray> arrays_of(Node section, std::size_t n_tuples) {
        std::vector<VtkArray> arrays;
        for (const Node node : file_.first_step_of(section))
            arrays.push_back({node.attribute("Name").value(),
                              static_cast<std::size_t>(file_.count(node, "NumberOfComponents", 1.0)),
                              file_.values<double>(node, n_tuples)});
        return arrays;
    }

    VtkFile file_;
    bool is_grid_, is_first_ = true, has_one_piece_ = true;
    double n_in_all_ = 0.0;
    VtkGrid grid_;                  ///< without cells, but with the names of their arrays, until the end
    std::array<VtkGrid, 4> cells_;  ///< by their kind
};

}  // namespace

std::span<const std::int64_t> VtkGrid::corners_of(std::size_t cell) const {
    const std::int64_t begin = cell == 0 ? 0 : cell_ends[cell - 1];
    return {corners.data() + begin, static_cast<std::size_t>(cell_ends[cell] - begin)};
}

VtkGrid read_vtk_grid(const std::filesystem::path& path, VtkKind kind) {
    const std::string contents = file_contents(path);
    try {
        return Reader(path.string(), contents, kind).read();
    } catch (const std::bad_alloc&) {
        throw MeshError(path.string() +
                        ": the memory of this machine is too small for what the file holds. See that the file is whole, or "
                        "coarsen the mesh.");
    }
}

std::vector<std::int64_t> body_values(const std::string& name, const VtkGrid& grid) {
    const auto array = std::ranges::find(grid.cell_data, "body", &VtkArray::name);
    std::vector<std::int64_t> values;
    for (std::size_t cell = 0; array != grid.cell_data.end() && cell < grid.n_cells(); ++cell) {
        const double value = array->n_components == 0 ? 0.0 : array->values[cell * array->n_components];
        if (value != std::floor(value) || !(std::abs(value) <= 1e9))
            throw MeshError(name + ": cell " + std::to_string(cell) + " has the body " + number(value) +
                            ", a whole number between -1e9 and 1e9 is needed. Correct the cell array 'body'.");
        values.push_back(static_cast<std::int64_t>(value));
    }
    return values;
}

std::vector<std::string> names_of_bodies(std::vector<std::int64_t>& values, const VtkGrid& grid) {
    const auto name_of = [&grid](std::int64_t value) {
        for (const VtkArray& number : grid.body_numbers)
            if (number.values[0] == static_cast<double>(value)) return number.name;
        return std::string("body_") + std::to_string(value);
    };
    std::vector<std::int64_t> distinct = values;
    sort_unique(distinct);
    for (std::int64_t& value : values) value = std::lower_bound(distinct.begin(), distinct.end(), value) - distinct.begin();
    std::vector<std::string> names;
    for (const std::int64_t value : distinct) names.push_back(name_of(value));
    return names;
}

}  // namespace abut::mesh
