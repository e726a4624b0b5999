#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/ranks/node_gather.hpp"
#include "abut/ranks/shared_surface.hpp"

namespace abut::ranks {

/// Checks of what a rank gives of its nodes, beside what their owners give. All throw BadInput on this rank alone,
/// naming node and ranks.
template <int Dim>
class CopyChecks {
public:
    /// `numbers` must outlive it.
    CopyChecks(int rank, const SharedNumbers& numbers, const contact::NodalSurface<Dim>& surface);

    /// Whether a node of the surface belongs to a face of a deformable body.
    [[nodiscard]] bool is_deformable(std::size_t node) const { return is_deformable_[node] != 0; }

    /// An array with one entry per node of this rank.
    void check_size(std::int64_t size) const;
    /// Copies are where their owners are, except for rounding. A position of an owner that is not finite is left to the
    /// search.
    void check_copies(PointsView<Dim> x, std::span<const Vector<Dim>> of_owners,
                      std::span<const NodeGather::Here> copies) const;
    /// Masses of owned nodes, > 0 where a face is deformable.
    void check_masses(std::span<const double> mass, std::span<const NodeGather::Here> owned) const;
    /// Copies have the masses that their owners give.
    void check_copies(std::span<const double> mass, std::span<const Vector<1>> of_owners,
                      std::span<const NodeGather::Here> copies) const;

private:
    [[nodiscard]] std::string name_of_copy(const NodeGather::Here& node) const;

    int rank_;
    const SharedNumbers& numbers_;
    std::vector<char> is_deformable_;  // of each node of the surface
    double allowed_distance_;          // of copies of a node [m]
};

}  // namespace abut::ranks
