#pragma once
// The answers that ranks give in a run, for a rank that goes through it once more by itself.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <vector>

#include "abut/dynamics/ranks.hpp"

namespace abut::benchmark {

/// Asks other ranks and writes down what they answer; after `replay` it answers the same, in the same order, and asks
/// nobody. Who makes the same calls again works alone then, and its time is that of its own work, without waiting.
class RecordedRanks final : public dynamics::Ranks {
public:
    /// `n_entries`: of the arrays that `fill` takes. The ranks must outlive it.
    RecordedRanks(const dynamics::Ranks& ranks, std::size_t n_entries) : ranks_(ranks) {
        std::vector<char> is_own(n_entries, 0);
        for (const std::int32_t i : ranks.positions()) is_own[static_cast<std::size_t>(i)] = 1;
        for (std::size_t i = 0; i < n_entries; ++i)
            if (is_own[i] == 0) copies_.push_back(i);
    }
    /// From the first answer on, as often as it is called.
    void replay() {
        is_replay_ = true;
        next_values_ = next_bytes_ = next_copy_set_ = 0;
    }

    [[nodiscard]] int rank() const override { return ranks_.rank(); }
    [[nodiscard]] int n_ranks() const override { return ranks_.n_ranks(); }
    [[nodiscard]] std::span<const std::int32_t> numbers() const override { return ranks_.numbers(); }
    [[nodiscard]] std::span<const std::int32_t> positions() const override { return ranks_.positions(); }
    [[nodiscard]] std::int32_t n_points() const override { return ranks_.n_points(); }
    [[nodiscard]] int dimension() const override { return ranks_.dimension(); }

    [[nodiscard]] dynamics::CopySet copy_set(std::span<const std::int32_t> positions) const override {
        return is_replay_ ? copy_sets_[next_copy_set_++] : copy_sets_.emplace_back(ranks_.copy_set(positions));
    }
    void fill(std::span<double> values, int width, dynamics::CopySet copies) const override {
        const auto n = static_cast<std::size_t>(width);
        if (!is_replay_) {
            ranks_.fill(values, width, copies);
            auto& copied = values_.emplace_back();
            for (const std::size_t i : copies_)
                for (std::size_t k = 0; k < n; ++k) copied.push_back(values[i * n + k]);
        } else {
            const double* from = next().data();
            for (const std::size_t i : copies_)
                for (std::size_t k = 0; k < n; ++k) values[i * n + k] = *from++;
        }
    }
    void sum(const dynamics::Summands& summands, std::span<const double> terms, std::span<double> total) const override {
        if (!is_replay_) {
            ranks_.sum(summands, terms, total);
            values_.emplace_back(total.begin(), total.end());
        } else {
            std::ranges::copy(next(), total.begin());
        }
    }
    [[nodiscard]] double fold(double start, std::span<const std::int64_t> numbers,
                              std::span<const double> terms) const override {
        return one([&] { return ranks_.fold(start, numbers, terms); });
    }
    [[nodiscard]] std::vector<double> collect(std::span<const double> values, int width) const override {
        return is_replay_ ? next() : values_.emplace_back(ranks_.collect(values, width));
    }
    [[nodiscard]] std::vector<double> gather_to_first(std::span<const double> values) const override {
        return is_replay_ ? next() : values_.emplace_back(ranks_.gather_to_first(values));
    }
    [[nodiscard]] std::vector<double> gather(std::span<const double> values) const override {
        return is_replay_ ? next() : values_.emplace_back(ranks_.gather(values));
    }
    [[nodiscard]] std::span<const std::byte> gather_bytes(std::span<const std::byte> mine) const override {
        if (is_replay_) return bytes_[next_bytes_++];
        const auto all = ranks_.gather_bytes(mine);
        bytes_.emplace_back(all.begin(), all.end());
        return all;
    }
    [[nodiscard]] double largest(double value) const override {
        return one([&] { return ranks_.largest(value); });
    }
    void agree(const std::exception_ptr& error) const override {
        if (!is_replay_)
            ranks_.agree(error);
        else if (error)
            std::rethrow_exception(error);
    }

private:
    [[nodiscard]] const std::vector<double>& next() const { return values_[next_values_++]; }
    template <class Ask>
    double one(const Ask& ask) const {
        if (is_replay_) return next()[0];
        return values_.emplace_back(1, ask())[0];
    }

    const dynamics::Ranks& ranks_;
    std::vector<std::size_t> copies_;
    bool is_replay_ = false;
    mutable std::vector<std::vector<double>> values_;
    mutable std::vector<std::vector<std::byte>> bytes_;
    mutable std::vector<dynamics::CopySet> copy_sets_;
    mutable std::size_t next_values_ = 0, next_bytes_ = 0, next_copy_set_ = 0;
};

}  // namespace abut::benchmark
