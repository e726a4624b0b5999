#pragma once
// Private to the sources of this layer: the only ones that see MPI.
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/ranks/communicator.hpp"

namespace abut::ranks {

struct Communicator::Impl {
    MPI_Comm comm = MPI_COMM_NULL;
    int rank = 0;
    int size = 0;

    Impl() = default;
    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
};

/// Throws Error with MPI's own words where a call of MPI has failed. MPI stops the whole program instead, unless the
/// host has set another error handler.
void require(int result, const char* call);

[[nodiscard]] inline MPI_Comm handle(const Communicator& communicator) { return communicator.impl().comm; }

/// A number of bytes or values as MPI takes it. Throws LimitExceeded beyond 2147483647.
[[nodiscard]] inline int as_count(std::size_t n) {
    if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw LimitExceeded("ranks: a message of " + std::to_string(n) +
                            " values, at most 2147483647 are possible. Take more ranks, or a coarser mesh.");
    return static_cast<int>(n);
}

/// Calls body(), which calls nothing that all ranks call together, and agrees on how it ended.
template <class Body>
void agreed(const Communicator& communicator, const Body& body) {
    std::exception_ptr error;
    try {
        body();
    } catch (...) {
        error = std::current_exception();
    }
    communicator.agree(error);
}

template <class T>
requires(std::is_same_v<T, double> || std::is_same_v<T, std::int32_t> || std::is_same_v<T, std::int64_t>)
    [[nodiscard]] MPI_Datatype type_of() {
    if constexpr (std::is_same_v<T, double>) return MPI_DOUBLE;
    if constexpr (std::is_same_v<T, std::int32_t>) return MPI_INT32_T;
    if constexpr (std::is_same_v<T, std::int64_t>) return MPI_INT64_T;
}

/// Values that came from all ranks, in their order.
template <class T>
struct Received {
    std::vector<T> values;
    std::vector<int> offsets;  ///< where those of a rank begin, one more at the end

    [[nodiscard]] std::span<const T> from(int rank) const {
        return std::span(values).subspan(offsets[rank], offsets[rank + 1] - offsets[rank]);
    }
};

[[nodiscard]] std::vector<int> offsets_of(const std::vector<int>& counts);

/// Sends values to all ranks, `counts[r]` of them to rank r, in the order of the ranks.
template <class T>
[[nodiscard]] Received<T> exchange(const Communicator& communicator, std::span<const T> values,
                                   const std::vector<int>& counts) {
    const int size = communicator.size();
    std::vector<int> received(size);
    require(MPI_Alltoall(counts.data(), 1, MPI_INT, received.data(), 1, MPI_INT, handle(communicator)), "MPI_Alltoall");
    Received<T> result;
    result.offsets = offsets_of(received);
    result.values.resize(result.offsets.back());
    const std::vector<int> offsets = offsets_of(counts);
    require(MPI_Alltoallv(values.data(), counts.data(), offsets.data(), type_of<T>(), result.values.data(), received.data(),
                          result.offsets.data(), type_of<T>(), handle(communicator)),
            "MPI_Alltoallv");
    return result;
}

/// All values of all ranks, on rank 0; nothing on the others.
template <class T>
[[nodiscard]] Received<T> gather_to_first(const Communicator& communicator, std::span<const T> values) {
    const int count = as_count(values.size());
    Received<T> result;
    std::vector<int> counts(communicator.size());
    require(MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, handle(communicator)), "MPI_Gather");
    if (communicator.rank() == 0) {
        result.offsets = offsets_of(counts);
        result.values.resize(result.offsets.back());
    }
    require(MPI_Gatherv(values.data(), count, type_of<T>(), result.values.data(), counts.data(), result.offsets.data(),
                        type_of<T>(), 0, handle(communicator)),
            "MPI_Gatherv");
    return result;
}

/// All values of all ranks, on all of them.
template <class T>
[[nodiscard]] Received<T> gather_to_all(const Communicator& communicator, std::span<const T> values) {
    const int count = as_count(values.size());
    std::vector<int> counts(communicator.size());
    require(MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, handle(communicator)), "MPI_Allgather");
    Received<T> result;
    result.offsets = offsets_of(counts);
    result.values.resize(result.offsets.back());
    require(MPI_Allgatherv(values.data(), count, type_of<T>(), result.values.data(), counts.data(), result.offsets.data(),
                           type_of<T>(), handle(communicator)),
            "MPI_Allgatherv");
    return result;
}

/// All bytes of all ranks, on all of them. An instance keeps them from call to call.
class BytesOfRanks {
public:
    /// Valid until the next call. Throws LimitExceeded on all ranks where MPI cannot take as many.
    [[nodiscard]] std::span<const std::byte> gather(const Communicator& communicator, std::span<const std::byte> mine);

private:
    std::vector<std::int64_t> sizes_;
    std::vector<int> counts_, offsets_;
    std::vector<std::byte> all_;
};

/// Replaces each value by the largest of all ranks; none may be NaN.
inline void take_largest(const Communicator& communicator, std::span<double> values) {
    require(MPI_Allreduce(MPI_IN_PLACE, values.data(), as_count(values.size()), MPI_DOUBLE, MPI_MAX, handle(communicator)),
            "MPI_Allreduce");
}

/// Copies what rank `root` has to all ranks.
template <class T>
void broadcast(const Communicator& communicator, std::span<T> values, int root = 0) {
    require(MPI_Bcast(values.data(), as_count(values.size()), type_of<T>(), root, handle(communicator)), "MPI_Bcast");
}

}  // namespace abut::ranks
