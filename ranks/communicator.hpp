#pragma once
#include <exception>
#include <memory>

namespace abut::ranks {

/// The ranks that run something together. It is a duplicate of the host's communicator, so that our messages and those
/// of the host never meet. MPI belongs to the host, who initialises and finalises it; a communicator outlives nothing
/// of that.
///
/// One thread per rank calls (MPI_THREAD_FUNNELED is enough). Communicators, and all that is made on one, are destroyed by
/// all of their ranks together: MPI frees what they share.
class Communicator {
public:
    /// Made of a communicator as an integer, `MPI_Comm_c2f(comm)` in C, the communicator itself in Fortran: so that no
    /// header of ours needs that of MPI. A call of all of its ranks. Throws Misuse where MPI is not initialised, or is
    /// finalised.
    explicit Communicator(int fortran_handle);
    ~Communicator();
    Communicator(Communicator&&) noexcept;
    Communicator& operator=(Communicator&&) noexcept;

    [[nodiscard]] int rank() const;  ///< this one, from 0
    [[nodiscard]] int size() const;

    // Calls of all ranks together

    /// See dynamics::Ranks::agree.
    void agree(const std::exception_ptr& error) const;
    /// The largest of all ranks; NaN if one is.
    [[nodiscard]] double largest(double value) const;

    struct Impl;
    [[nodiscard]] const Impl& impl() const { return *impl_; }  ///< for the sources of this layer

private:
    std::unique_ptr<Impl> impl_;
};

}  // namespace abut::ranks
