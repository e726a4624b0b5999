#include "abut/ranks/bytes.hpp"

#include <algorithm>

#include "abut/ranks/mpi.hpp"

namespace abut::ranks {
namespace {

constexpr int tag = 1;
constexpr std::size_t most_at_once = std::size_t{1} << 30;  // bytes of a message: MPI counts in 32 bits

/// Calls carry(first, number) for all bytes, message by message.
template <class Carry>
void each_message(std::vector<std::byte>& bytes, const Carry& carry) {
    for (std::size_t at = 0; at < bytes.size(); at += most_at_once)
        carry(bytes.data() + at, static_cast<int>(std::min(most_at_once, bytes.size() - at)));
}

}  // namespace

std::vector<std::byte> of_first(const Communicator& communicator, std::vector<std::byte> bytes) {
    auto size = static_cast<std::int64_t>(bytes.size());
    broadcast<std::int64_t>(communicator, {&size, 1});
    bytes.resize(static_cast<std::size_t>(size));
    each_message(bytes, [&](std::byte* first, int n) {
        require(MPI_Bcast(first, n, MPI_BYTE, 0, handle(communicator)), "MPI_Bcast");
    });
    return bytes;
}

std::vector<std::byte> from_first(const Communicator& communicator, std::vector<std::byte> bytes, int to) {
    if (to == 0) return bytes;
    const MPI_Comm comm = handle(communicator);
    auto size = static_cast<std::int64_t>(bytes.size());
    if (communicator.rank() == 0) {
        require(MPI_Send(&size, 1, MPI_INT64_T, to, tag, comm), "MPI_Send");
        each_message(bytes,
                     [&](std::byte* first, int n) { require(MPI_Send(first, n, MPI_BYTE, to, tag, comm), "MPI_Send"); });
        return {};
    }
    require(MPI_Recv(&size, 1, MPI_INT64_T, 0, tag, comm, MPI_STATUS_IGNORE), "MPI_Recv");
    bytes.resize(static_cast<std::size_t>(size));
    each_message(bytes, [&](std::byte* first, int n) {
        require(MPI_Recv(first, n, MPI_BYTE, 0, tag, comm, MPI_STATUS_IGNORE), "MPI_Recv");
    });
    return bytes;
}

}  // namespace abut::ranks
