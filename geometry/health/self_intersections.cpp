#include "abut/geometry/health/self_intersections.hpp"

// Only the LGPL parts of CGAL: kernels and their intersections.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Segment_3_Triangle_3.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <array>
#include <cstddef>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/triangulate.hpp"

namespace abut::geometry {
namespace {

using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;
using PredicatePoint = Predicates::Point_3;

/// A triangle of a face, by merged vertices. No two triangles of one face are tested against each other.
struct Piece {
    std::array<std::int32_t, 3> corners;
    std::int32_t face;
};

/// Exact tests of two pieces, by how many corners they share.
class PieceTest {
public:
    explicit PieceTest(std::span<const Vector<3>> vertices) : vertices_(vertices) {}

    [[nodiscard]] bool is_flat(const Piece& piece) const {
        return CGAL::collinear(point(piece.corners[0]), point(piece.corners[1]), point(piece.corners[2]));
    }
    [[nodiscard]] bool intersect(Piece piece_1, Piece piece_2) const {
        switch (bring_shared_to_front(piece_1, piece_2)) {
            case 0:
                return CGAL::do_intersect(triangle(piece_1), triangle(piece_2));
            case 1:
                return intersect_beyond_corner(piece_1, piece_2);
            case 2:
                return are_folded(piece_1, piece_2);
            default:
                return false;
        }
    }

private:
    [[nodiscard]] PredicatePoint point(std::int32_t vertex) const {
        const Vector<3>& x = vertices_[static_cast<std::size_t>(vertex)];
        return {x.x(), x.y(), x.z()};
    }
    [[nodiscard]] Predicates::Triangle_3 triangle(const Piece& piece) const {
        return {point(piece.corners[0]), point(piece.corners[1]), point(piece.corners[2])};
    }
    [[nodiscard]] Predicates::Segment_3 edge_opposite_of_first(const Piece& piece) const {
        return {point(piece.corners[1]), point(piece.corners[2])};
    }

    /// The corners that both have, in the same order, come first; their number.
    static int bring_shared_to_front(Piece& piece_1, Piece& piece_2) {
        int n_shared = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = n_shared; j < 3; ++j) {
                const auto index_1 = static_cast<std::size_t>(i), index_2 = static_cast<std::size_t>(j);
                if (piece_1.corners[index_1] != piece_2.corners[index_2]) continue;
                std::swap(piece_1.corners[index_1], piece_1.corners[static_cast<std::size_t>(n_shared)]);
                std::swap(piece_2.corners[index_2], piece_2.corners[static_cast<std::size_t>(n_shared)]);
                ++n_shared;
                break;
            }
        return n_shared;
    }
    /// Convex: a second common point gives a segment of them from the shared corner on, up to where it leaves one of the two
    /// triangles, through the edge opposite of the corner, inside the other.
    [[nodiscard]] bool intersect_beyond_corner(const Piece& piece_1, const Piece& piece_2) const {
        return CGAL::do_intersect(edge_opposite_of_first(piece_1), triangle(piece_2)) ||
               CGAL::do_intersect(edge_opposite_of_first(piece_2), triangle(piece_1));
    }
    /// In one plane and on the same side of the edge they share.
    [[nodiscard]] bool are_folded(const Piece& piece_1, const Piece& piece_2) const {
        const PredicatePoint a = point(piece_1.corners[0]), b = point(piece_1.corners[1]);
        const PredicatePoint c = point(piece_1.corners[2]), d = point(piece_2.corners[2]);
        return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
    }

    std::span<const Vector<3>> vertices_;
};

std::vector<Piece> pieces_of(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices,
                             std::span<const FaceFault> faults, const PieceTest& test) {
    std::vector<Piece> pieces;
    std::vector<Vector<3>> corners;
    for (std::int32_t face = 0; face < soup.size(); ++face) {
        if (faults[static_cast<std::size_t>(face)] != FaceFault::none) continue;
        const std::vector<std::int32_t> loop = distinct_corners(soup, merged_vertices, face);
        corners.clear();
        for (const std::int32_t vertex : loop) corners.push_back(soup.vertices[static_cast<std::size_t>(vertex)]);
        for (const LocalTriangle& cut : cut_into_triangles(corners)) {
            Piece piece{{}, face};
            for (std::size_t i = 0; i < 3; ++i) piece.corners[i] = loop[static_cast<std::size_t>(cut[i])];
            if (!test.is_flat(piece)) pieces.push_back(piece);
        }
    }
    return pieces;
}

std::vector<Box<3>> boxes_of(std::span<const Vector<3>> vertices, const std::vector<Piece>& pieces) {
    std::vector<Box<3>> boxes(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (const std::int32_t vertex : pieces[i].corners) boxes[i].extend(vertices[static_cast<std::size_t>(vertex)]);
    return boxes;
}

/// Keeps of the candidates those that intersect, as pairs of faces.
std::vector<IndexPair> intersecting_faces(const std::vector<IndexPair>& candidates, const std::vector<Piece>& pieces,
                                          const PieceTest& test) {
    std::vector<char> intersect(candidates.size(), 0);
    parallel_parts(candidates.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i != end; ++i) {
            const Piece& piece_1 = pieces[static_cast<std::size_t>(candidates[i].first)];
            const Piece& piece_2 = pieces[static_cast<std::size_t>(candidates[i].second)];
            intersect[i] = piece_1.face != piece_2.face && test.intersect(piece_1, piece_2) ? 1 : 0;
        }
    });
    std::vector<IndexPair> pairs;
    for (std::size_t i = 0; i < candidates.size(); ++i)
        if (intersect[i] != 0)
            pairs.push_back({pieces[static_cast<std::size_t>(candidates[i].first)].face,
                             pieces[static_cast<std::size_t>(candidates[i].second)].face});
    sort_unique(pairs);
    return pairs;
}

}  // namespace

std::vector<IndexPair> self_intersections(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices,
                                          std::span<const FaceFault> faults) {
    const PieceTest test(soup.vertices);
    const std::vector<Piece> pieces = pieces_of(soup, merged_vertices, faults, test);
    const std::vector<Box<3>> boxes = boxes_of(soup.vertices, pieces);
    return intersecting_faces(overlapping_pairs<3>({}, boxes), pieces, test);
}

}  // namespace abut::geometry
