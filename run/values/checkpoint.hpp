#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/ledger.hpp"

namespace abut::run {

/// All that the rest of a run depends on, between two steps: `simulate` makes it, and goes on from it with the same bits.
/// docs/checkpoints.md
struct Checkpoint {
    std::string run;                   ///< what it is of, as JSON: the options and sizes that the rest depends on
    dynamics::IntegratorState motion;  ///< of the points of the solid
    std::vector<std::byte> solid;      ///< Solid::state
    std::vector<double> ledger;        ///< dynamics::ledger_values of all entries so far, row by row
    dynamics::RestartReport restarts;  ///< neutral restarts so far
    std::int64_t inadmissible_overlaps_max = 0;
    std::vector<std::byte> looks;      ///< at the surfaces so far, and accounts
    std::vector<std::byte> observers;  ///< Observer::save
};

}  // namespace abut::run
