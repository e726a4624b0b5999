#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

#include "abut/base/messages.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/local_faces.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/arguments.hpp"
#include "abut/mesh/shapes/estimate.hpp"
#include "abut/mesh/shapes/shapes.hpp"

namespace abut::mesh {
namespace {

template <int Dim>
using GridPoint = std::array<int, Dim>;  ///< in half bricks: corners are even, centres odd

using LocalCell = std::vector<std::int32_t>;

/// Cells that a brick is cut into, by the brick's own vertices, 0 .. 3 or 0 .. 7 in the order of quadrangle and hexahedron;
/// 8 is its centre.
std::vector<LocalCell> pieces_of_brick(CellShape shape) {
    switch (shape) {
        case CellShape::quadrangle:
            return {{0, 1, 2, 3}};
        case CellShape::triangle:
            return {{0, 1, 2}, {0, 2, 3}};
        case CellShape::hexahedron:
            return {{0, 1, 2, 3, 4, 5, 6, 7}};
        case CellShape::prism:
            return {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
        case CellShape::tetrahedron:  // six around the diagonal 0-6: diagonals of opposite faces are parallel
            return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
        case CellShape::pyramid:
            break;
    }
    std::vector<LocalCell> pieces;
    for (int i = 0; i < n_faces(CellShape::hexahedron); ++i) {
        const auto face = face_vertices(CellShape::hexahedron, i);
        pieces.push_back({face[0], face[3], face[2], face[1], 8});
    }
    return pieces;
}

/// A grid of bricks while it is being filled.
template <int Dim>
class Grid {
public:
    Grid(const Vector<Dim>& lower, const Vector<Dim>& upper, const std::array<int, Dim>& counts, CellShape shape,
         const std::string& name)
        : lower_(lower), upper_(upper), counts_(counts), pieces_(pieces_of_brick(shape)), shape_(shape) {
        soup_.name = name;
        soup_.body_names = {name};
        soup_.group_names = {"xmin", "xmax", "ymin", "ymax"};
        if (Dim == 3) soup_.group_names.insert(soup_.group_names.end(), {"zmin", "zmax"});
        add_corners();
    }

    CellSoup<Dim> filled() && {
        for_each(counts_, [&](const GridPoint<Dim>& brick) { add_brick(brick); });
        return std::move(soup_);
    }

private:
    template <class Visitor>
    static void for_each(const std::array<int, Dim>& counts, Visitor&& visit) {
        GridPoint<Dim> at{};
        for (at[Dim - 1] = 0; at[Dim - 1] < counts[Dim - 1]; ++at[Dim - 1])
            for (at[Dim - 2] = 0; at[Dim - 2] < counts[Dim - 2]; ++at[Dim - 2]) {
                if constexpr (Dim == 2)
                    visit(at);
                else
                    for (at[0] = 0; at[0] < counts[0]; ++at[0]) visit(at);
            }
    }

    void add_corners() {
        std::array<int, Dim> corners = counts_;
        for (int& n : corners) ++n;
        for_each(corners, [&](GridPoint<Dim> at) {
            for (int& i : at) i *= 2;
            add_vertex(at);
        });
    }

    std::int32_t add_vertex(const GridPoint<Dim>& at) {
        Vector<Dim> x;
        for (int i = 0; i < Dim; ++i) {
            const double t = at[static_cast<std::size_t>(i)] / (2.0 * counts_[static_cast<std::size_t>(i)]);
            x[i] = (1.0 - t) * lower_[i] + t * upper_[i];
        }
        soup_.vertices.push_back(x);
        grid_.push_back(at);
        return static_cast<std::int32_t>(soup_.vertices.size()) - 1;
    }

    /// Number of a corner: that in which for_each visits it.
    std::int32_t corner(const GridPoint<Dim>& at) const {
        if constexpr (Dim == 2)
            return at[0] + at[1] * (counts_[0] + 1);
        else
            return at[0] + (counts_[0] + 1) * (at[1] + (counts_[1] + 1) * at[2]);
    }

    std::vector<std::int32_t> vertices_of_brick(const GridPoint<Dim>& brick) {
        constexpr std::array<std::array<int, 2>, 4> around = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        std::vector<std::int32_t> vertices;
        for (int layer = 0; layer < (Dim == 3 ? 2 : 1); ++layer)
            for (const auto& [dx, dy] : around) {
                GridPoint<Dim> at = brick;
                at[0] += dx;
                at[1] += dy;
                if constexpr (Dim == 3) at[2] += layer;
                vertices.push_back(corner(at));
            }
        if (shape_ == CellShape::pyramid) {
            GridPoint<Dim> centre = brick;
            for (int& i : centre) i = 2 * i + 1;
            vertices.push_back(add_vertex(centre));
        }
        return vertices;
    }

    void add_brick(const GridPoint<Dim>& brick) {
        const auto vertices = vertices_of_brick(brick);
        for (const LocalCell& piece : pieces_) {
            LocalCell cell;
            for (const std::int32_t local : piece) cell.push_back(vertices[static_cast<std::size_t>(local)]);
            soup_.cell_vertices.append(cell);
            soup_.cell_shape.push_back(shape_);
            soup_.cell_body.push_back(0);
            add_named_faces(cell);
        }
    }

    void add_named_faces(const LocalCell& cell) {
        for (int i = 0; i < n_faces(shape_); ++i) {
            const LocalFace face = local_face(cell, shape_, i);
            for (std::int32_t side = 0; side < 2 * Dim; ++side)
                if (lies_on(face.view(), side))
                    soup_.named_faces.push_back({{face.view().begin(), face.view().end()}, side});
        }
    }

    bool lies_on(std::span<const std::int32_t> face, std::int32_t side) const {
        const auto axis = static_cast<std::size_t>(side / 2);
        const int wanted = side % 2 == 0 ? 0 : 2 * counts_[axis];
        for (const std::int32_t vertex : face)
            if (grid_[static_cast<std::size_t>(vertex)][axis] != wanted) return false;
        return true;
    }

    Vector<Dim> lower_, upper_;
    std::array<int, Dim> counts_;
    std::vector<LocalCell> pieces_;
    CellShape shape_;
    CellSoup<Dim> soup_;
    std::vector<GridPoint<Dim>> grid_;  ///< of each vertex
};

template <int Dim>
void check_grid(const Vector<Dim>& lower, const Vector<Dim>& upper, const std::array<int, Dim>& counts, CellShape shape,
                const std::string& name, const MeshOptions& options) {
    for (std::size_t i = 0; i < Dim; ++i) {
        require_count(name, ("counts[" + std::to_string(i) + "]").c_str(), counts[i], 1);
        const double side = upper[static_cast<std::ptrdiff_t>(i)] - lower[static_cast<std::ptrdiff_t>(i)];
        if (!(side > 0.0) || !std::isfinite(side))
            throw MeshError(name + ": the box is " + number(side) + " m long along " + "xyz"[i] +
                            ", a finite length above 0 is needed. Swap lower and upper.");
    }
    const double bricks = std::accumulate(counts.begin(), counts.end(), 1.0, std::multiplies<>());
    check_estimate(name, bricks * static_cast<double>(pieces_of_brick(shape).size()), most_structured_cells, options,
                   "Lower the counts");
    if (dimension(shape) != Dim)
        throw MeshError(name + ": a " + std::string(abut::mesh::name(shape)) + " cannot fill a box of dimension " +
                        std::to_string(Dim) + ". Choose another shape.");
}

}  // namespace

template <int Dim>
Mesh<Dim> structured_box(const Vector<Dim>& lower, const Vector<Dim>& upper, const std::array<int, Dim>& counts,
                         CellShape shape, const std::string& name, const MeshOptions& mesh_options) {
    check_grid<Dim>(lower, upper, counts, shape, name, mesh_options);
    return build_mesh(Grid<Dim>(lower, upper, counts, shape, name).filled(), mesh_options);
}

Mesh<2> fan_disc(const Vector<2>& centre, double radius, int n_sectors, double turn, const std::string& name,
                 const MeshOptions& mesh_options) {
    require_count(name, "n_sectors", n_sectors, 3);
    check_estimate(name, n_sectors, most_structured_cells, mesh_options, "Lower the number of sectors");
    require_length(name, "radius", radius);
    CellSoup<2> soup;
    soup.name = name;
    soup.body_names = {name};
    soup.group_names = {"boundary"};
    soup.vertices.push_back(centre);
    for (int i = 0; i < n_sectors; ++i) {
        const double angle = turn + 2.0 * std::numbers::pi * i / n_sectors;
        soup.vertices.push_back(centre + radius * Vector<2>(std::cos(angle), std::sin(angle)));
        const std::int32_t next = 1 + (i + 1) % n_sectors;
        soup.cell_vertices.append(std::array<std::int32_t, 3>{0, i + 1, next});
        soup.cell_shape.push_back(CellShape::triangle);
        soup.cell_body.push_back(0);
        soup.named_faces.push_back({{i + 1, next}, 0});
    }
    return build_mesh(std::move(soup), mesh_options);
}

template Mesh<2> structured_box<2>(const Vector<2>&, const Vector<2>&, const std::array<int, 2>&, CellShape,
                                   const std::string&, const MeshOptions&);
template Mesh<3> structured_box<3>(const Vector<3>&, const Vector<3>&, const std::array<int, 3>&, CellShape,
                                   const std::string&, const MeshOptions&);

}  // namespace abut::mesh
