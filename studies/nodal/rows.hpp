#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/nodal/impact.hpp"
#include "studies/table/table.hpp"

/// The table of the study `turning`.
namespace abut::studies::turning {

using namespace nodal;

struct Options : PartOptions {
    ImpactOptions impact{.frames = 21};
    std::int64_t long_steps = 1'000'000;  ///< of the long runs
};

/// A line of the table: a run, or a solution at rest.
struct Row {
    std::string scene;
    std::string setting;
    std::optional<ImpactFigures> run = {};
    std::vector<Quantity> quantities = {};  ///< with a target, or worth saying
    std::string remark = {};
    double seconds = 0.0;
};
using Sink = std::function<void(const Row&)>;

struct Part {
    std::string name;
    std::string question;
    std::function<void(const Options&, const Sink&)> run;
};
[[nodiscard]] const std::vector<Part>& parts();

// Each in the file of its subject.
void run_slipping(const Options& options, const Sink& sink);
void run_turning(const Options& options, const Sink& sink);
void run_long(const Options& options, const Sink& sink);
void solve_patches(const Options& options, const Sink& sink);
void solve_hertz(const Options& options, const Sink& sink);
void run_edges(const Options& options, const Sink& sink);
void sweep_steps(const Options& options, const Sink& sink);

/// "memm, filter, restart 50": of a row.
[[nodiscard]] std::string name_of(const ImpactOptions& run);

/// Runs it into a folder of its own under `options.out`, with the quantities that every run has to meet: H~, what nothing
/// from outside changes, missed contacts, the correction. Central differences have no H~: momenta alone are asked of them.
template <int Dim>
[[nodiscard]] Row row_of(const Impact<Dim>& impact, const ImpactOptions& run, const std::string& setting,
                         const Options& options, ImpactResult<Dim>* result = nullptr, const Watch<Dim>& watch = {});

void print_head(const Part& part);
void print(const Row& row);
/// Leaves turning.csv, one line per row, and summary.json.
void write_report(const apps::Program& program, const Options& options, const std::vector<Row>& rows);

}  // namespace abut::studies::turning
