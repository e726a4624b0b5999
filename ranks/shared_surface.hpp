#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <vector>

#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/ranks/communicator.hpp"
#include "abut/ranks/nodal_part.hpp"

namespace abut::ranks {

/// How nodes and faces of a shared surface are numbered, and where they are; nodes are those that a face names on any rank.
struct SharedNumbers {
    std::vector<std::int32_t> node;      ///< number of each node of the surface, increasing
    std::vector<std::int32_t> face;      ///< number of each face, increasing
    std::vector<int> owner;              ///< of each node: the lowest rank that gives a face of it
    std::vector<std::int32_t> own_node;  ///< of each node: which one of this rank it is; -1: none
    std::int32_t n_own = 0;              ///< nodes of this rank, whether they are of the surface or not
};

/// The surface of all ranks on each of them: nodes and faces in the order of their numbers.
template <int Dim>
struct SharedSurface {
    SharedNumbers numbers;
    contact::NodalSurface<Dim> surface;
};

/// A call of all ranks. Throws BadInput on all of them, as SharedNodalContact does.
template <int Dim>
[[nodiscard]] SharedSurface<Dim> share_surface(const Communicator& communicator, const NodalPart<Dim>& part);

}  // namespace abut::ranks
