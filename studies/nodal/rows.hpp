#pragma once
#include "studies/nodal/run_case.hpp"
#include "studies/table/table.hpp"

/// The table of the study `turning`.
namespace abut::studies::turning {

using namespace nodal;
using dynamics::Scheme;
template <int Dim>
using Watch = nodal::Watch<Dim>;  // of these bodies

struct Options : PartOptions {
    run::RunOptions run{.cfl = 1.0, .restart = 0};
    std::int64_t long_steps = 1'000'000;  ///< of the long runs
};

// Each in the file of its subject.
void run_slipping(const Options& options, const Sink& sink);
void run_turning(const Options& options, const Sink& sink);
void run_long(const Options& options, const Sink& sink);
void solve_patches(const Options& options, const Sink& sink);
void solve_hertz(const Options& options, const Sink& sink);
void run_edges(const Options& options, const Sink& sink);
void sweep_steps(const Options& options, const Sink& sink);

/// "memm, filter, restart 50": of a row.
[[nodiscard]] std::string name_of(const run::RunOptions& run);

/// Runs it into a folder of its own under `options.out`; a row with the quantities that every run has to meet. Central
/// differences have no H~: momenta alone are asked of them.
template <int Dim>
[[nodiscard]] Row row_of(Case<Dim> one, const run::RunOptions& run, const std::string& setting, const Options& options,
                         CaseResult<Dim>* result = nullptr, const Watch<Dim>& watch = {}, int records = 1500);

}  // namespace abut::studies::turning
