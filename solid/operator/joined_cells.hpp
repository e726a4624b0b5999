#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// Cells that hang together by faces. Beside a crack, cells that are near each other need not.
template <int Dim>
class JoinedCells {
public:
    /// `is_gone`, if not empty: cells that are passed over (n_cells). Both must outlive it.
    JoinedCells(const mesh::Mesh<Dim>& mesh, const std::vector<char>& is_gone)
        : mesh_(mesh), is_gone_(is_gone), seen_in_(mesh.cell_measure.size(), 0) {}

    /// A cell, and those that are reached from it by going through up to `most_faces` faces, nearer ones first; fewer
    /// where is_enough(), asked before each ring, says so. Valid until the next call.
    template <class IsEnough>
    const std::vector<std::int32_t>& around(std::int32_t cell, const IsEnough& is_enough) {
        ++search_;
        cells_.clear();
        add(cell);
        std::size_t begin = 0;
        for (int ring = 0; ring < most_faces && !is_enough(); ++ring)
            for (const std::size_t end = cells_.size(); begin < end; ++begin)
                for (const std::int32_t face : mesh_.cell_faces[cells_[begin]])
                    for (const std::int32_t other : mesh_.face_cells[static_cast<std::size_t>(face)])
                        if (other >= 0) add(other);
        return cells_;
    }
    /// Whether the last call of `around` has found a cell.
    [[nodiscard]] bool has(std::int32_t cell) const { return seen_in_[static_cast<std::size_t>(cell)] == search_; }

private:
    static constexpr int most_faces = 6;  // from a cell to those that share a vertex with it

    void add(std::int32_t cell) {
        if (has(cell) || (!is_gone_.empty() && is_gone_[static_cast<std::size_t>(cell)] != 0)) return;
        seen_in_[static_cast<std::size_t>(cell)] = search_;
        cells_.push_back(cell);
    }

    const mesh::Mesh<Dim>& mesh_;
    const std::vector<char>& is_gone_;
    std::vector<std::uint32_t> seen_in_;  // by cell: the last search that has found it
    std::uint32_t search_ = 0;
    std::vector<std::int32_t> cells_;
};

}  // namespace abut::solid
