#pragma once
// All ranks of the program.
#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

#include "abut/ranks/communicator.hpp"

namespace abut::test {

inline ranks::Communicator world() { return ranks::Communicator(MPI_Comm_c2f(MPI_COMM_WORLD)); }

/// Whether it is so on all ranks: a test that ends on one of them would leave the others waiting.
[[nodiscard]] inline bool everywhere(const ranks::Communicator& all, bool here) {
    return all.largest(here ? 0.0 : 1.0) == 0.0;
}

/// The other ranks sleep until the first one comes here: as they wait in MPI they would take processors from it.
inline void sleep_until_first(const ranks::Communicator& all) {
    constexpr int tag = 1;
    if (all.rank() == 0) {
        for (int rank = 1; rank < all.size(); ++rank) MPI_Send(nullptr, 0, MPI_BYTE, rank, tag, MPI_COMM_WORLD);
        return;
    }
    int is_here = 0;
    while (true) {
        MPI_Iprobe(0, tag, MPI_COMM_WORLD, &is_here, MPI_STATUS_IGNORE);
        if (is_here != 0) break;
        std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    MPI_Recv(nullptr, 0, MPI_BYTE, 0, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

/// Does it on the first rank alone; what it throws there is thrown on all.
template <class Do>
void on_first(const ranks::Communicator& all, Do&& what) {
    std::exception_ptr error;
    if (all.rank() == 0) {
        try {
            what();
        } catch (...) {
            error = std::current_exception();
        }
    }
    sleep_until_first(all);
    all.agree(error);
}

/// A vector of plain values that the first rank computes, on all of them; `compute` throws nothing.
template <class Values, class Compute>
[[nodiscard]] Values of_first(const ranks::Communicator& all, Compute&& compute) {
    Values values;
    if (all.rank() == 0) values = compute();
    sleep_until_first(all);
    std::uint64_t n = values.size();
    MPI_Bcast(&n, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    values.resize(n);
    MPI_Bcast(values.data(), static_cast<int>(n * sizeof values[0]), MPI_BYTE, 0, MPI_COMM_WORLD);
    return values;
}

/// Numbers 0 .. n-1 scattered over the ranks without any order; a rank may be given none.
inline std::vector<std::int32_t> scattered(std::int32_t n, int rank, int size, int empty_rank = -1) {
    std::vector<std::int32_t> mine;
    for (std::int32_t i = 0; i < n; ++i) {
        const auto hash = static_cast<std::uint32_t>(i) * 2654435761u;
        int owner = static_cast<int>((hash >> 16) % static_cast<std::uint32_t>(size));
        if (owner == empty_rank) owner = (owner + 1) % size;
        if (owner == rank) mine.push_back(i);
    }
    return mine;
}

}  // namespace abut::test
