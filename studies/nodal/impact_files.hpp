#pragma once
#include <optional>
#include <vector>

#include "abut/mesh/io/write_vtu.hpp"
#include "apps/support/csv.hpp"
#include "studies/nodal/impact.hpp"

namespace abut::studies::nodal {

/// What a run leaves in its folder: energy.csv and its picture, the series for ParaView.
template <int Dim>
class ImpactFiles {
public:
    /// Makes the folder. Throws MeshError if it cannot.
    ImpactFiles(const ImpactOptions& options, const Impact<Dim>& impact, std::int64_t steps);

    void record(const dynamics::LedgerEntry<Dim>& entry, const AxialVector<Dim>& turning_momentum);
    /// Writes a frame if one is due.
    void look(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies);
    void finish(const ImpactFigures& figures) const;

private:
    void write(const dynamics::RunView<Dim>& run, P1Bodies<Dim>& bodies);

    const ImpactOptions& options_;
    std::string title_;
    std::int64_t steps_;
    apps::Table energies_;
    std::vector<dynamics::LedgerEntry<Dim>> entries_;
    std::optional<mesh::VtuSeries<Dim>> series_;
};

}  // namespace abut::studies::nodal
