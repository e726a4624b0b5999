#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/solid/ccg/ccg.hpp"

namespace abut::benchmark {

/// K of the CCG energy as a sparse matrix of 3 x 3 blocks: compressed rows, each block contiguous and by columns.
class AssembledMatrix {
public:
    /// Adds up the terms of the energy (elastic of each cell, stabilisation of each interior face; docs/method.md, Space)
    /// from the mesh, the stencils and the boundary reconstruction: independent of the code that it is compared with.
    AssembledMatrix(const mesh::Mesh<3>& mesh, std::span<const solid::Material> materials, const solid::Ccg<3>& ccg);

    /// result = K x, row after row.
    void multiply(std::span<const Vector<3>> x, std::span<Vector<3>> result) const;

    [[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> scalar_matrix() const;

    [[nodiscard]] std::int64_t n_rows() const { return static_cast<std::int64_t>(offsets_.size()) - 1; }
    [[nodiscard]] std::int64_t n_blocks() const { return static_cast<std::int64_t>(columns_.size()); }
    /// What a product reads once: blocks, columns, offsets.
    [[nodiscard]] std::int64_t bytes() const { return n_blocks() * (9 * 8 + 4) + (n_rows() + 1) * 8; }

private:
    std::vector<std::int64_t> offsets_{0};
    std::vector<std::int32_t> columns_;
    std::vector<double> blocks_;  // 9 a block and three more at the end: columns are read four numbers at a time
};

}  // namespace abut::benchmark
