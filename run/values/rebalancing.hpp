#pragma once
#include <cstdint>
#include <vector>

namespace abut::run {

/// The cells of a run on several ranks have been shared out again.
struct Rebalance {
    std::int64_t step = 0;         ///< after which
    std::int64_t cells_moved = 0;  ///< that have another rank since; points of rigid bodies count as cells
    /// Cost of the own cells of the costliest rank over the mean of all ranks [-], from the look before until this step and
    /// from here until the next look or the end of the run; NaN: nothing was measured.
    double imbalance_before = 0.0;
    double imbalance_after = 0.0;
    double seconds = 0.0;  ///< that it took [s]
};

/// Number of times that this was done and was considered.
struct Rebalancing {
    std::vector<Rebalance> done;
    std::int64_t looks = 0;  ///< how often costs were compared
};

}  // namespace abut::run
