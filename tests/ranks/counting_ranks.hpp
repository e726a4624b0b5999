#pragma once
// Ranks that count what is asked of them.
#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <vector>

#include "abut/dynamics/ranks.hpp"

namespace abut::test {

/// Calls of all ranks together.
struct Calls {
    std::int64_t fills = 0, sums = 0, folds = 0, collects = 0, gathers = 0, largest = 0, agreements = 0;

    [[nodiscard]] std::int64_t all() const { return fills + sums + folds + collects + gathers + largest + agreements; }
};

class CountingRanks final : public dynamics::Ranks {
public:
    /// Both must outlive it.
    CountingRanks(const dynamics::Ranks& ranks, Calls& calls) : ranks_(ranks), calls_(calls) {}

    [[nodiscard]] int rank() const override { return ranks_.rank(); }
    [[nodiscard]] int n_ranks() const override { return ranks_.n_ranks(); }
    [[nodiscard]] std::span<const std::int32_t> numbers() const override { return ranks_.numbers(); }
    [[nodiscard]] std::span<const std::int32_t> positions() const override { return ranks_.positions(); }
    [[nodiscard]] std::int32_t n_points() const override { return ranks_.n_points(); }
    [[nodiscard]] int dimension() const override { return ranks_.dimension(); }
    [[nodiscard]] dynamics::CopySet copy_set(std::span<const std::int32_t> positions) const override {
        return ranks_.copy_set(positions);
    }
    void fill(std::span<double> values, int width, dynamics::CopySet copies) const override {
        ++calls_.fills;
        ranks_.fill(values, width, copies);
    }
    void sum(const dynamics::Summands& summands, std::span<const double> terms, std::span<double> total) const override {
        ++calls_.sums;
        ranks_.sum(summands, terms, total);
    }
    [[nodiscard]] double fold(double start, std::span<const std::int64_t> numbers,
                              std::span<const double> terms) const override {
        ++calls_.folds;
        return ranks_.fold(start, numbers, terms);
    }
    [[nodiscard]] std::vector<double> collect(std::span<const double> values, int width) const override {
        ++calls_.collects;
        return ranks_.collect(values, width);
    }
    [[nodiscard]] std::vector<double> gather_to_first(std::span<const double> values) const override {
        ++calls_.collects;
        return ranks_.gather_to_first(values);
    }
    [[nodiscard]] std::vector<double> gather(std::span<const double> values) const override {
        ++calls_.gathers;
        return ranks_.gather(values);
    }
    [[nodiscard]] std::span<const std::byte> gather_bytes(std::span<const std::byte> mine) const override {
        ++calls_.gathers;
        return ranks_.gather_bytes(mine);
    }
    [[nodiscard]] double largest(double value) const override {
        ++calls_.largest;
        return ranks_.largest(value);
    }
    void agree(const std::exception_ptr& error) const override {
        ++calls_.agreements;
        ranks_.agree(error);
    }

private:
    const dynamics::Ranks& ranks_;
    Calls& calls_;
};

}  // namespace abut::test
