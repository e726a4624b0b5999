#include "abut/mesh/topology.hpp"

#include <algorithm>

#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/checks.hpp"
#include "abut/mesh/local_faces.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

/// One cell's side of a face. Half faces are numbered by cell, then by position in the cell.
struct HalfFace {
    std::array<std::int32_t, 3> other_vertices;  ///< the key without its smallest vertex
    std::int32_t number;
    friend auto operator<=>(const HalfFace&, const HalfFace&) = default;
};

template <int Dim>
std::vector<std::int32_t> half_face_offsets(const CellSoup<Dim>& soup) {
    std::vector<std::int32_t> offsets(soup.cell_shape.size() + 1, 0);
    for (std::size_t cell = 0; cell < soup.cell_shape.size(); ++cell)
        offsets[cell + 1] = offsets[cell] + n_faces(soup.cell_shape[cell]);
    return offsets;
}

std::int32_t cell_of(std::int32_t half, const std::vector<std::int32_t>& offsets) {
    return static_cast<std::int32_t>(std::upper_bound(offsets.begin(), offsets.end(), half) - offsets.begin()) - 1;
}

/// Half faces sorted by smallest vertex: bucket v is half_faces[begin[v] .. begin[v+1]).
struct Buckets {
    std::vector<std::int32_t> begin;
    std::vector<HalfFace> half_faces;
};

template <int Dim, class Visitor>
void for_each_half_face(const CellSoup<Dim>& soup, Visitor&& visit) {
    std::int32_t half = 0;
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell)
        for (int i = 0; i < n_faces(soup.cell_shape[static_cast<std::size_t>(cell)]); ++i)
            visit(half++, cell, local_face(soup, cell, i));
}

template <int Dim>
Buckets bucket_by_smallest_vertex(const CellSoup<Dim>& soup, std::size_t n_half_faces) {
    Buckets buckets{std::vector<std::int32_t>(soup.vertices.size() + 1, 0), std::vector<HalfFace>(n_half_faces)};
    for_each_half_face(soup, [&](std::int32_t, std::int32_t, const LocalFace& face) {
        const auto view = face.view();
        ++buckets.begin[static_cast<std::size_t>(*std::min_element(view.begin(), view.end())) + 1];
    });
    for (std::size_t v = 0; v + 1 < buckets.begin.size(); ++v) buckets.begin[v + 1] += buckets.begin[v];
    std::vector<std::int32_t> next(buckets.begin.begin(), buckets.begin.end() - 1);
    for_each_half_face(soup, [&](std::int32_t half, std::int32_t, const LocalFace& face) {
        const auto key = face_key(face.view());
        const auto slot = next[static_cast<std::size_t>(key[0])]++;
        buckets.half_faces[static_cast<std::size_t>(slot)] = {{key[1], key[2], key[3]}, half};
    });
    return buckets;
}

template <int Dim>
[[noreturn]] void throw_non_manifold(const CellSoup<Dim>& soup, std::span<const HalfFace> same,
                                     const std::vector<std::int32_t>& offsets) {
    std::string cells;
    for (const HalfFace& half : same)
        cells += std::string(cells.empty() ? "" : ", ") +
                 std::to_string(soup.cell_label[static_cast<std::size_t>(cell_of(half.number, offsets))]);
    const std::int32_t cell = cell_of(same[0].number, offsets);
    const auto face = local_face(soup, cell, same[0].number - offsets[static_cast<std::size_t>(cell)]);
    throw MeshError(soup.name + ": face with vertices " + vertex_list(face.view(), soup.vertex_label) + " belongs to " +
                    std::to_string(same.size()) + " cells (" + cells +
                    "), at most 2 are allowed. Remove the overlapping or repeated cells.");
}

/// The half face on the other side of each half face, -1 on the boundary.
template <int Dim>
std::vector<std::int32_t> find_twins(const CellSoup<Dim>& soup, const std::vector<std::int32_t>& offsets) {
    const auto n_half_faces = static_cast<std::size_t>(offsets.back());
    Buckets buckets = bucket_by_smallest_vertex(soup, n_half_faces);
    std::vector<std::int32_t> twin(n_half_faces, -1);
    for (std::size_t v = 0; v + 1 < buckets.begin.size(); ++v) {
        const auto begin = buckets.half_faces.begin() + buckets.begin[v];
        const auto end = buckets.half_faces.begin() + buckets.begin[v + 1];
        std::sort(begin, end);
        for (auto first = begin; first != end;) {
            const auto last =
                std::find_if(first, end, [&](const HalfFace& h) { return h.other_vertices != first->other_vertices; });
            if (last - first > 2) throw_non_manifold(soup, {first, last}, offsets);
            if (last - first == 2) {
                twin[static_cast<std::size_t>(first[0].number)] = first[1].number;
                twin[static_cast<std::size_t>(first[1].number)] = first[0].number;
            }
            first = last;
        }
    }
    return twin;
}

/// True if `second` runs through the vertices of `first` one after the other, forwards (+1) or backwards (-1), from
/// wherever.
bool runs_through(std::span<const std::int32_t> first, std::span<const std::int32_t> second, std::ptrdiff_t sense) {
    const auto n = static_cast<std::ptrdiff_t>(second.size());
    const std::ptrdiff_t start = std::find(second.begin(), second.end(), first[0]) - second.begin();
    for (std::ptrdiff_t k = 0; k < n; ++k)
        if (second[static_cast<std::size_t>((start + sense * k + n) % n)] != first[static_cast<std::size_t>(k)])
            return false;
    return true;
}

/// Seen from outside, two neighbours run through the vertices of their face in opposite senses. A face of two vertices has
/// no sense of its own: there the first vertex of one is the last of the other.
template <int Dim>
void check_opposite_sides(const CellSoup<Dim>& soup, std::int32_t cell, std::int32_t neighbour, const LocalFace& face,
                          const LocalFace& as_seen_by_neighbour) {
    const auto first = face.view(), second = as_seen_by_neighbour.view();
    if (Dim == 2 ? second[0] == first[1] : runs_through(first, second, -1)) return;
    const std::string cells = soup.name + ": cells " + std::to_string(soup.cell_label[static_cast<std::size_t>(cell)]) +
                              " and " + std::to_string(soup.cell_label[static_cast<std::size_t>(neighbour)]);
    if (Dim == 3 && !runs_through(first, second, 1))
        throw MeshError(cells + " run differently around their common face: " + vertex_list(first, soup.vertex_label) +
                        " and " + vertex_list(second, soup.vertex_label) +
                        ", its edges must be the same. Give the vertices of both cells in the order of their shapes.");
    throw MeshError(cells + " lie on the same side of their common face with vertices " +
                    vertex_list(first, soup.vertex_label) +
                    ". Remove the repeated cell, or give the vertices of the inverted one in the order of its shape.");
}

}  // namespace

template <int Dim>
Faces find_faces(const CellSoup<Dim>& soup) {
    const auto offsets = half_face_offsets(soup);
    const auto twin = find_twins(soup, offsets);
    Faces faces;
    faces.cell_faces.offsets = offsets;
    faces.cell_faces.values.resize(twin.size());
    for_each_half_face(soup, [&](std::int32_t half, std::int32_t cell, const LocalFace& face) {
        const std::int32_t other = twin[static_cast<std::size_t>(half)];
        auto& number = faces.cell_faces.values[static_cast<std::size_t>(half)];
        if (other < 0 || other > half) {
            number = faces.face_vertices.size();
            faces.face_vertices.append(face.view());
            faces.face_cells.push_back({cell, -1});
            return;
        }
        number = faces.cell_faces.values[static_cast<std::size_t>(other)];
        auto& cells = faces.face_cells[static_cast<std::size_t>(number)];
        const int local = other - offsets[static_cast<std::size_t>(cells[0])];
        check_opposite_sides(soup, cells[0], cell, local_face(soup, cells[0], local), face);
        cells[1] = cell;
    });
    return faces;
}

BoundaryFaceFinder::Key BoundaryFaceFinder::key(std::span<const std::int32_t> vertices) { return face_key(vertices); }

BoundaryFaceFinder::BoundaryFaceFinder(const Rows& face_vertices,
                                       const std::vector<std::array<std::int32_t, 2>>& face_cells) {
    for (std::int32_t face = 0; face < face_vertices.size(); ++face)
        if (face_cells[static_cast<std::size_t>(face)][1] < 0) sorted_.emplace_back(key(face_vertices[face]), face);
    std::sort(sorted_.begin(), sorted_.end());
}

std::int32_t BoundaryFaceFinder::find(std::span<const std::int32_t> vertices) const {
    if (vertices.size() > max_face_vertices) return -1;
    const Key wanted = key(vertices);
    const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), wanted,
                                        [](const auto& entry, const Key& k) { return entry.first < k; });
    return found != sorted_.end() && found->first == wanted ? found->second : -1;
}

template Faces find_faces<2>(const CellSoup<2>&);
template Faces find_faces<3>(const CellSoup<3>&);

}  // namespace abut::mesh
