#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/gathered_state.hpp"
#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/left.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

/// A run between two steps, apart from the solid that makes them: all that the next ones depend on, by number of points,
/// cells and faces, whatever ranks they are on.
struct RunState {
    dynamics::IntegratorState motion;  ///< of all points
    std::vector<std::byte> solid;      ///< Solid::state
};

/// State of a run; the same on all ranks, which call it together.
template <int Dim, class Integrator>
[[nodiscard]] RunState run_state(const Solid<Dim>& solid, const Integrator& run) {
    return {dynamics::gathered<Dim>(solid.ranks(), run.state()), solid.state()};
}

/// Goes on from there with a solid that has the same numbers, on these ranks or on others, and an integrator of it: the
/// next steps have the same bits. A call of all ranks. Throws BadInput as Integrator::restore and Solid::restore.
template <int Dim, class Integrator>
void go_on_from(const RunState& state, Solid<Dim>& solid, Integrator& run) {
    dynamics::agreed(solid.ranks(), [&] { run.restore(dynamics::own_of<Dim>(solid.ranks(), state.motion)); });
    solid.restore(state.solid, run.q());
}

template <int Dim>
using Left = dynamics::Left<Dim>;

template <int Dim>
struct Change {
    RunState state;  ///< in the numbers of the solid that is to go on
    Left<Dim> left;
};

/// A run goes on between two steps on another mesh. `before` is its solid, which has made its steps until `motion`;
/// `after` was made with the new mesh and has made none. `old_cells`: of each cell of the new mesh its number in the mesh
/// before (n_cells), each once; cells whose number is missing have left. Faces are told by where their corners are at
/// rest.
///
///     const auto change = solid::change(before, run.state(), after, old_cells);
///     dynamics::Memm next(after, change.state.motion.q, change.state.motion.p_after, run.dt());
///     solid::go_on_from(change.state, after, next);
///
/// Cells keep displacement and momenta, cells and faces what their materials, bonds, loads and contact remember; time,
/// work and counts go on. Of a floating body that loses cells the centroids do: its points are elsewhere then. Faces
/// behind a cell that has left are new: of contact the run begins for them, and they have the loads of their groups. V may
/// jump, as `left` tells, and e does, by dt times the change of the force; H~ + D - W stays from then on. Where only
/// numbers change, what follows differs by rounding, and where stencils tie (docs/checkpoints.md, Another mesh).
///
/// Throws BadInput naming what is wrong: for cells that were not there before or are of another shape or body, rigid
/// bodies that lose cells, other bodies, kinematics, obstacles, springs, bonds or laws of contact, and materials that
/// remember other things; and for what is not made: several ranks and local steps. `after` is of no use then.
template <int Dim>
[[nodiscard]] Change<Dim> change(Solid<Dim>& before, const dynamics::IntegratorState& motion, Solid<Dim>& after,
                                 std::span<const std::int32_t> old_cells);

}  // namespace abut::solid
