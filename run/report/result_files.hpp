#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/files/animation.hpp"
#include "abut/run/files/checkpoint_folder.hpp"
#include "abut/run/files/energy_file.hpp"
#include "abut/run/files/folder_lock.hpp"
#include "abut/run/files/force_file.hpp"
#include "abut/run/files/frames.hpp"
#include "abut/run/files/probe_file.hpp"
#include "abut/run/files/snapshots.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/report/report.hpp"

namespace abut::run {

/// All files of a run in one folder, RunOptions::out: energy.csv, the VTU series, animation.html, probes.csv and forces.csv
/// (where options and Scene::outputs ask for them) as it goes, then energy.svg, the script for ParaView, report.html
/// and summary.json; in `checkpoints`, what a run that is stopped goes on from; of a run that fails its last sound
/// state, where it failed (write_failure), and pictures of the bodies until then. The folder is its own (FolderLock)
/// until `finish`, or until it goes.
///
///     run::RunOptions options{.out = "out/mine"};
///     run::ResultFiles<2> files(options, "mine", "bodies");
///     run::RunResult<2> result = run::simulate<2>(scene, options, files);
///     files.finish(scene, result);
template <int Dim>
class ResultFiles : public Observer<Dim> {
public:
    /// Makes the folder and takes it, and removes results of an earlier run there before anything else can be refused; with
    /// RunOptions::resume they stay.
    /// `program` is what picture and summary call the run; `series` names the files for ParaView. Throws BadInput if the
    /// folder cannot be written to, or if another run has it.
    ResultFiles(const RunOptions& options, std::string program, std::string series);

    void begin(const Scene<Dim>& scene, const RunResult<Dim>& result) override;
    void record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>& result) override;
    void note(const Moment<Dim>& moment) override;
    void see(const Sight<Dim>& sight) override;
    void cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) override;
    void end(const Sight<Dim>& sight) override;
    void see_at_time(const Sight<Dim>& sight) override;
    [[nodiscard]] bool wants_sight(std::int64_t step) const override;
    [[nodiscard]] std::int64_t wants_piece(std::int64_t step) const override;
    void piece(const FramePiece<Dim>& piece) override;
    void all_pieces(const FramePiece<Dim>& piece) override;
    void fail(const Failure& failure, const Sight<Dim>& sound) override;
    [[nodiscard]] bool wants_checkpoint(std::int64_t step, bool stops) const override;
    void keep(const Checkpoint& checkpoint) override;
    void save(StateWriter& state) override;
    void resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) override;
    /// After the run. Adds the time of all output to `result.seconds`, that of the picture also to the total. Throws
    /// BadInput if a file cannot be written.
    void finish(const Scene<Dim>& scene, RunResult<Dim>& result);

    /// Checkpoint from which a stopped run goes on, of the folder `checkpoints` in that of the results. Throws as
    /// CheckpointFolder::last.
    [[nodiscard]] CheckpointFolder::Found last_checkpoint() const { return checkpoints_.last(); }
    /// A file that whoever goes on needs is written beside the first checkpoint.
    void keep_beside_checkpoints(std::string name, std::string text);

    /// Files left of a run that fails, in sentences for its message; empty if it has not begun.
    [[nodiscard]] std::string left_behind() const;
    /// "Files" and a line for each kind of them, as closing_table: to follow it.
    [[nodiscard]] std::string table() const;

private:
    void draw_failure(const Sight<Dim>& sound);
    [[nodiscard]] std::vector<ReportFile> files_of_report() const;

    std::filesystem::path out_;
    std::optional<FolderLock> lock_;
    std::string program_;
    std::string name_;  // of the series
    EnergyFile<Dim> energies_;
    std::optional<Frames<Dim>> frames_;
    std::optional<Animation<Dim>> animation_;
    std::optional<ProbeFile<Dim>> probes_;
    std::optional<ForceFile<Dim>> forces_;
    Snapshots<Dim> snapshots_;
    CheckpointFolder checkpoints_;
    double minutes_;  // between two of them; 0: there are none
    int steps_;       // the same; 0: by minutes alone
    bool keep_last_;
    std::int64_t n_steps_ = 0;
    std::vector<std::pair<std::string, std::string>> beside_;  // names and texts
    std::chrono::steady_clock::time_point last_kept_;
    bool has_kept_ = false;
    bool has_begun_ = false;
    std::string failed_;  // what `fail` has left
    double seconds_ = 0.0;
};

}  // namespace abut::run
