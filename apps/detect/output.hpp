#pragma once
#include <filesystem>
#include <string>

#include "abut/run/folder_lock.hpp"
#include "apps/detect/detection.hpp"

namespace abut::apps {

/// Makes the folder and takes it for as long as the result lives, and removes what an earlier run left there. Throws
/// BadInput naming folder or file.
[[nodiscard]] run::FolderLock prepare_output(const std::filesystem::path& out);

/// The files of a run: pairs as .csv, and pictures for ParaView. A pair names faces as their files do.
class Output {
public:
    /// `every` > 0: also each so many-th step, and all .vtp files with the number of their step.
    Output(const Bodies& bodies, const std::filesystem::path& out, int every);

    [[nodiscard]] bool wants(int step, int last_step) const;
    /// Writes the .vtp files of this step and keeps its rows.
    void add(const StepResult& result, std::span<const geometry::IndexPair> candidates);
    /// Writes candidates.csv, overlaps.csv and steps.csv; none is ever seen half-written.
    void finish() const;
    /// A row of steps.csv.
    void add_row(const StepResult& result);

private:
    using Patches = std::vector<std::vector<Vector<3>>>;  // polygons of overlaps

    void add_candidates(int step, std::span<const geometry::IndexPair> candidates);
    void add_overlaps(const StepResult& result, const Patches& patches);
    void write_overlaps(const StepResult& result, const Patches& patches) const;
    void write_surface(const StepResult& result) const;
    [[nodiscard]] std::filesystem::path path(const std::string& stem, int step) const;

    const Bodies& bodies_;
    std::filesystem::path out_;
    int every_;
    std::string steps_, candidates_, overlaps_;
};

}  // namespace abut::apps
