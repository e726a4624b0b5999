#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "abut/solid/cells/finite_cells.hpp"
#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/lanes.hpp"
#include "abut/solid/operator/operator_values.hpp"

namespace abut::solid {

/// Terms that contact at the faces of a cell adds to gradients of energy over |c| [Pa].
template <int Dim>
struct CellPush {
    Matrix<Dim> affine = Matrix<Dim>::Zero();     ///< in F of the affine faces
    Matrix<Dim> condensed = Matrix<Dim>::Zero();  ///< in F_cond, of faces that are seen so; of finite cells alone
    /// Sum of p (x) M^-1 n/|c| over free faces: these move by (F_cond - F) M^-1 n (FreeCell::to_faces)
    Matrix<Dim> of_moved_faces = Matrix<Dim>::Zero();
};

/// Terms that contact adds to dV/dG_c of the cells behind some boundary faces, cell by cell. Empty without any.
template <int Dim>
class CellMoments {
public:
    /// Sums run in the order of the faces.
    void assign(const CcgArrays<Dim>& arrays, const FiniteCells<Dim>& finite, const FaceCorrections<Dim>& corrections) {
        clear();
        if (corrections.moment.empty()) return;
        order_.resize(corrections.faces.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        const auto cell_of = [&](std::size_t i) { return arrays.cell_of(corrections.faces[i]); };
        std::ranges::stable_sort(order_, {}, cell_of);
        for (const std::size_t i : order_) {
            const std::int32_t cell = cell_of(i);
            if (cells_.empty() || cells_.back() != cell) {
                cells_.push_back(cell);
                pushes_.emplace_back();
            }
            const BoundaryFace face = corrections.faces[i];
            const double inverse_measure = arrays.cells[cell].inverse_measure;
            const Matrix<Dim> stress = inverse_measure * corrections.moment[i];
            CellPush<Dim>& push = pushes_.back();
            const FreeCell<Dim>* free = finite.condensed_behind(face, cell);
            if (!free) {
                push.affine += stress;
                continue;
            }
            push.condensed += stress;
            if (!finite.is_free(face)) continue;
            const Vector<Dim> moved = inverse_measure * free->to_faces * arrays.normal_of(face);
            push.of_moved_faces += corrections.energy_gradient[i] * moved.transpose();
        }
    }

    void clear() {
        cells_.clear();
        pushes_.clear();
    }

    /// visit(c, push) for the cells from `begin` to before `end`.
    template <class Visit>
    void for_each(std::int32_t begin, std::int32_t end, const Visit& visit) const {
        for (auto i = static_cast<std::size_t>(std::ranges::lower_bound(cells_, begin) - cells_.begin());
             i < cells_.size() && cells_[i] < end; ++i)
            visit(cells_[i], pushes_[i]);
    }

private:
    std::vector<std::int32_t> cells_;  // increasing
    std::vector<CellPush<Dim>> pushes_;
    std::vector<std::size_t> order_;  // work array
};

}  // namespace abut::solid
