#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "abut/dynamics/ranks.hpp"
#include "abut/ranks/communicator.hpp"

namespace abut::ranks {

/// Sums over the points of all ranks in the order of `ordered_sum` (base/parallel.hpp): each block of 1,024 values is
/// added up on one rank, blocks shared out evenly in their order, and rank 0 adds up the blocks. Every term is sent
/// once.
class OrderedSums {
public:
    /// `numbers`: of this rank's points among `n_points`, increasing; each is on one rank. All arguments must outlive it.
    OrderedSums(const Communicator& communicator, std::span<const std::int32_t> numbers, std::int32_t n_points)
        : communicator_(communicator), numbers_(numbers), n_points_(n_points) {}

    /// See dynamics::Ranks::sum. A call of all ranks.
    void sum(const dynamics::Summands& summands, std::span<const double> terms, std::span<double> total);

private:
    /// Targets of the values of a range, and positions of those that come.
    struct Plan {
        std::int64_t n = 0;                 // values of all ranks
        std::int64_t begin = 0;             // those that are added up here begin with this one
        std::int64_t n_here = 0;            // and are as many
        std::vector<int> counts;            // values to each rank
        std::vector<std::int64_t> arrived;  // position behind `begin` of each value that comes
    };
    [[nodiscard]] const Plan& plan_of(const dynamics::Summands& summands);
    [[nodiscard]] Plan make_plan(const dynamics::Summands& summands) const;

    const Communicator& communicator_;
    std::span<const std::int32_t> numbers_;
    std::int32_t n_points_;
    std::map<std::tuple<std::int32_t, std::int32_t, std::int32_t>, Plan> plans_;
};

}  // namespace abut::ranks
