#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "abut/ranks/communicator.hpp"

namespace abut::ranks {

/// The messages of one call of an exchange.
struct ExchangeCounts {
    std::int64_t neighbours_to = 0;    ///< ranks that this one sends to
    std::int64_t neighbours_from = 0;  ///< ranks that this one receives from
    std::int64_t sent = 0;             ///< entries
    std::int64_t received = 0;
};

/// Copies of entries that other ranks own: one message per neighbour and direction, in one call of MPI (a neighbourhood
/// collective on a graph of the ranks, with types that pick the entries out of the array: nothing is packed by us). Ranks
/// without neighbours take no part.
class Exchange {
public:
    /// `wanted`: positions in this rank's array of the copies that it wants, `owner` the rank that has each and `number` how
    /// that rank calls it, its position there. A call of all ranks. Throws BadInput on all where an owner or a number
    /// does not exist; `n_entries` is the length of this rank's array.
    Exchange(const Communicator& communicator, std::size_t n_entries, std::span<const std::int32_t> wanted,
             std::span<const int> owner, std::span<const std::int32_t> number);
    ~Exchange();
    Exchange(Exchange&&) noexcept;
    Exchange& operator=(Exchange&&) noexcept;

    /// Fills the copies of an array (n_entries, width). A call of all ranks, all with the same width.
    void fill(std::span<double> values, int width) const;

    [[nodiscard]] const ExchangeCounts& counts() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace abut::ranks
