#include "abut/mesh/reorder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>

#include "abut/geometry/box.hpp"

namespace abut::mesh {
namespace {

/// In mean distances between centroids.
inline constexpr double layer_thickness = 1.0;
/// Places that differ by less are one: rounding, and so the unit of length, has no say in the order. In mean distances
/// between centroids; of extents, in the longest.
inline constexpr double resolution = 1e-6;

/// New number of each used vertex, -1 for the others.
template <int Dim>
std::vector<std::int32_t> new_vertex_numbers(const CellSoup<Dim>& soup, std::span<const std::int32_t> old_cell,
                                             bool by_first_use) {
    std::vector<std::int32_t> number(soup.vertices.size(), -1);
    std::int32_t next = 0;
    for (const std::int32_t cell : old_cell)
        for (const std::int32_t vertex : soup.cell_vertices[cell])
            if (number[static_cast<std::size_t>(vertex)] < 0) number[static_cast<std::size_t>(vertex)] = next++;
    if (by_first_use) return number;
    next = 0;
    for (std::int32_t& n : number)
        if (n >= 0) n = next++;
    return number;
}

std::vector<std::int32_t> inverse_of_used(std::span<const std::int32_t> number) {
    const auto n_used = number.size() - static_cast<std::size_t>(std::count(number.begin(), number.end(), -1));
    std::vector<std::int32_t> old_index(n_used);
    for (std::size_t i = 0; i < number.size(); ++i)
        if (number[i] >= 0) old_index[static_cast<std::size_t>(number[i])] = static_cast<std::int32_t>(i);
    return old_index;
}

Rows renumbered_rows(const Rows& rows, std::span<const std::int32_t> old_row, std::span<const std::int32_t> new_value) {
    Rows result;
    result.offsets.reserve(old_row.size() + 1);
    result.values.reserve(rows.values.size());
    for (const std::int32_t row : old_row) {
        for (const std::int32_t value : rows[row]) result.values.push_back(new_value[static_cast<std::size_t>(value)]);
        result.offsets.push_back(static_cast<std::int32_t>(result.values.size()));
    }
    return result;
}

/// Row by row and layer by layer, layers across the longest extent of the points, rows along the shortest: any two cells
/// that touch are then at most about one layer apart in the order, and the cells of a row follow one another.
template <int Dim>
std::vector<std::int32_t> layer_order(const std::vector<Vector<Dim>>& points) {
    geometry::Box<Dim> box;
    for (const Vector<Dim>& point : points) box.extend(point);
    const Vector<Dim> extent = box.upper - box.lower;
    const double longest = extent.maxCoeff(), unit = longest > 0.0 ? longest : 1.0;
    const Vector<Dim> relative = extent / unit;
    std::array<std::ptrdiff_t, Dim> axis;
    std::iota(axis.begin(), axis.end(), 0);
    std::ranges::stable_sort(axis, std::greater{}, [&](std::ptrdiff_t k) { return std::round(relative[k] / resolution); });
    const double spacing =
        layer_thickness * unit * std::pow(relative.prod() / static_cast<double>(points.size()), 1.0 / Dim);

    std::vector<std::array<double, Dim>> keys(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int k = 0; k < Dim; ++k) {
            const double along = points[i][axis[k]] - box.lower[axis[k]];
            if (!(spacing > 0.0))
                keys[i][k] = along;
            else
                keys[i][k] =
                    k + 1 < Dim ? std::floor(along / spacing + resolution) : std::round(along / spacing / resolution);
        }
    std::vector<std::int32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return keys[static_cast<std::size_t>(a)] < keys[static_cast<std::size_t>(b)];
    });
    return order;
}

}  // namespace

template <int Dim>
std::vector<std::int32_t> cell_order(const CellSoup<Dim>& soup, std::span<const Vector<Dim>> centroids, bool by_layers) {
    std::vector<std::int32_t> order(centroids.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
        return soup.cell_body[static_cast<std::size_t>(a)] < soup.cell_body[static_cast<std::size_t>(b)];
    });
    if (!by_layers) return order;
    const auto body_of = [&](std::int32_t cell) { return soup.cell_body[static_cast<std::size_t>(cell)]; };
    for (auto begin = order.begin(); begin != order.end();) {
        const auto end =
            std::find_if(begin, order.end(), [&](std::int32_t cell) { return body_of(cell) != body_of(*begin); });
        const std::vector<std::int32_t> cells(begin, end);
        std::vector<Vector<Dim>> points;
        points.reserve(cells.size());
        for (const std::int32_t cell : cells) points.push_back(centroids[static_cast<std::size_t>(cell)]);
        for (const std::int32_t k : layer_order<Dim>(points)) *begin++ = cells[static_cast<std::size_t>(k)];
    }
    return order;
}

template <int Dim>
CellSoup<Dim> renumbered(const CellSoup<Dim>& soup, std::span<const std::int32_t> old_cell, bool renumber_vertices) {
    const auto new_vertex = new_vertex_numbers(soup, old_cell, renumber_vertices);
    const auto old_vertex = inverse_of_used(new_vertex);
    CellSoup<Dim> result;
    result.name = soup.name;
    result.vertices = permuted(soup.vertices, old_vertex);
    result.vertex_label = permuted(soup.vertex_label, old_vertex);
    result.cell_shape = permuted(soup.cell_shape, old_cell);
    result.cell_body = permuted(soup.cell_body, old_cell);
    result.cell_label = permuted(soup.cell_label, old_cell);
    result.cell_vertices = renumbered_rows(soup.cell_vertices, old_cell, new_vertex);
    result.body_names = soup.body_names;
    result.group_names = soup.group_names;
    result.named_faces = soup.named_faces;
    result.n_ignored_elements = soup.n_ignored_elements;
    result.warnings = soup.warnings;
    for (auto& face : result.named_faces)
        for (std::int32_t& vertex : face.vertices) vertex = new_vertex[static_cast<std::size_t>(vertex)];
    return result;
}

template std::vector<std::int32_t> cell_order<2>(const CellSoup<2>&, std::span<const Vector<2>>, bool);
template std::vector<std::int32_t> cell_order<3>(const CellSoup<3>&, std::span<const Vector<3>>, bool);
template CellSoup<2> renumbered<2>(const CellSoup<2>&, std::span<const std::int32_t>, bool);
template CellSoup<3> renumbered<3>(const CellSoup<3>&, std::span<const std::int32_t>, bool);

}  // namespace abut::mesh
