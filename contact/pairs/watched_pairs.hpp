#pragma once
// Private to the layer.
#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/pairs/nodal_pairs.hpp"

namespace abut::contact {

/// Pairs that are asked in each step whether something has come true that asks their facets to look at each other. A pair
/// that is turned away is asked again only where its facets may have turned far enough since then.
template <int Dim>
class WatchedPairs {
public:
    /// `none`: n_1 . n_2 from which facets are turned away.
    explicit WatchedPairs(double none) : none_(none) {}

    /// All have been asked at x. `body`: of each facet.
    void assign(std::vector<NodalPair<Dim>> pairs, std::span<const std::int32_t> body, PointsView<Dim> x);
    void clear() { pairs_.clear(); }
    [[nodiscard]] std::span<const NodalPair<Dim>> pairs() const { return pairs_; }

    /// Calls visit(pair) at x for pairs in any order. Of those that are left out n_1 . n_2 is `none` or more.
    template <class Visit>
    void visit(PointsView<Dim> x, const Visit& visit) {
        if (pairs_.empty()) return;
        const double motion = motion_to(x);
        const auto end = std::ranges::partition_point(asked_, [&](const Asked& asked) { return !(motion < asked.reach); });
        for (auto asked = asked_.begin(); asked != end; ++asked) visit(pairs_[asked->pair]);
        n_again_ += end - asked_.begin() - n_always_;
        if (n_again_ > std::ssize(pairs_)) begin(x);
    }

private:
    struct Asked {
        double reach;  // how far nodes may move before it is asked again [m]
        std::size_t pair;
    };
    /// Nodes of the facets of one body.
    struct Moving {
        std::int32_t body, node;
        auto operator<=>(const Moving&) const = default;
    };

    void begin(PointsView<Dim> x);
    [[nodiscard]] double motion_to(PointsView<Dim> x) const;

    double none_;
    std::vector<NodalPair<Dim>> pairs_;
    std::vector<Asked> asked_;       // of all pairs, by reach
    std::vector<Moving> nodes_;      // increasing
    std::vector<Vector<Dim>> from_;  // where these were when all pairs were asked
    std::ptrdiff_t n_always_ = 0;    // pairs without a reach
    std::ptrdiff_t n_again_ = 0;     // how often others have been asked again since then
};

}  // namespace abut::contact
