#pragma once
#include <memory>
#include <span>

#include "abut/dynamics/mass.hpp"

namespace abut::dynamics {

namespace detail {
[[noreturn]] void refuse_newton(int iterations, double change, double dt);
}

/// The matrix M + K of Newton's method in an implicit step, as sparse LU factors.
class NewtonMatrix {
public:
    NewtonMatrix(std::size_t n, std::span<const MatrixEntry> mass);
    ~NewtonMatrix();
    NewtonMatrix(NewtonMatrix&&) noexcept;
    NewtonMatrix& operator=(NewtonMatrix&&) noexcept;

    /// Sets K. Throws Diverged if M + K is singular.
    void factorise(std::span<const MatrixEntry> stiffness);
    /// (M + K)^-1 b
    void solve(std::span<const double> b, std::span<double> x) const;
    /// M a
    void multiply_mass(std::span<const double> a, std::span<double> product) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace abut::dynamics
