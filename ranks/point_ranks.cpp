#include "abut/ranks/point_ranks.hpp"

#include <algorithm>
#include <utility>

#include "abut/ranks/mpi.hpp"
#include "abut/ranks/ordered_sums.hpp"

namespace abut::ranks {
namespace {

/// The points are on one rank each.
void check_cover(const Communicator& communicator, const SharedPoints& points) {
    agreed(communicator, [&] {
        for (std::size_t i = 0; i < points.numbers.size(); ++i)
            if (points.numbers[i] < (i == 0 ? 0 : points.numbers[i - 1] + 1) || points.numbers[i] >= points.n_points)
                throw BadInput("ranks: point " + std::to_string(points.numbers[i]) + " of rank " +
                                   std::to_string(communicator.rank()) + " is out of order, given twice, or not one of " +
                                   std::to_string(points.n_points) + ". Give numbers in increasing order.",
                               {.value = static_cast<double>(points.numbers[i])});
    });
    auto all = gather<std::int32_t>(communicator, points.numbers).values;
    agreed(communicator, [&] {
        if (communicator.rank() != 0) return;
        std::ranges::sort(all);
        for (std::size_t i = 0; i < std::max(all.size(), static_cast<std::size_t>(points.n_points)); ++i)
            if (i >= all.size() || all[i] != static_cast<std::int32_t>(i))
                throw BadInput("ranks: point " + std::to_string(i) + " of " + std::to_string(points.n_points) +
                                   " is on no rank, or another one is on two. Give each point to one rank.",
                               {.value = static_cast<double>(i)});
    });
}

/// Positions at their owners of the copies that are wanted.
std::vector<std::int32_t> positions_at_owners(const Communicator& communicator, const SharedPoints& points) {
    const int size = communicator.size();
    agreed(communicator, [&] {
        for (const int owner : points.owner)
            if (owner < 0 || owner >= size)
                throw BadInput("ranks: a copy is wanted of rank " + std::to_string(owner) + ", but there are " +
                                   std::to_string(size) + " ranks, counted from 0.",
                               {.value = static_cast<double>(owner), .allowed = static_cast<double>(size - 1)});
    });
    std::vector<std::vector<std::size_t>> of_rank(size);
    for (std::size_t i = 0; i < points.owner.size(); ++i) of_rank[points.owner[i]].push_back(i);
    std::vector<int> counts;
    std::vector<std::int32_t> numbers;
    for (const auto& copies : of_rank) {
        counts.push_back(as_count(copies.size()));
        for (const std::size_t i : copies) numbers.push_back(points.copied_point[i]);
    }
    const auto asked = exchange<std::int32_t>(communicator, numbers, counts);
    std::vector<std::int32_t> answers;
    agreed(communicator, [&] {
        for (const std::int32_t number : asked.values) {
            const auto at = std::ranges::lower_bound(points.numbers, number);
            if (at == points.numbers.end() || *at != number)
                throw BadInput("ranks: a copy of point " + std::to_string(number) + " is wanted of rank " +
                                   std::to_string(communicator.rank()) + ", which does not own it.",
                               {.value = static_cast<double>(number)});
            answers.push_back(points.position[static_cast<std::size_t>(at - points.numbers.begin())]);
        }
    });
    std::vector<int> back;
    for (int rank = 0; rank < size; ++rank) back.push_back(asked.offsets[rank + 1] - asked.offsets[rank]);
    const auto answered = exchange<std::int32_t>(communicator, answers, back);
    std::vector<std::int32_t> positions(points.owner.size());
    for (int rank = 0; rank < size; ++rank)
        for (std::size_t i = 0; i < of_rank[rank].size(); ++i) positions[of_rank[rank][i]] = answered.from(rank)[i];
    return positions;
}

const SharedPoints& checked(const Communicator& communicator, const SharedPoints& points) {
    check_cover(communicator, points);
    return points;
}

}  // namespace

struct PointRanks::Impl {
    const Communicator& communicator;
    SharedPoints points;
    Exchange exchange;
    OrderedSums sums;
    Traffic traffic;

    Impl(const Communicator& all, SharedPoints shared)
        : communicator(all),
          points(std::move(shared)),
          exchange(all, points.n_entries, points.copies, points.owner, positions_at_owners(all, checked(all, points))),
          sums(all, points.numbers, points.n_points) {}
};

PointRanks::PointRanks(const Communicator& communicator, SharedPoints points)
    : impl_(std::make_unique<Impl>(communicator, std::move(points))) {}

PointRanks::~PointRanks() = default;

int PointRanks::rank() const { return impl_->communicator.rank(); }
std::span<const std::int32_t> PointRanks::numbers() const { return impl_->points.numbers; }
std::int32_t PointRanks::n_points() const { return impl_->points.n_points; }
int PointRanks::dimension() const { return impl_->points.dimension; }

void PointRanks::fill(std::span<double> values, int width) const {
    impl_->exchange.fill(values, width);
    ++impl_->traffic.fills;
    impl_->traffic.messages += counts().neighbours_to;
    impl_->traffic.bytes += counts().sent * width * static_cast<std::int64_t>(sizeof(double));
}

void PointRanks::sum(const dynamics::Summands& summands, std::span<const double> terms, std::span<double> total) const {
    ++impl_->traffic.sums;
    impl_->sums.sum(summands, terms, total);
}

double PointRanks::fold(double start, std::span<const std::int32_t> numbers, std::span<const double> terms) const {
    ++impl_->traffic.sums;
    const auto all_numbers = gather<std::int32_t>(impl_->communicator, numbers);
    const auto all_terms = gather<double>(impl_->communicator, terms);
    std::vector<std::pair<std::int32_t, double>> by_number;
    for (std::size_t i = 0; i < all_numbers.values.size(); ++i)
        by_number.emplace_back(all_numbers.values[i], all_terms.values[i]);
    std::ranges::sort(by_number, {}, &std::pair<std::int32_t, double>::first);
    for (const auto& [number, term] : by_number) start += term;
    broadcast<double>(impl_->communicator, std::span(&start, 1));
    return start;
}

double PointRanks::largest(double value) const {
    ++impl_->traffic.reductions;
    return impl_->communicator.largest(value);
}

void PointRanks::agree(const std::exception_ptr& error) const {
    ++impl_->traffic.reductions;
    impl_->communicator.agree(error);
}

const ExchangeCounts& PointRanks::counts() const { return impl_->exchange.counts(); }
const Traffic& PointRanks::traffic() const { return impl_->traffic; }

}  // namespace abut::ranks
