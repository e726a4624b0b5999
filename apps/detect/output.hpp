#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/mesh/io/write_vtp.hpp"
#include "abut/run/files/folder_lock.hpp"
#include "abut/run/files/partial_file.hpp"
#include "apps/detect/detection.hpp"

namespace abut::apps {

/// Makes the folder and takes it for as long as the result lives, and removes what an earlier run left there. Throws
/// BadInput naming folder or file.
[[nodiscard]] run::FolderLock prepare_output(const std::filesystem::path& out);

/// The files of a run: pairs as .csv, and pictures for ParaView. A pair names faces as their files do. Rows are written as
/// they come and outlive a process that is killed: candidates.csv, overlaps.csv, contacts.csv and nearest.csv (of bodies, by
/// name) and steps.csv are called candidates.csv.partial and so on until `finish`. Whatever cannot be written is
/// BadInput that names the file.
class Output {
public:
    /// `every` > 0: also each so many-th step, and all .vtp files with the number of their step.
    Output(const Bodies& bodies, const std::filesystem::path& out, int every);

    /// Whether pairs of this step are wanted, the last one or not.
    [[nodiscard]] bool writes_pairs(int step) const { return every_ > 0 && step % every_ == 0; }
    /// A row of steps.csv; of a step whose pairs are wanted, the last one among them, also its rows of the others and its
    /// .vtp files; `distances` must have been measured then. The first call makes the files.
    void add(const StepResult& result, std::span<const geometry::IndexPair> candidates, bool last);
    /// The run is at its end: gives the files of rows their names.
    void finish();

private:
    using Patches = std::vector<std::vector<Vector<3>>>;  // polygons of overlaps

    [[nodiscard]] std::array<run::PartialFile*, 5> files() {
        return {&candidates_, &overlaps_, &contacts_, &nearest_, &steps_};
    }
    void open();
    void add_row(const StepResult& result);
    void add_pairs(const StepResult& result, std::span<const geometry::IndexPair> candidates);
    void add_candidates(int step, std::span<const geometry::IndexPair> candidates);
    void add_overlaps(const StepResult& result, const Patches& patches);
    void add_contacts(const StepResult& result);
    void add_nearest(const StepResult& result);
    void write_overlaps(const StepResult& result, const Patches& patches) const;
    void write_surface(const StepResult& result) const;
    [[nodiscard]] std::filesystem::path path(const std::string& stem, int step) const;

    const Bodies& bodies_;
    std::filesystem::path out_;
    int every_;
    run::PartialFile steps_, candidates_, overlaps_, contacts_, nearest_;
    std::vector<std::string> names_;          // of bodies, as tables have them
    std::vector<mesh::NamedNumber> numbers_;  // the same for pictures
};

}  // namespace abut::apps
