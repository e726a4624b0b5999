#pragma once
// Private to the layer.
#include <cstdint>

#include "abut/dynamics/ledger.hpp"

namespace abut::run {

/// Energy that plastic flow, with jumps and faces that flow along, gives back from one record to the next. No metal does so.
struct ReturnedFlow {
    std::int64_t records = 0;  ///< that have dissipated less than those before
    double share = 0.0;        ///< of what has been dissipated at most [-]; 0 where nothing has
};

/// Falls within the steps between two records, and made up for there, are not seen.
template <int Dim>
[[nodiscard]] ReturnedFlow returned_flow(const dynamics::Ledger<Dim>& ledger);

}  // namespace abut::run
