#pragma once
#include <optional>

#include "abut/mesh/io/write_vtu.hpp"
#include "apps/support/csv.hpp"
#include "studies/nodal/run_case.hpp"

namespace abut::studies::nodal {

/// Files that a run leaves in its folder: energy.csv and its picture, the series for ParaView.
template <int Dim>
class CaseFiles {
public:
    /// Makes the folder. Throws MeshError if it cannot.
    CaseFiles(const std::filesystem::path& folder, const Case<Dim>& one, std::int64_t steps);

    /// Writes a frame if one is due.
    void look(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies);
    void finish(const dynamics::Ledger<Dim>& ledger, const Figures& figures) const;

private:
    void write(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies);

    std::filesystem::path folder_;
    std::string title_;
    int frames_;
    std::int64_t steps_;
    std::optional<mesh::VtuSeries<Dim>> series_;
};

}  // namespace abut::studies::nodal
