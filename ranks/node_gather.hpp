#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/ranks/communicator.hpp"
#include "abut/ranks/point_ranks.hpp"
#include "abut/ranks/shared_surface.hpp"

namespace abut::ranks {

/// Brings what the owners of some nodes of a shared surface have to all ranks. Who sends what is known to all
/// beforehand, and arrays are kept from call to call.
class NodeGather {
public:
    /// A node of the surface that this rank has, too.
    struct Here {
        std::int32_t own;      ///< index in the nodes of this rank
        std::int32_t surface;  ///< index in the nodes of the surface
    };

    /// Source of values, one of `width` per node of this rank, and their target, one per node of the surface.
    template <int Dim>
    struct Points {
        PointsView<Dim> from;
        std::span<Vector<Dim>> to;
    };

    /// `nodes`: of the surface, increasing. Both must outlive the calls of `bring`.
    void assign(const Communicator& communicator, const SharedNumbers& numbers, std::span<const std::int32_t> nodes);

    [[nodiscard]] bool empty() const { return order_.empty(); }
    [[nodiscard]] std::span<const Here> owned() const { return owned_; }    ///< those of this rank that it sends
    [[nodiscard]] std::span<const Here> copies() const { return copies_; }  ///< those of this rank that others send

    /// A call of all ranks; one message for all of `points`. Counts what it receives.
    template <int Dim>
    void bring(const Communicator& communicator, std::initializer_list<Points<Dim>> points, Traffic& traffic);

private:
    std::vector<std::int32_t> order_;  // nodes of the surface, rank after rank
    std::vector<int> counts_;          // nodes of each rank
    std::vector<Here> owned_, copies_;
    std::vector<double> sent_, received_;
    std::vector<int> value_counts_, value_offsets_;  // work arrays
};

}  // namespace abut::ranks
