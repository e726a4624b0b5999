#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/dynamics/system.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/load/loads.hpp"

namespace abut::solid {

/// Local time steps of the cells: which of them are evaluated at which level, and the arrays for it. All cells keep an entry
/// in these; only those that a call names are set.
template <int Dim>
class LocalLevels {
public:
    /// `level` is that of each degree of freedom. The mesh, the operators and the loads must outlive this. Throws
    /// BadInput if a boundary condition has a history or the components of a cell disagree.
    LocalLevels(const mesh::Mesh<Dim>& mesh, Ccg<Dim>& ccg, const Loads<Dim>& loads, std::int32_t n_levels,
                std::span<const std::int32_t> level);

    [[nodiscard]] bool is_finest(std::int32_t level) const { return static_cast<std::size_t>(level) + 1 >= regions_.size(); }
    /// Adds the impulse of bulk and body forces on the cells that are evaluated at this level [N s]; how many these are.
    std::int64_t add_bulk_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double dt,
                                  std::span<Vector<Dim>> impulse);
    /// Adds what corrections of faces add to that; they are faces of regions with these input cells.
    void add_contact_impulse(std::span<const std::int32_t> input_cells, const FaceCorrections<Dim>& corrections, double dt,
                             std::span<Vector<Dim>> impulse);

    /// Displacements now, and dt from now [m]; valid until the next call.
    [[nodiscard]] std::span<const Vector<Dim>> start_of(const dynamics::FreeFlight& flight,
                                                        std::span<const std::int32_t> cells);
    [[nodiscard]] std::span<const Vector<Dim>> end_of(const dynamics::FreeFlight& flight, double dt,
                                                      std::span<const std::int32_t> cells);
    [[nodiscard]] std::span<const std::int32_t> all_cells() const { return all_cells_; }
    /// Cells that some boundary face depends on, and those of the faces themselves.
    [[nodiscard]] std::span<const std::int32_t> surface_cells() const { return surface_cells_; }

private:
    void set_regions(std::int32_t n_levels, std::span<const std::int32_t> level);
    void set_surface_cells(const mesh::Mesh<Dim>& mesh);

    Ccg<Dim>& ccg_;
    const Loads<Dim>& loads_;
    std::vector<std::int32_t> all_cells_;
    std::vector<std::int32_t> surface_cells_;
    std::vector<Region<Dim>> regions_;   // of the cells that are evaluated at each level
    Region<Dim> contact_region_;         // of the cells that feel the listed faces
    std::vector<Vector<Dim>> at_start_;  // work arrays: cells at the start of a part of a step,
    std::vector<Vector<Dim>> moved_;     // at another time of it,
    std::vector<Vector<Dim>> gradient_;  // and those of a region
};

}  // namespace abut::solid
