#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/dynamics/ranks.hpp"
#include "abut/ranks/communicator.hpp"
#include "abut/ranks/exchange.hpp"

namespace abut::ranks {

/// Share of a rank in the points of a system.
struct SharedPoints {
    int dimension = 3;                       ///< values per point
    std::int32_t n_points = 0;               ///< of all ranks
    std::vector<std::int32_t> numbers;       ///< of this rank's points, increasing; each point is on one rank
    std::size_t n_entries = 0;               ///< of the arrays that `fill` takes: points and copies
    std::vector<std::int32_t> position;      ///< of each of this rank's points in these (n_owned)
    std::vector<std::int32_t> copies;        ///< positions of what is copied from others
    std::vector<int> owner;                  ///< the rank of each copy
    std::vector<std::int32_t> copied_point;  ///< its number among all points
};

/// Data exchanged so far.
struct Traffic {
    std::int64_t fills = 0;
    std::int64_t messages = 0;  ///< sent by this rank in fills
    std::int64_t bytes = 0;     ///< sent by this rank in fills
    std::int64_t sums = 0;
    std::int64_t gathers = 0;
    std::int64_t gathered_bytes = 0;  ///< received in gathers
    std::int64_t reductions = 0;      ///< of at most 4 numbers: `largest`, `agree` and the like
};

/// dynamics::Ranks over MPI.
class PointRanks final : public dynamics::Ranks {
public:
    /// A call of all ranks. The communicator must outlive it. Throws BadInput on all ranks where the points do not fit
    /// together: a number out of order, twice or not at all, or a copy of a point that its owner does not have.
    PointRanks(const Communicator& communicator, SharedPoints points);
    ~PointRanks() override;

    [[nodiscard]] int rank() const override;
    [[nodiscard]] int n_ranks() const override;
    [[nodiscard]] std::span<const std::int32_t> numbers() const override;
    [[nodiscard]] std::span<const std::int32_t> positions() const override;
    [[nodiscard]] std::int32_t n_points() const override;
    [[nodiscard]] int dimension() const override;
    [[nodiscard]] dynamics::CopySet copy_set(std::span<const std::int32_t> positions) const override;
    void fill(std::span<double> values, int width, dynamics::CopySet copies) const override;
    void sum(const dynamics::Summands& summands, std::span<const double> terms, std::span<double> total) const override;
    [[nodiscard]] double fold(double start, std::span<const std::int64_t> numbers,
                              std::span<const double> terms) const override;
    [[nodiscard]] std::vector<double> collect(std::span<const double> values, int width) const override;
    [[nodiscard]] std::vector<double> gather_to_first(std::span<const double> values) const override;
    [[nodiscard]] std::vector<double> gather(std::span<const double> values) const override;
    [[nodiscard]] std::span<const std::byte> gather_bytes(std::span<const std::byte> mine) const override;
    [[nodiscard]] double largest(double value) const override;
    void agree(const std::exception_ptr& error) const override;

    [[nodiscard]] const ExchangeCounts& counts() const;  ///< of one `fill` of the copies that were chosen last
    [[nodiscard]] const Traffic& traffic() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace abut::ranks
