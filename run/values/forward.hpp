#pragma once

// Types that headers of runs name only.

namespace abut::mesh {
template <int Dim>
struct Mesh;
}

namespace abut::dynamics {
struct IntegratorState;
template <int Dim>
struct LedgerEntry;
template <int Dim>
class RunView;
}  // namespace abut::dynamics

namespace abut::solid {
template <int Dim>
class Solid;
template <int Dim>
struct SolidOptions;
}  // namespace abut::solid

namespace abut::run {
struct Checkpoint;
struct EnergyScale;
struct Failure;
struct RunOptions;
template <int Dim>
struct FramePiece;
template <int Dim>
struct Moment;
template <int Dim>
struct RunResult;
template <int Dim>
struct Scene;
template <int Dim>
struct Sight;
}  // namespace abut::run
