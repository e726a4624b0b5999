#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/ranks.hpp"

namespace abut::solid {

/// Items each of which one rank has values of, which it brings to all. On one rank there is nothing to bring.
class RankItems {
public:
    RankItems() = default;
    /// The ranks must outlive it. `own`: among n items those that this rank has, increasing. A call of all ranks.
    RankItems(const dynamics::Ranks& ranks, std::vector<std::size_t> own) : ranks_(&ranks), own_(std::move(own)) {
        if (ranks.is_one()) return;
        for (const double item : ranks.gather(std::vector<double>(own_.begin(), own_.end())))
            brought_.push_back(static_cast<std::size_t>(item));
    }

    [[nodiscard]] std::span<const std::size_t> own() const { return own_; }

    /// Values of all items (n, width).
    struct Values {
        std::span<double> of_items;
        std::size_t width;
    };
    /// Completes values: those of own items are set before, and all are then. A call of all ranks.
    void bring(std::initializer_list<Values> all) const {
        if (brought_.empty()) return;
        mine_.clear();
        for (const std::size_t item : own_)
            for (const Values& values : all) {
                const auto of_item = values.of_items.subspan(item * values.width, values.width);
                mine_.insert(mine_.end(), of_item.begin(), of_item.end());
            }
        const std::vector<double> gathered = ranks_->gather(mine_);
        auto next = gathered.begin();
        for (const std::size_t item : brought_)
            for (const Values& values : all) {
                std::copy_n(next, values.width, values.of_items.subspan(item * values.width).begin());
                next += static_cast<std::ptrdiff_t>(values.width);
            }
    }

private:
    const dynamics::Ranks* ranks_ = nullptr;
    std::vector<std::size_t> own_;
    std::vector<std::size_t> brought_;  // as `gather` brings them: rank after rank; empty on one
    mutable std::vector<double> mine_;
};

}  // namespace abut::solid
