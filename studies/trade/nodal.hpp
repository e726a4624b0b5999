#pragma once
#include <vector>

#include "abut/run/scene.hpp"
#include "studies/nodal/impact.hpp"
#include "studies/trade/errors.hpp"
#include "studies/trade/ladder.hpp"

namespace abut::studies::trade {

/// The host of linear finite elements with contact on its nodes, as a row of the table beside the cell-centred solid.
struct NodalSetting {
    Setting setting;  ///< "nodes", then what differs from its defaults, as `turning` takes it
    nodal::ImpactOptions run;
};
[[nodiscard]] const std::vector<NodalSetting>& nodal_ladder();

/// The bodies of `scene`, of triangles or tetrahedra, in small strain; `speed` is that of the impact [m/s]. Throws
/// std::runtime_error where the run ends before its time, or takes longer than `limit` [s].
template <int Dim>
[[nodiscard]] Outcome solve_on_nodes(const run::Scene<Dim>& scene, const nodal::ImpactOptions& options, double speed,
                                     double limit, std::vector<Vector<Dim>>& velocity_at_end);

}  // namespace abut::studies::trade
