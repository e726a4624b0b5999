#include "abut/contact/pairs/watched_pairs.hpp"

#include <cmath>
#include <utility>

#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/pair_potential/pair_facing.hpp"

namespace abut::contact {

template <int Dim>
void WatchedPairs<Dim>::assign(std::vector<NodalPair<Dim>> pairs, std::span<const std::int32_t> body, PointsView<Dim> x) {
    pairs_ = std::move(pairs);
    nodes_.clear();
    for (const NodalPair<Dim>& pair : pairs_)
        for (int v = 0; v < Dim; ++v) {
            nodes_.push_back({body[static_cast<std::size_t>(pair.facet_1)], pair.node[v]});
            nodes_.push_back({body[static_cast<std::size_t>(pair.facet_2)], pair.node[Dim + v]});
        }
    sort_unique(nodes_);
    begin(x);
}

/// All of them have been asked at x.
template <int Dim>
void WatchedPairs<Dim>::begin(PointsView<Dim> x) {
    from_.clear();
    for (const Moving& moving : nodes_) from_.push_back(x[moving.node]);
    asked_.clear();
    for (std::size_t p = 0; p < pairs_.size(); ++p)
        asked_.push_back({geometry::reach_turned_away<Dim>(pairs_[p].at(x), none_), p});
    std::ranges::sort(asked_, {}, &Asked::reach);
    n_always_ = std::ranges::count(asked_, 0.0, &Asked::reach);
    n_again_ = 0;
}

/// The farthest that a node has moved beside the first one of its body.
template <int Dim>
double WatchedPairs<Dim>::motion_to(PointsView<Dim> x) const {
    double square = 0.0;
    Vector<Dim> of_body;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Vector<Dim> moved = x[nodes_[i].node] - from_[i];
        if (i == 0 || nodes_[i].body != nodes_[i - 1].body) of_body = moved;
        square = larger(square, (moved - of_body).squaredNorm());
    }
    return std::sqrt(square);
}

template class WatchedPairs<2>;
template class WatchedPairs<3>;

}  // namespace abut::contact
