#include "abut/run/watch/returned_flow.hpp"

#include <algorithm>

namespace abut::run {

template <int Dim>
ReturnedFlow returned_flow(const dynamics::Ledger<Dim>& ledger) {
    ReturnedFlow returned;
    double before = 0.0, most = 0.0, given_back = 0.0;
    for (const dynamics::LedgerEntry<Dim>& entry : ledger.entries()) {
        const double flow = entry.losses.in_cells + entry.losses.in_jumps + entry.losses.on_faces;
        if (flow < before) {
            given_back += before - flow;
            ++returned.records;
        }
        before = flow;
        most = std::max(most, flow);
    }
    if (most > 0.0) returned.share = given_back / most;
    return returned;
}

template ReturnedFlow returned_flow<2>(const dynamics::Ledger<2>&);
template ReturnedFlow returned_flow<3>(const dynamics::Ledger<3>&);

}  // namespace abut::run
