#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/dynamics/ccg.hpp"

namespace abut::dynamics {

/// Cells that touched something in the last step and so may carry the parasitic mode of the scheme.
struct ContactPatch {
    std::vector<std::int32_t> cells;  ///< increasing
    bool held = false;                ///< touches an obstacle or a prescribed boundary: its momentum is not its own
};

/// Two faces in contact, as places in Mesh::boundary_faces; `no_face` is one of an obstacle.
struct TouchingFaces {
    std::int32_t face_1;
    std::int32_t face_2;
};
inline constexpr std::int32_t no_face = -1;

/// The cells whose displacement enters these faces, sorted into patches: the cells of one face are in one patch, and so are
/// the two faces of a pair. In the order of their first cells.
template <int Dim>
[[nodiscard]] std::vector<ContactPatch> contact_patches(const Ccg<Dim>& ccg, std::span<const TouchingFaces> touching);

}  // namespace abut::dynamics
