#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/geometry/box.hpp"
#include "abut/geometry/nearest_points.hpp"

namespace abut::geometry {

/// Faces of a surface in a tree of boxes, each halved along its longest side until few faces are left.
template <int Dim>
class FaceTree {
public:
    struct Node {
        Box<Dim> box;
        std::size_t begin, end;    ///< of the faces
        std::size_t children = 0;  ///< the first of two; 0: none
    };

    /// `faces`: the corners of each, one at least; they are reordered, and `numbers` says where each was.
    explicit FaceTree(std::vector<std::vector<Vector<Dim>>> faces);

    [[nodiscard]] const std::vector<std::vector<Vector<Dim>>>& faces() const { return faces_; }
    [[nodiscard]] const std::vector<std::int32_t>& numbers() const { return numbers_; }
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

private:
    void split(std::size_t node);

    std::vector<std::vector<Vector<Dim>>> faces_;
    std::vector<std::int32_t> numbers_;
    std::vector<Node> nodes_;
};

/// Distance of two surfaces [m] where it is below `limit`, else `limit`: that of their nearest faces, each the convex
/// hull of its corners. Accuracy and errors as `convex_distance`.
template <int Dim>
[[nodiscard]] double distance_below(const FaceTree<Dim>& tree_1, const FaceTree<Dim>& tree_2, double limit);

/// Two faces of two surfaces, by their numbers before they were put into trees, and the points of theirs that are nearest.
struct NearestFaces {
    std::int32_t face_1 = -1, face_2 = -1;  ///< -1: there are none
    NearestPoints points{};
};

/// The nearest faces of two surfaces of flat convex polygons, exact up to rounding (`nearest_points`); of several that are
/// equally near, one. None if there is no face, or if the surfaces are not nearer than `limit` [m].
[[nodiscard]] NearestFaces nearest_faces(const FaceTree<3>& tree_1, const FaceTree<3>& tree_2,
                                         double limit = std::numeric_limits<double>::infinity());

}  // namespace abut::geometry
