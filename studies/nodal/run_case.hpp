#pragma once
#include "studies/cases/case.hpp"
#include "studies/nodal/p1_bodies.hpp"

namespace abut::studies::nodal {

/// Whether a run has come to its end, and the alternating mode owns less than the run.
[[nodiscard]] inline bool held(const Figures& run) { return run.is_complete && run.excess < 1.0; }

template <int Dim>
using Watch = WatchOf<Dim, P1Bodies<Dim>>;

/// Runs it on the host of linear finite elements, under MEMM or leapfrog: `Case::run` says by which, with which
/// remedies, and for how many steps at most; `cfl` is the time step over the advised one. Energies are recorded about
/// `records` times, equally far apart, and `watch` looks on there. An exception of the library ends the run, and its
/// message says why; so does H - H~ beyond ten times the largest energy. Leaves energy.csv, its picture and the series
/// for ParaView in `folder`; an empty one: none.
template <int Dim>
[[nodiscard]] CaseResult<Dim> run_case(const Case<Dim>& one, const std::filesystem::path& folder,
                                       const Watch<Dim>& watch = {}, int records = 1500);

}  // namespace abut::studies::nodal
