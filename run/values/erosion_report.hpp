#pragma once
#include <cstdint>
#include <tuple>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/left.hpp"
#include "abut/solid/erosion.hpp"

namespace abut::run {

/// Cell that has left a run.
struct ErodedCell {
    std::int32_t cell;  ///< of Scene::mesh
    std::int64_t step;  ///< after which it left
    double time;        ///< of that [s]
    solid::LeavingReason reason;

    static auto fields(auto& self) { return std::tie(self.cell, self.step, self.time, self.reason); }
};

/// Cells that have left a run so far, and what they took along.
template <int Dim>
struct ErosionReport {
    std::vector<ErodedCell> cells;  ///< in the order in which they left
    dynamics::Left<Dim> left;
    Vector<Dim> impulse_of_weight = Vector<Dim>::Zero();  ///< that gravity had given to them [N s]

    static auto fields(auto& self) { return std::tie(self.cells, self.left, self.impulse_of_weight); }
};

}  // namespace abut::run
