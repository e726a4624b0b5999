#pragma once
#include <limits>
#include <vector>

#include "abut/run/scene.hpp"
#include "studies/nodal/run_case.hpp"
#include "studies/trade/errors.hpp"
#include "studies/trade/ladder.hpp"

namespace abut::studies::trade {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// How the host of linear finite elements runs, with contact on its nodes.
struct NodalRun {
    Kinematics strain = Kinematics::small;
    run::RunOptions options{.cfl = 1.0};
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
/// The bodies of `scene`, of triangles or tetrahedra, with one spin [rad/s] about its centroid each; `speed` is that of the
/// impact [m/s]. Throws std::runtime_error where the run ends before its time, or takes longer than `limit` [s].
template <int Dim>
[[nodiscard]] NodalOutcome<Dim> solve_on_nodes(const run::Scene<Dim>& scene, const std::vector<AxialVector<Dim>>& spin,
                                               const NodalRun& run, double speed, double limit);

}  // namespace abut::studies::trade
