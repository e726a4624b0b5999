#include "abut/contact/surface/cell_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/geometry/cell_faces.hpp"

namespace abut::contact {
namespace {

using geometry::CellFaces;

/// A face of a cell. Corners in increasing order, -1 behind them, are the same for all cells that share it.
struct SideOfFace {
    std::array<std::int32_t, 4> key{-1, -1, -1, -1};
    std::int32_t cell = 0;
    int face = 0;
};

[[noreturn]] void refuse(std::int32_t cell, const std::string& what) {
    throw BadInput("cell " + std::to_string(cell) + " " + what, {.cell = cell});
}

template <int Dim>
class Cells {
public:
    Cells(PointsView<Dim> rest, const HostCells& given) : rest_(rest), given_(given) { check_arrays(); }

    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(given_.offsets.size()) - 1; }
    [[nodiscard]] std::span<const std::int32_t> corners(std::int32_t cell) const {
        const auto begin = given_.offsets[static_cast<std::size_t>(cell)];
        return given_.nodes.subspan(static_cast<std::size_t>(begin),
                                    static_cast<std::size_t>(given_.offsets[static_cast<std::size_t>(cell) + 1] - begin));
    }
    [[nodiscard]] std::int32_t body(std::int32_t cell) const {
        return given_.body.empty() ? 0 : given_.body[static_cast<std::size_t>(cell)];
    }
    [[nodiscard]] const CellFaces& faces(std::int32_t cell) const {
        const auto n = static_cast<int>(corners(cell).size());
        const auto found = std::ranges::find_if(
            geometry::cell_faces, [&](const CellFaces& known) { return known.dimension == Dim && known.n_corners == n; });
        if (found == geometry::cell_faces.end())
            refuse(cell, "has " + std::to_string(n) + " corners; " +
                             (Dim == 2 ? "3 and 4 are allowed in 2D." : "4, 5, 6 and 8 are allowed in 3D."));
        return *found;
    }
    [[nodiscard]] std::vector<std::int32_t> face(std::int32_t cell, int face) const {
        std::vector<std::int32_t> nodes;
        for (const std::int8_t corner : faces(cell).face(face))
            nodes.push_back(corners(cell)[static_cast<std::size_t>(corner)]);
        return nodes;
    }
    [[nodiscard]] Vector<Dim> middle(std::span<const std::int32_t> nodes) const {
        Vector<Dim> sum = Vector<Dim>::Zero();
        for (const std::int32_t node : nodes) sum += rest_[node];
        return sum / static_cast<double>(nodes.size());
    }
    /// Its length is the area of the face; in 2D to the right of the line from the first corner to the second.
    [[nodiscard]] Vector<Dim> area(std::span<const std::int32_t> face) const {
        if constexpr (Dim == 2) {
            const Vector<2> along = rest_[face[1]] - rest_[face[0]];
            return {along[1], -along[0]};
        } else {
            const Vector<3> origin = middle(face);
            Vector<3> twice = Vector<3>::Zero();
            for (std::size_t i = 0; i < face.size(); ++i) {
                const Vector<3> from = rest_[face[i]] - origin, to = rest_[face[(i + 1) % face.size()]] - origin;
                twice += from.cross(to);
            }
            return 0.5 * twice;
        }
    }
    /// How much of the cell lies between its middle and a face, Dim times; negative where the face looks inwards.
    [[nodiscard]] double share(std::int32_t cell, std::span<const std::int32_t> face) const {
        return area(face).dot(middle(face) - middle(corners(cell)));
    }
    [[nodiscard]] double volume(std::int32_t cell) const {
        double sum = 0.0;
        for (int f = 0; f < faces(cell).n_faces; ++f) sum += std::abs(share(cell, face(cell, f)));
        return sum / Dim;
    }

private:
    void check_arrays() const {
        if (given_.offsets.empty() || given_.offsets.front() != 0 ||
            given_.offsets.back() != static_cast<std::int32_t>(given_.nodes.size()) ||
            !std::ranges::is_sorted(given_.offsets))
            throw BadInput("offsets of cells must begin with 0, never fall, and end with the number of corners, " +
                           std::to_string(given_.nodes.size()) + ".");
        if (!given_.body.empty() && std::ssize(given_.body) != size())
            throw BadInput("body has " + std::to_string(given_.body.size()) + " entries for " + std::to_string(size()) +
                           " cells; give one each.");
        for (std::int32_t cell = 0; cell < size(); ++cell) {
            for (const std::int32_t node : corners(cell)) {
                if (node < 0 || node >= rest_.size())
                    refuse(cell, "has the node " + std::to_string(node) + "; there are " + std::to_string(rest_.size()) +
                                     ", counted from 0.");
                if (!rest_[node].allFinite())
                    refuse(cell, "has a corner, node " + std::to_string(node) + ", that is not finite.");
            }
            if (body(cell) < 0) refuse(cell, "is of body " + std::to_string(body(cell)) + "; number bodies from 0.");
        }
    }

    PointsView<Dim> rest_;
    const HostCells& given_;
};

template <int Dim>
std::vector<SideOfFace> sides_of(const Cells<Dim>& cells) {
    std::vector<SideOfFace> sides;
    for (std::int32_t cell = 0; cell < cells.size(); ++cell)
        for (int face = 0; face < cells.faces(cell).n_faces; ++face) {
            SideOfFace side{.cell = cell, .face = face};
            std::vector<std::int32_t> nodes = cells.face(cell, face);
            std::ranges::sort(nodes);
            std::ranges::copy(nodes, side.key.begin());
            sides.push_back(side);
        }
    std::ranges::stable_sort(sides, {}, &SideOfFace::key);
    return sides;
}

/// Checks sides that stand together in `sides`.
template <int Dim>
void check_shared(std::span<const SideOfFace> shared, const Cells<Dim>& cells) {
    if (shared.size() > 2)
        refuse(shared[2].cell, "shares a face with cells " + std::to_string(shared[0].cell) + " and " +
                                   std::to_string(shared[1].cell) + "; a face has two sides. Take the cell out.");
    if (shared.size() == 2 && cells.body(shared[0].cell) != cells.body(shared[1].cell))
        refuse(shared[1].cell, "of body " + std::to_string(cells.body(shared[1].cell)) + " shares a face with cell " +
                                   std::to_string(shared[0].cell) + " of body " +
                                   std::to_string(cells.body(shared[0].cell)) + ". Give each body nodes of its own.");
}

/// Sides that no other cell shares, in the order of the cells.
template <int Dim>
std::vector<SideOfFace> boundary_of(const Cells<Dim>& cells) {
    const std::vector<SideOfFace> sides = sides_of(cells);
    std::vector<SideOfFace> boundary;
    for (std::size_t first = 0; first < sides.size();) {
        std::size_t last = first + 1;
        while (last < sides.size() && sides[last].key == sides[first].key) ++last;
        check_shared<Dim>(std::span(sides).subspan(first, last - first), cells);
        if (last == first + 1) boundary.push_back(sides[first]);
        first = last;
    }
    std::ranges::sort(boundary, {}, [](const SideOfFace& side) { return std::pair(side.cell, side.face); });
    return boundary;
}

}  // namespace

template <int Dim>
CellSurface<Dim> surface_of(PointsView<Dim> rest, const HostCells& given) {
    const Cells<Dim> cells(rest, given);
    CellSurface<Dim> surface;
    for (const SideOfFace& side : boundary_of(cells)) {
        std::vector<std::int32_t> face = cells.face(side.cell, side.face);
        if (cells.share(side.cell, face) < 0.0) std::reverse(face.begin() + (Dim == 2 ? 0 : 1), face.end());
        const double volume = cells.volume(side.cell), area = cells.area(face).norm();
        if (!(volume > 0.0) || !(area > 0.0)) refuse(side.cell, "has no volume. Take it out, or correct its corners.");
        const bool is_simplex = cells.faces(side.cell).n_corners == Dim + 1;
        surface.append_face(face, 0.5 * (is_simplex ? Dim : 1) * volume / area, cells.body(side.cell));
        surface.cell.push_back(side.cell);
    }
    return surface;
}

template CellSurface<2> surface_of<2>(PointsView<2>, const HostCells&);
template CellSurface<3> surface_of<3>(PointsView<3>, const HostCells&);

}  // namespace abut::contact
