#pragma once
#include "studies/cases/case.hpp"
#include "studies/table/table.hpp"

/// The table of the study `kinematics`.
namespace abut::studies::kinematics {

struct Options : PartOptions {
    int frames = 21;      ///< for ParaView, of each run
    int steps = 100'000;  ///< of the pile
    int turns = 10;       ///< of the gears
};

// Each in the file of its subject.
void run_free(const Options& options, const Sink& sink);
void run_means(const Options& options, const Sink& sink);
void run_tops(const Options& options, const Sink& sink);
void run_wall(const Options& options, const Sink& sink);
void run_bar(const Options& options, const Sink& sink);
void run_tumble(const Options& options, const Sink& sink);
void run_ball(const Options& options, const Sink& sink);
void run_bend(const Options& options, const Sink& sink);
void run_chute(const Options& options, const Sink& sink);
void run_cradle(const Options& options, const Sink& sink);
void run_spheres(const Options& options, const Sink& sink);
void run_gears(const Options& options, const Sink& sink);
void run_rotor(const Options& options, const Sink& sink);
void run_pile(const Options& options, const Sink& sink);

/// Runs it into a folder of its own under `options.out`; a row with the quantities that every run has to meet.
template <int Dim>
[[nodiscard]] Row row_of(const Case<Dim>& one, const std::string& setting, const Options& options,
                         CaseResult<Dim>* result = nullptr, const Watch<Dim>& watch = {});

}  // namespace abut::studies::kinematics
