#include "abut/ranks/point_ranks.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "abut/ranks/mpi.hpp"
#include "abut/ranks/ordered_sums.hpp"

namespace abut::ranks {
namespace {

/// The points are on one rank each.
void check_cover(const Communicator& communicator, const SharedPoints& points) {
    std::array<std::int32_t, 2> of_first{points.n_points, points.dimension};
    broadcast<std::int32_t>(communicator, of_first);
    agreed(communicator, [&] {
        if (of_first != std::array{points.n_points, points.dimension})
            throw BadInput("ranks: " + std::to_string(points.n_points) + " points of " + std::to_string(points.dimension) +
                           " values are given, but on rank 0 they are " + std::to_string(of_first[0]) + " of " +
                           std::to_string(of_first[1]) + ". Give all ranks the same.");
        if (points.position.size() != points.numbers.size())
            throw BadInput("ranks: " + std::to_string(points.numbers.size()) + " points are given with " +
                           std::to_string(points.position.size()) + " positions. Give one per point.");
        if (points.owner.size() != points.copies.size() || points.copied_point.size() != points.copies.size())
            throw BadInput("ranks: " + std::to_string(points.copies.size()) + " copies are given with " +
                           std::to_string(points.owner.size()) + " owners and " +
                           std::to_string(points.copied_point.size()) + " numbers. Give one of each per copy.");
        for (std::size_t i = 0; i < points.numbers.size(); ++i)
            if (points.numbers[i] < (i == 0 ? 0 : points.numbers[i - 1] + 1) || points.numbers[i] >= points.n_points)
                throw BadInput("ranks: point " + std::to_string(points.numbers[i]) + " of rank " +
                                   std::to_string(communicator.rank()) + " is out of order, given twice, or not one of " +
                                   std::to_string(points.n_points) + ". Give numbers in increasing order.",
                               {.value = static_cast<double>(points.numbers[i])});
    });
    auto all = gather_to_first<std::int32_t>(communicator, points.numbers).values;
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
    std::vector<std::int32_t> copied_position;  // of each copy, at its owner
    std::vector<Exchange> exchanges;            // by CopySet
    OrderedSums sums;
    Traffic traffic;
    BytesOfRanks bytes;

    Impl(const Communicator& all, SharedPoints shared)
        : communicator(all),
          points(std::move(shared)),
          copied_position(positions_at_owners(all, checked(all, points))),
          sums(all, points.numbers, points.n_points) {
        exchanges.emplace_back(all, points.n_entries, points.copies, points.owner, copied_position);
    }
};

PointRanks::PointRanks(const Communicator& communicator, SharedPoints points)
    : impl_(std::make_unique<Impl>(communicator, std::move(points))) {}

PointRanks::~PointRanks() = default;

int PointRanks::rank() const { return impl_->communicator.rank(); }
int PointRanks::n_ranks() const { return impl_->communicator.size(); }
std::span<const std::int32_t> PointRanks::numbers() const { return impl_->points.numbers; }
std::span<const std::int32_t> PointRanks::positions() const { return impl_->points.position; }
std::int32_t PointRanks::n_points() const { return impl_->points.n_points; }
int PointRanks::dimension() const { return impl_->points.dimension; }

dynamics::CopySet PointRanks::copy_set(std::span<const std::int32_t> positions) const {
    const SharedPoints& points = impl_->points;
    std::vector<bool> chosen(points.n_entries, false);
    agreed(impl_->communicator, [&] {
        for (const std::int32_t position : positions) {
            if (position < 0 || static_cast<std::size_t>(position) >= points.n_entries)
                throw BadInput("ranks: a copy is chosen at entry " + std::to_string(position) + " of an array of " +
                                   std::to_string(points.n_entries) + ", counted from 0.",
                               {.value = static_cast<double>(position), .allowed = static_cast<double>(points.n_entries)});
            chosen[static_cast<std::size_t>(position)] = true;
        }
    });
    std::vector<std::int32_t> copies, copied_position;
    std::vector<int> owner;
    for (std::size_t i = 0; i < points.copies.size(); ++i) {
        if (!chosen[static_cast<std::size_t>(points.copies[i])]) continue;
        copies.push_back(points.copies[i]);
        owner.push_back(points.owner[i]);
        copied_position.push_back(impl_->copied_position[i]);
    }
    impl_->exchanges.emplace_back(impl_->communicator, points.n_entries, copies, owner, copied_position);
    return static_cast<dynamics::CopySet>(impl_->exchanges.size() - 1);
}

void PointRanks::fill(std::span<double> values, int width, dynamics::CopySet copies) const {
    const Exchange& exchange = impl_->exchanges[static_cast<std::size_t>(copies)];
    exchange.fill(values, width);
    ++impl_->traffic.fills;
    impl_->traffic.messages += exchange.counts().neighbours_to;
    impl_->traffic.bytes += exchange.counts().sent * width * static_cast<std::int64_t>(sizeof(double));
}

void PointRanks::sum(const dynamics::Summands& summands, std::span<const double> terms, std::span<double> total) const {
    ++impl_->traffic.sums;
    impl_->sums.sum(summands, terms, total);
}

double PointRanks::fold(double start, std::span<const std::int64_t> numbers, std::span<const double> terms) const {
    ++impl_->traffic.sums;
    const auto all_numbers = ranks::gather_to_first<std::int64_t>(impl_->communicator, numbers).values;
    const auto all_terms = ranks::gather_to_first<double>(impl_->communicator, terms).values;
    std::vector<std::pair<std::int64_t, double>> by_number;
    for (std::size_t i = 0; i < all_numbers.size(); ++i) by_number.emplace_back(all_numbers[i], all_terms[i]);
    std::ranges::sort(by_number, {}, &std::pair<std::int64_t, double>::first);
    for (const auto& [number, term] : by_number) start += term;
    broadcast<double>(impl_->communicator, std::span(&start, 1));
    return start;
}

std::vector<double> PointRanks::collect(std::span<const double> values, int width) const {
    ++impl_->traffic.gathers;
    const auto numbers = ranks::gather_to_first<std::int32_t>(impl_->communicator, impl_->points.numbers).values;
    const auto all = ranks::gather_to_first<double>(impl_->communicator, values).values;
    std::vector<double> ordered(all.size());
    const auto n = static_cast<std::size_t>(width);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(i * n), n,
                    ordered.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(numbers[i]) * n));
    return ordered;
}

std::vector<double> PointRanks::gather_to_first(std::span<const double> values) const {
    ++impl_->traffic.gathers;
    return ranks::gather_to_first<double>(impl_->communicator, values).values;
}

std::vector<double> PointRanks::gather(std::span<const double> values) const {
    ++impl_->traffic.gathers;
    std::vector<double> all = gather_to_all<double>(impl_->communicator, values).values;
    impl_->traffic.gathered_bytes += static_cast<std::int64_t>((all.size() - values.size()) * sizeof(double));
    return all;
}

std::span<const std::byte> PointRanks::gather_bytes(std::span<const std::byte> mine) const {
    ++impl_->traffic.gathers;
    const auto all = impl_->bytes.gather(impl_->communicator, mine);
    impl_->traffic.gathered_bytes += static_cast<std::int64_t>(all.size() - mine.size());
    return all;
}

double PointRanks::largest(double value) const {
    ++impl_->traffic.reductions;
    return impl_->communicator.largest(value);
}

void PointRanks::agree(const std::exception_ptr& error) const {
    ++impl_->traffic.reductions;
    impl_->communicator.agree(error);
}

const ExchangeCounts& PointRanks::counts() const { return impl_->exchanges.back().counts(); }
const Traffic& PointRanks::traffic() const { return impl_->traffic; }

}  // namespace abut::ranks
