#include "abut/mesh/split.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "abut/base/messages.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/checks.hpp"
#include "abut/mesh/local_faces.hpp"
#include "abut/mesh/measures.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/topology.hpp"

namespace abut::mesh {
namespace {

using Triangle = std::array<std::int32_t, 3>;

struct Quadrangle {
    std::array<std::int32_t, 4> vertices;
    std::int32_t cell;
    double deviation;  ///< from its plane, over the face size
};

/// Triangles of a face, cut through its smallest vertex, in the face's own sense.
std::vector<Triangle> triangles(std::span<const std::int32_t> face) {
    const auto n = face.size();
    const auto apex = static_cast<std::size_t>(std::min_element(face.begin(), face.end()) - face.begin());
    std::vector<Triangle> result;
    for (std::size_t i = 1; i + 1 < n; ++i) result.push_back({face[apex], face[(apex + i) % n], face[(apex + i + 1) % n]});
    return result;
}

std::vector<Quadrangle> measured_quadrangles(const CellSoup<3>& soup) {
    std::vector<Quadrangle> result;
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell) {
        const CellShape shape = soup.cell_shape[static_cast<std::size_t>(cell)];
        if (shape == CellShape::tetrahedron) continue;
        for (int i = 0; i < n_faces(shape); ++i) {
            const LocalFace face = local_face(soup, cell, i);
            if (face.count != 4) continue;
            result.push_back(
                {face.vertices, cell, relative_planarity<3>(face_corners<3>(soup.vertices, face.view()).view())});
        }
    }
    return result;
}

[[noreturn]] void throw_non_planar(const CellSoup<3>& soup, const std::vector<Quadrangle>& quadrangles,
                                   const Quadrangle& worst, const MeshOptions& options) {
    std::string cells;
    int n_cells = 0;
    for (const Quadrangle& q : quadrangles) {
        if (face_key(q.vertices) != face_key(worst.vertices)) continue;
        cells += (n_cells++ > 0 ? "|" : "") + std::to_string(soup.cell_label[static_cast<std::size_t>(q.cell)]);
    }
    const double size = std::sqrt(geometry::face_measure<3>(face_corners<3>(soup.vertices, worst.vertices).view()));
    throw MeshError(
        soup.name + ": face " + vertex_list(worst.vertices, soup.vertex_label) + " of cell " + cells +
        " is not planar: a vertex lies " + number(worst.deviation * size) + " m off its plane, " +
        number(options.planarity_tolerance * size) +
        " m is allowed. Have such cells cut into tetrahedra (non_planar = \"split\"), or raise planarity_tolerance, now " +
        number(options.planarity_tolerance) + " of the size of a face, above " + number(worst.deviation) + ".");
}

/// Spreads the mark to all cells that are linked to a marked one through quadrangles.
void mark_neighbours(const CellSoup<3>& soup, std::vector<char>& cut) {
    const Faces faces = find_faces(soup);
    std::vector<std::int32_t> open;
    for (std::size_t cell = 0; cell < cut.size(); ++cell)
        if (cut[cell]) open.push_back(static_cast<std::int32_t>(cell));
    while (!open.empty()) {
        const std::int32_t cell = open.back();
        open.pop_back();
        for (const std::int32_t face : faces.cell_faces[cell]) {
            if (faces.face_vertices[face].size() != 4) continue;
            for (const std::int32_t neighbour : faces.face_cells[static_cast<std::size_t>(face)])
                if (neighbour >= 0 && !std::exchange(cut[static_cast<std::size_t>(neighbour)], char{1}))
                    open.push_back(neighbour);
        }
    }
}

void append_cell(CellSoup<3>& soup, CellShape shape, std::span<const std::int32_t> vertices, std::int32_t body,
                 std::int64_t label) {
    soup.cell_shape.push_back(shape);
    soup.cell_vertices.append(vertices);
    soup.cell_body.push_back(body);
    soup.cell_label.push_back(label);
}

void append_tetrahedra(const CellSoup<3>& soup, std::int32_t cell, CellSoup<3>& result) {
    const auto i = static_cast<std::size_t>(cell);
    const auto vertices = soup.cell_vertices[cell];
    const std::int32_t apex = *std::min_element(vertices.begin(), vertices.end());
    for (int local = 0; local < n_faces(soup.cell_shape[i]); ++local) {
        const LocalFace face = local_face(soup, cell, local);
        if (std::ranges::find(face.view(), apex) != face.view().end()) continue;
        for (const Triangle& t : triangles(face.view())) {
            // The triangle is counter-clockwise from outside, a tetrahedron's base clockwise.
            const std::array<std::int32_t, 4> tetrahedron = {t[0], t[2], t[1], apex};
            append_cell(result, CellShape::tetrahedron, tetrahedron, soup.cell_body[i], soup.cell_label[i]);
        }
    }
}

void cut_cells(CellSoup<3>& soup, const std::vector<char>& cut) {
    CellSoup<3> result;
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell) {
        const auto i = static_cast<std::size_t>(cell);
        if (cut[i])
            append_tetrahedra(soup, cell, result);
        else
            append_cell(result, soup.cell_shape[i], soup.cell_vertices[cell], soup.cell_body[i], soup.cell_label[i]);
    }
    soup.cell_shape = std::move(result.cell_shape);
    soup.cell_vertices = std::move(result.cell_vertices);
    soup.cell_body = std::move(result.cell_body);
    soup.cell_label = std::move(result.cell_label);
}

/// A named quadrangle on a cut cell becomes two named triangles. Its vertices may come in any order: the cell knows the
/// right one.
void cut_named_faces(CellSoup<3>& soup, const std::vector<Quadrangle>& quadrangles, const std::vector<char>& cut) {
    std::map<FaceKey, std::array<std::int32_t, 4>> rings;
    for (const Quadrangle& q : quadrangles)
        if (cut[static_cast<std::size_t>(q.cell)]) rings.emplace(face_key(q.vertices), q.vertices);
    std::vector<CellSoup<3>::NamedFace> result;
    for (const auto& face : soup.named_faces) {
        const auto ring = face.vertices.size() == 4 ? rings.find(face_key(face.vertices)) : rings.end();
        if (ring == rings.end()) {
            result.push_back(face);
            continue;
        }
        for (const Triangle& t : triangles(ring->second)) result.push_back({{t.begin(), t.end()}, face.group});
    }
    soup.named_faces = std::move(result);
}

std::int32_t count_distinct(const std::vector<Quadrangle>& quadrangles, double tolerance) {
    std::set<FaceKey> distinct;
    for (const Quadrangle& q : quadrangles)
        if (q.deviation > tolerance) distinct.insert(face_key(q.vertices));
    return static_cast<std::int32_t>(distinct.size());
}

}  // namespace

template <>
void handle_non_planar_faces<2>(CellSoup<2>&, const MeshOptions&, BuildReport&) {}

template <>
void handle_non_planar_faces<3>(CellSoup<3>& soup, const MeshOptions& options, BuildReport& report) {
    const auto quadrangles = measured_quadrangles(soup);
    if (quadrangles.empty()) return;
    const auto worst = std::max_element(quadrangles.begin(), quadrangles.end(),
                                        [](const Quadrangle& a, const Quadrangle& b) { return a.deviation < b.deviation; });
    report.worst_planarity = worst->deviation;
    report.worst_face_cell = soup.cell_label[static_cast<std::size_t>(worst->cell)];
    if (worst->deviation <= options.planarity_tolerance) return;
    if (options.non_planar == NonPlanarFaces::fail) throw_non_planar(soup, quadrangles, *worst, options);
    std::vector<char> cut(soup.cell_shape.size(), 0);
    for (const Quadrangle& q : quadrangles)
        if (q.deviation > options.planarity_tolerance) cut[static_cast<std::size_t>(q.cell)] = 1;
    mark_neighbours(soup, cut);
    report.n_non_planar_faces = count_distinct(quadrangles, options.planarity_tolerance);
    report.n_cut_cells = static_cast<std::int32_t>(std::count(cut.begin(), cut.end(), char{1}));
    cut_named_faces(soup, quadrangles, cut);
    cut_cells(soup, cut);
}

}  // namespace abut::mesh
