#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "abut/solid/ccg/arrays.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/ccg/finite_cells.hpp"
#include "abut/solid/ccg/lanes.hpp"

namespace abut::solid {

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
            const double inverse_measure = arrays.cells[cell].inverse_measure;
            const LaneTensor<Dim> stress = load_packed<Dim>(Matrix<Dim>(inverse_measure * corrections.moment[i]));
            if (cells_.empty() || cells_.back() != cell) {
                cells_.push_back(cell);
                stresses_.push_back(stress);
                normal_pushes_.push_back(Matrix<Dim>::Zero());
            } else {
                for (int j = 0; j < Dim; ++j) stresses_.back().col[j] += stress.col[j];
            }
            if (const FreeCell<Dim>* free = finite.condensed(cell))
                normal_pushes_.back() += inverse_measure * free->measure_over * corrections.energy_gradient[i] *
                                         arrays.normal_of(corrections.faces[i]).transpose();
        }
    }

    void clear() {
        cells_.clear();
        stresses_.clear();
        normal_pushes_.clear();
    }

    /// visit(c, moment over |c|, normal push) for the cells from `begin` to before `end`. Normal push: the sum of p (x)
    /// n d/|c| where free faces move by their normal columns of F, d being |c| over their area; else 0.
    template <class Visit>
    void for_each(std::int32_t begin, std::int32_t end, const Visit& visit) const {
        for (auto i = static_cast<std::size_t>(std::ranges::lower_bound(cells_, begin) - cells_.begin());
             i < cells_.size() && cells_[i] < end; ++i)
            visit(cells_[i], stresses_[i], normal_pushes_[i]);
    }

private:
    std::vector<std::int32_t> cells_;        // increasing
    std::vector<LaneTensor<Dim>> stresses_;  // over |c|
    std::vector<Matrix<Dim>> normal_pushes_;
    std::vector<std::size_t> order_;  // work array
};

}  // namespace abut::solid
