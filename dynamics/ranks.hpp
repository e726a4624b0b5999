#pragma once
#include <cstddef>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut::dynamics {

/// Terms of a sum over points: those whose number is in [first, last), each with `per_point` values of `width` components.
struct Summands {
    std::int32_t per_point = 1;
    std::int32_t width = 1;
    std::int32_t first = 0;
    std::int32_t last = std::numeric_limits<std::int32_t>::max();
};

/// A choice among the copies that a rank has of others.
enum class CopySet : std::int32_t { all = 0 };

/// The ranks that the points of a system are shared out to, as one of them sees them; where there is one alone, OneRank. The
/// points of a rank are numbered in the order of their numbers among all points.
///
/// Every function from `copy_set` on is a call of all ranks together: each waits until the others call the same.
class Ranks {
public:
    virtual ~Ranks() = default;

    /// Whether all points are here, each where its number says: then no value has to be looked up, copied or brought.
    [[nodiscard]] virtual bool is_one() const { return false; }
    [[nodiscard]] virtual int rank() const = 0;     ///< this one, from 0
    [[nodiscard]] virtual int n_ranks() const = 0;  ///< with this one
    /// Numbers of this rank's points among all, increasing (n_owned).
    [[nodiscard]] virtual std::span<const std::int32_t> numbers() const = 0;
    /// Positions of this rank's points among the entries of the arrays that it fills, its points and copies of others,
    /// increasing (n_owned).
    [[nodiscard]] virtual std::span<const std::int32_t> positions() const = 0;
    [[nodiscard]] virtual std::int32_t n_points() const = 0;  ///< of all ranks
    [[nodiscard]] virtual int dimension() const = 0;          ///< values per point
    /// Number of one of this rank's points among all.
    [[nodiscard]] virtual std::int32_t number_of(std::size_t point) const { return numbers()[point]; }
    /// This rank's point with that number among all; -1: it is on another rank.
    [[nodiscard]] virtual std::int32_t point_with(std::int32_t number) const;

    /// Chooses those at these positions, as long as the ranks last.
    [[nodiscard]] virtual CopySet copy_set(std::span<const std::int32_t> positions) const = 0;
    /// Fills what this rank copies of others, or chose of it: values by entry (n_entries, width).
    virtual void fill(std::span<double> values, int width, CopySet copies) const = 0;
    /// Sums of the terms of all ranks by component (width), with the bits that one rank gets which adds all of them up in
    /// blocks of 1,024 values (base/parallel.hpp). `terms` are those of this rank's points in the range (n, per_point,
    /// width).
    virtual void sum(const Summands& summands, std::span<const double> terms, std::span<double> total) const = 0;
    /// start + the terms of all ranks, one after the other by number. `numbers`: of this rank's terms, each on one rank.
    [[nodiscard]] virtual double fold(double start, std::span<const std::int64_t> numbers,
                                      std::span<const double> terms) const = 0;
    /// Values by point (n_owned, width) of all ranks in the order of the points, on rank 0; nothing on the others.
    [[nodiscard]] virtual std::vector<double> collect(std::span<const double> values, int width) const = 0;
    /// The values of all ranks, rank after rank, on rank 0; nothing on the others.
    [[nodiscard]] virtual std::vector<double> gather_to_first(std::span<const double> values) const = 0;
    /// The values of all ranks on all of them, rank after rank.
    [[nodiscard]] virtual std::vector<double> gather(std::span<const double> values) const = 0;
    /// The bytes of all ranks on all of them, rank after rank; they stay until the next call.
    [[nodiscard]] virtual std::span<const std::byte> gather_bytes(std::span<const std::byte> mine) const = 0;
    /// The largest of all ranks; NaN if one is.
    [[nodiscard]] virtual double largest(double value) const = 0;
    /// Returns where no rank brings an error. Else it throws on all ranks the error of the first rank that has one: on the
    /// others as an error of the same type with the same facts, and the rank in front.
    virtual void agree(const std::exception_ptr& error) const = 0;
};

/// The one rank that has all points. Without their number it serves a system that does not know of ranks: then only
/// `numbers`, `positions` and `n_points` know none of them.
class OneRank final : public Ranks {
public:
    OneRank() = default;
    OneRank(std::int32_t n_points, int dimension);

    [[nodiscard]] bool is_one() const override { return true; }
    [[nodiscard]] int rank() const override { return 0; }
    [[nodiscard]] int n_ranks() const override { return 1; }
    [[nodiscard]] std::span<const std::int32_t> numbers() const override { return numbers_; }
    [[nodiscard]] std::span<const std::int32_t> positions() const override { return numbers_; }
    [[nodiscard]] std::int32_t n_points() const override { return static_cast<std::int32_t>(numbers_.size()); }
    [[nodiscard]] int dimension() const override { return dimension_; }
    [[nodiscard]] std::int32_t number_of(std::size_t point) const override { return static_cast<std::int32_t>(point); }
    [[nodiscard]] std::int32_t point_with(std::int32_t number) const override { return number; }
    [[nodiscard]] CopySet copy_set(std::span<const std::int32_t>) const override { return CopySet::all; }
    void fill(std::span<double>, int, CopySet) const override {}
    void sum(const Summands& summands, std::span<const double> terms, std::span<double> total) const override;
    [[nodiscard]] double fold(double start, std::span<const std::int64_t> numbers,
                              std::span<const double> terms) const override;
    [[nodiscard]] std::vector<double> collect(std::span<const double> values, int) const override { return gather(values); }
    [[nodiscard]] std::vector<double> gather_to_first(std::span<const double> values) const override {
        return gather(values);
    }
    [[nodiscard]] std::vector<double> gather(std::span<const double> values) const override {
        return {values.begin(), values.end()};
    }
    [[nodiscard]] std::span<const std::byte> gather_bytes(std::span<const std::byte> mine) const override { return mine; }
    [[nodiscard]] double largest(double value) const override { return value; }
    void agree(const std::exception_ptr& error) const override {
        if (error) std::rethrow_exception(error);
    }

private:
    std::vector<std::int32_t> numbers_;
    int dimension_ = 1;
};

/// Ranks of all systems that do not know of ranks.
[[nodiscard]] const Ranks& one_rank();

/// The result of body(), once all ranks have agreed that it ended well on each. `body` must not call what all ranks call
/// together.
template <class Body>
auto agreed(const Ranks& ranks, const Body& body) {
    if (ranks.is_one()) return body();
    using Result = decltype(body());
    std::exception_ptr error;
    if constexpr (std::is_void_v<Result>) {
        try {
            body();
        } catch (...) {
            error = std::current_exception();
        }
        ranks.agree(error);
    } else {
        std::optional<Result> result;
        try {
            result.emplace(body());
        } catch (...) {
            error = std::current_exception();
        }
        ranks.agree(error);
        return *std::move(result);
    }
}

/// The ranks of a system that says so; one for all others.
template <class S>
[[nodiscard]] const Ranks& ranks_of(const S& system) {
    if constexpr (requires { system.ranks(); })
        return system.ranks();
    else
        return one_rank();
}

/// A feature that is made for one rank alone.
struct ForOneRank {
    const char* name;  ///< in the user's words
    bool is_used = true;
};
/// Refuses what several ranks cannot do: throws BadInput naming the first of these that is used, unless there is one rank.
void refuse_ranks(const Ranks& ranks, std::initializer_list<ForOneRank> features);

}  // namespace abut::dynamics
