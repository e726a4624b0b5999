#include "abut/solid/held_points.hpp"

#include <algorithm>
#include <utility>

namespace abut::solid {

template <int Dim>
HeldPoints<Dim>::HeldPoints(std::vector<std::int32_t> numbers, const RankPart<Dim>* part)
    : numbers_(std::move(numbers)), part_(part) {
    std::vector<double> mine;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        std::int32_t position = numbers_[i];
        if (part_) {
            const auto own = part_->ranks().numbers();
            const auto found = std::ranges::lower_bound(own, numbers_[i]);
            if (found == own.end() || *found != numbers_[i]) continue;
            position = part_->ranks().positions()[static_cast<std::size_t>(found - own.begin())];
        }
        own_.push_back({i, position});
        mine.push_back(static_cast<double>(i));
    }
    if (!part_ || numbers_.empty()) return;
    for (const double held : part_->ranks().gather(mine)) gathered_.push_back(static_cast<std::size_t>(held));
}

template <int Dim>
void HeldPoints<Dim>::take(std::span<const Vector<Dim>> of_points, std::vector<Vector<Dim>>& of_held) const {
    of_held.resize(numbers_.size());
    for (const Own& own : own_) of_held[own.held] = of_points[static_cast<std::size_t>(own.position)];
    if (!part_ || numbers_.empty()) return;
    std::vector<double> mine;
    for (const Own& own : own_) mine.insert(mine.end(), of_held[own.held].begin(), of_held[own.held].end());
    const std::vector<double> all = part_->ranks().gather(mine);
    const auto values = as_vectors<Dim>(std::span<const double>(all));
    for (std::size_t i = 0; i < values.size(); ++i) of_held[gathered_[i]] = values[i];
}

template <int Dim>
void HeldPoints<Dim>::add(std::span<const Vector<Dim>> of_held, std::span<Vector<Dim>> of_points) const {
    for (const Own& own : own_) of_points[static_cast<std::size_t>(own.position)] += of_held[own.held];
}

template class HeldPoints<2>;
template class HeldPoints<3>;

}  // namespace abut::solid
