#pragma once
#include <functional>
#include <string>
#include <vector>

#include "studies/kinematics/cases.hpp"
#include "studies/table/table.hpp"

/// The table of the study `kinematics`.
namespace abut::studies::kinematics {

struct Options : PartOptions {
    int frames = 21;      ///< for ParaView, of each run
    int steps = 100'000;  ///< of the pile
    int turns = 10;       ///< of the gears
};

/// A line of the table: a run.
struct Row {
    std::string scene;
    std::string setting;
    Figures run;
    std::vector<Quantity> quantities = {};  ///< with a target, or worth saying
};
using Sink = std::function<void(const Row&)>;

struct Part {
    std::string name;
    std::string question;
    std::function<void(const Options&, const Sink&)> run;
};
[[nodiscard]] const std::vector<Part>& parts();

// Each in the file of its subject.
void run_free(const Options& options, const Sink& sink);
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

/// Runs it into a folder of its own under `options.out`, with the quantities that every run has to meet: H~, what nothing
/// from outside changes, missed contacts, the correction.
template <int Dim>
[[nodiscard]] Row row_of(const Case<Dim>& one, const std::string& setting, const Options& options,
                         CaseResult<Dim>* result = nullptr, const Watch<Dim>& watch = {});

void print_head(const Part& part);
void print(const Row& row);
/// Leaves kinematics.csv, one line per quantity, and summary.json.
void write_report(const apps::Program& program, const Options& options, const std::vector<Row>& rows);

}  // namespace abut::studies::kinematics
