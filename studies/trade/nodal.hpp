#pragma once
#include <limits>
#include <vector>

#include "abut/run/scene.hpp"
#include "studies/nodal/impact.hpp"
#include "studies/trade/errors.hpp"
#include "studies/trade/ladder.hpp"

namespace abut::studies::trade {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// How the host of linear finite elements runs, with contact on its nodes.
struct NodalRun {
    nodal::Strain strain = nodal::Strain::small;
    nodal::ImpactOptions options = {};
};

/// A row of that host beside the cell-centred solid.
struct NodalSetting {
    Setting setting;  ///< "nodes", then what differs from its defaults
    NodalRun run;
};
/// All different; bodies that turn have finite strains, and small ones once, to compare.
[[nodiscard]] std::vector<NodalSetting> nodal_ladder(Motion motion);

template <int Dim>
struct NodalOutcome {
    Outcome outcome;
    std::vector<Vector<Dim>> velocity;  ///< of each body at the end [m/s]
};
/// The bodies of `scene`, of triangles or tetrahedra, with one spin [rad/s] about one centre each; `speed` is that of the
/// impact [m/s]. Throws std::runtime_error where the run ends before its time, or takes longer than `limit` [s].
template <int Dim>
[[nodiscard]] NodalOutcome<Dim> solve_on_nodes(const run::Scene<Dim>& scene, const std::vector<AxialVector<Dim>>& spin,
                                               const std::vector<Vector<Dim>>& centre, const NodalRun& run, double speed,
                                               double limit);

}  // namespace abut::studies::trade
