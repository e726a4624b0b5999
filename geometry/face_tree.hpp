#pragma once
#include <cstddef>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/geometry/box.hpp"

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

    /// `faces`: the corners of each, one at least; they are reordered.
    explicit FaceTree(std::vector<std::vector<Vector<Dim>>> faces);

    [[nodiscard]] const std::vector<std::vector<Vector<Dim>>>& faces() const { return faces_; }
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }

private:
    void split(std::size_t node);

    std::vector<std::vector<Vector<Dim>>> faces_;
    std::vector<Node> nodes_;
};

/// Distance of two surfaces [m] where it is below `limit`, else `limit`: that of their nearest faces, each the convex hull of
/// its corners. Accuracy and errors as `convex_distance`.
template <int Dim>
[[nodiscard]] double distance_below(const FaceTree<Dim>& tree_1, const FaceTree<Dim>& tree_2, double limit);

}  // namespace abut::geometry
