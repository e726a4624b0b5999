#include "abut/solid/load/held_points.hpp"

#include <utility>

namespace abut::solid {

template <int Dim>
HeldPoints<Dim>::HeldPoints(std::vector<std::int32_t> numbers, const RankPart<Dim>& part)
    : numbers_(std::move(numbers)), part_(&part) {
    if (numbers_.empty()) return;
    const dynamics::Ranks& ranks = part.ranks();
    std::vector<double> mine;
    for (std::size_t i = 0; i < numbers_.size(); ++i) {
        const std::int32_t own = ranks.point_with(numbers_[i]);
        position_.push_back(own < 0 ? own : ranks.positions()[static_cast<std::size_t>(own)]);
        if (own >= 0) mine.push_back(static_cast<double>(i));
    }
    for (const double held : ranks.gather(mine)) gathered_.push_back(static_cast<std::size_t>(held));
}

template <int Dim>
std::vector<std::vector<Vector<Dim>>> HeldPoints<Dim>::take(
    std::initializer_list<std::span<const Vector<Dim>>> arrays) const {
    std::vector<std::vector<Vector<Dim>>> taken(arrays.size(), std::vector<Vector<Dim>>(numbers_.size()));
    for (std::size_t array = 0; array < arrays.size(); ++array)
        for (std::size_t i = 0; i < numbers_.size(); ++i)
            if (position_[i] >= 0) taken[array][i] = arrays.begin()[array][static_cast<std::size_t>(position_[i])];
    if (numbers_.empty() || part_->is_whole()) return taken;
    std::vector<double> mine;  // point after point
    for (std::size_t i = 0; i < numbers_.size(); ++i)
        for (const auto& values : taken)
            if (position_[i] >= 0) mine.insert(mine.end(), values[i].begin(), values[i].end());
    const std::vector<double> all = part_->ranks().gather(mine);
    auto value = as_vectors<Dim>(std::span<const double>(all)).begin();
    for (const std::size_t i : gathered_)
        for (auto& values : taken) values[i] = *value++;
    return taken;
}

template class HeldPoints<2>;
template class HeldPoints<3>;

}  // namespace abut::solid
