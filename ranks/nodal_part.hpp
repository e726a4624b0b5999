#pragma once
#include <cstdint>
#include <span>

#include "abut/base/strided_points.hpp"
#include "abut/contact/surface/nodal_surface.hpp"

namespace abut::ranks {

/// Share of a rank in a surface that is shared out: all of its nodes, and the faces that it gives. Read once.
template <int Dim>
struct NodalPart {
    /// The nodes of this rank at rest (n_nodes) [m], whether they belong to a face or not
    PointsView<Dim> rest;
    /// (n_nodes) their numbers among the nodes of all ranks, >= 0, in any order, each once. A node at the border of
    /// parts has the same number and the same position at rest on every rank that has it, also where none of its faces
    /// is there
    std::span<const std::int32_t> node_number;
    /// The faces that this rank gives, corners being its own nodes (indices in `rest`); none is allowed. Bodies are numbered
    /// as on all ranks, and `stiffness` is the same on all. Each face is given by one rank, the faces of an obstacle, too
    contact::NodalFaces<Dim> faces;
    /// (n_faces) their numbers among the faces of all ranks, >= 0, with or without gaps: results, errors and `wanted` use
    /// them, and contact takes faces in their order, so that no bit depends on the parts. Empty on all ranks: faces are
    /// numbered rank after rank from 0 on, and bits depend on the parts
    std::span<const std::int32_t> face_number = {};
};

/// Which copies of a node get the force on it, where a node is on several ranks.
enum class CopyForce {
    on_each,  ///< each copy all of it: for hosts that keep the copies of a node equal
    on_first,  ///< one copy, that of the lowest rank which gives a face of the node: for hosts that add up what all ranks have
};

}  // namespace abut::ranks
