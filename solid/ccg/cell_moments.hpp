#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "abut/solid/ccg/arrays.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/ccg/lanes.hpp"

namespace abut::solid {

/// What contact adds to dV/dG_c of the cells behind some boundary faces, cell by cell. Empty without any.
template <int Dim>
class CellMoments {
public:
    /// Sums run in the order of the faces.
    void assign(const CcgArrays<Dim>& arrays, const FaceCorrections<Dim>& corrections) {
        clear();
        if (corrections.moment.empty()) return;
        order_.resize(corrections.faces.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        const auto cell_of = [&](std::size_t i) { return arrays.cell_of(corrections.faces[i]); };
        std::ranges::stable_sort(order_, {}, cell_of);
        for (const std::size_t i : order_) {
            const std::int32_t cell = cell_of(i);
            const LaneTensor<Dim> stress =
                load_packed<Dim>(Matrix<Dim>(arrays.cells[cell].inverse_measure * corrections.moment[i]));
            if (cells_.empty() || cells_.back() != cell) {
                cells_.push_back(cell);
                stresses_.push_back(stress);
            } else {
                for (int j = 0; j < Dim; ++j) stresses_.back().col[j] += stress.col[j];
            }
        }
    }

    void clear() {
        cells_.clear();
        stresses_.clear();
    }

    /// Adds to S_c of the cells from `begin` to before `end`.
    void add_to(std::vector<double>& s, std::int32_t begin, std::int32_t end) const {
        for (auto i = std::ranges::lower_bound(cells_, begin) - cells_.begin();
             i < std::ssize(cells_) && cells_[static_cast<std::size_t>(i)] < end; ++i) {
            const std::int32_t cell = cells_[static_cast<std::size_t>(i)];
            LaneTensor<Dim> sum = load_tensor<Dim>(s, cell);
            for (int j = 0; j < Dim; ++j) sum.col[j] += stresses_[static_cast<std::size_t>(i)].col[j];
            store_tensor(sum, s, cell);
        }
    }

private:
    std::vector<std::int32_t> cells_;        // increasing
    std::vector<LaneTensor<Dim>> stresses_;  // over |c|
    std::vector<std::size_t> order_;         // work array
};

}  // namespace abut::solid
