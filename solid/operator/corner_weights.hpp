#pragma once
#include <cstdint>
#include <utility>
#include <vector>

namespace abut::solid {

/// Norms of the weights by which cells move a corner of a boundary face in its frame: dw = sum_j W_j du_j under constant
/// loads. None is below the spectral norm.
struct CornerWeights {
    std::vector<std::pair<std::int32_t, double>> others;  ///< cells but that of the face, and |W_j| [-]
    double own = 0.0;                                     ///< |W_c| of the cell c of the face [-]
    double sum = 0.0;                                     ///< |sum_j W_j|, over all cells [-]
    double missing = 0.0;                                 ///< |I - sum_j W_j| [-]
};

}  // namespace abut::solid
