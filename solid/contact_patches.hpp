#pragma once
// Private to the sources of this layer.
#include <span>
#include <vector>

#include "abut/dynamics/filter.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact_results.hpp"

namespace abut::solid {

/// Two faces in contact; `no_face` is one of an obstacle.
template <int Dim>
struct TouchingFaces {
    BoundaryFace face_1;
    BoundaryFace face_2;
    Vector<Dim> position;  ///< where an obstacle holds its partner (dynamics::Hold) [m]; of two bodies not used
    Vector<Dim> normal;    ///< along which it does
};

/// The cells whose displacement enters these faces, sorted into patches: the cells of one face are in one patch, and so are
/// the two faces of a pair. In the order of their first cells. Obstacles hold a patch where they touch it; prescribed faces of its cells in the directions that are prescribed.
template <int Dim>
[[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> contact_patches(const Ccg<Dim>& ccg,
                                                                       std::span<const TouchingFaces<Dim>> touching);

}  // namespace abut::solid
