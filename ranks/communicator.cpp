#include "abut/ranks/communicator.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "abut/base/throw_again.hpp"
#include "abut/ranks/mpi.hpp"

namespace abut::ranks {
namespace {

/// An error as other ranks are told of it.
struct Told {
    std::int32_t kind = -1;  // of ErrorKind; -1: none that Abut knows
    std::string text;
    ErrorFacts facts = {};
};

Told told(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const Error& e) {
        return {static_cast<std::int32_t>(e.kind()), e.what(), e.facts()};
    } catch (const std::exception& e) {
        return {-1, e.what()};
    } catch (...) {
        return {-1, "an error of unknown type"};
    }
}

bool is_running() {
    int initialised = 0, finalised = 0;
    MPI_Initialized(&initialised);
    MPI_Finalized(&finalised);
    return initialised != 0 && finalised == 0;
}

}  // namespace

void require(int result, const char* call) {
    if (result == MPI_SUCCESS) return;
    char text[MPI_MAX_ERROR_STRING];
    int length = 0;
    MPI_Error_string(result, text, &length);
    throw Misuse(std::string("ranks: ") + call + " has failed: " + std::string(text, static_cast<std::size_t>(length)));
}

std::vector<int> offsets_of(const std::vector<int>& counts) {
    std::size_t total = 0;
    std::vector<int> offsets{0};
    for (const int count : counts) offsets.push_back(as_count(total += static_cast<std::size_t>(count)));
    return offsets;
}

std::span<const std::byte> BytesOfRanks::gather(const Communicator& communicator, std::span<const std::byte> mine) {
    const auto n_ranks = static_cast<std::size_t>(communicator.size());
    const auto size = static_cast<std::int64_t>(mine.size());
    sizes_.resize(n_ranks);
    require(MPI_Allgather(&size, 1, MPI_INT64_T, sizes_.data(), 1, MPI_INT64_T, handle(communicator)), "MPI_Allgather");
    counts_.clear();
    offsets_.clear();
    std::size_t total = 0;
    for (const std::int64_t n : sizes_) {
        offsets_.push_back(as_count(total));
        counts_.push_back(as_count(static_cast<std::size_t>(n)));
        total += static_cast<std::size_t>(n);
    }
    all_.resize(static_cast<std::size_t>(as_count(total)));
    require(MPI_Allgatherv(mine.data(), counts_[static_cast<std::size_t>(communicator.rank())], MPI_BYTE, all_.data(),
                           counts_.data(), offsets_.data(), MPI_BYTE, handle(communicator)),
            "MPI_Allgatherv");
    return all_;
}

Communicator::Impl::~Impl() {
    if (comm != MPI_COMM_NULL && is_running()) MPI_Comm_free(&comm);
}

Communicator::Communicator(int fortran_handle) : impl_(std::make_unique<Impl>()) {
    if (!is_running())
        throw Misuse("ranks: MPI is not running. Call MPI_Init_thread before, and MPI_Finalize after the last use.");
    require(MPI_Comm_dup(MPI_Comm_f2c(fortran_handle), &impl_->comm), "MPI_Comm_dup");
    require(MPI_Comm_rank(impl_->comm, &impl_->rank), "MPI_Comm_rank");
    require(MPI_Comm_size(impl_->comm, &impl_->size), "MPI_Comm_size");
}

Communicator::~Communicator() = default;
Communicator::Communicator(Communicator&&) noexcept = default;
Communicator& Communicator::operator=(Communicator&&) noexcept = default;

int Communicator::rank() const { return impl_->rank; }
int Communicator::size() const { return impl_->size; }

void Communicator::agree(const std::exception_ptr& error) const {
    const int mine = error ? rank() : size();
    int first = 0;
    require(MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, impl_->comm), "MPI_Allreduce");
    if (first == size()) return;
    Told cause;
    if (first == rank()) cause = told(error);
    const ErrorFacts& facts = cause.facts;
    std::array<std::int64_t, 5> head{cause.kind, as_count(cause.text.size()), facts.face_1, facts.face_2, facts.cell};
    std::array<double, 2> values{facts.value, facts.allowed};
    broadcast<std::int64_t>(*this, head, first);
    broadcast<double>(*this, values, first);
    cause.text.resize(static_cast<std::size_t>(head[1]));
    require(MPI_Bcast(cause.text.data(), static_cast<int>(head[1]), MPI_CHAR, first, impl_->comm), "MPI_Bcast");
    if (first == rank()) std::rethrow_exception(error);
    const std::string text = "on rank " + std::to_string(first) + ": " + cause.text;
    if (head[0] < 0) throw std::runtime_error(text);
    throw_again(Error(static_cast<ErrorKind>(head[0]), text, {head[2], head[3], head[4], values[0], values[1]}), text);
}

double Communicator::largest(double value) const {
    const std::array<double, 2> mine{std::isnan(value) ? 1.0 : 0.0,
                                     std::isnan(value) ? -std::numeric_limits<double>::infinity() : value};
    std::array<double, 2> all{};
    require(MPI_Allreduce(mine.data(), all.data(), 2, MPI_DOUBLE, MPI_MAX, impl_->comm), "MPI_Allreduce");
    return all[0] > 0.0 ? std::numeric_limits<double>::quiet_NaN() : all[1];
}

}  // namespace abut::ranks
