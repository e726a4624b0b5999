#include "abut/dynamics/newton.hpp"

#include <Eigen/SparseLU>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/dynamics/sparse.hpp"

namespace abut::dynamics {
struct NewtonMatrix::Impl {
    std::size_t n;
    Sparse mass;
    Eigen::SparseLU<Sparse> factors;
};

NewtonMatrix::NewtonMatrix(std::size_t n, std::span<const MatrixEntry> mass) : impl_(std::make_unique<Impl>()) {
    impl_->n = n;
    impl_->mass = assembled(n, mass);
}
NewtonMatrix::~NewtonMatrix() = default;
NewtonMatrix::NewtonMatrix(NewtonMatrix&&) noexcept = default;
NewtonMatrix& NewtonMatrix::operator=(NewtonMatrix&&) noexcept = default;

void NewtonMatrix::factorise(std::span<const MatrixEntry> stiffness) {
    Sparse sum = impl_->mass + assembled(impl_->n, stiffness);
    sum.makeCompressed();
    impl_->factors.compute(sum);
    if (impl_->factors.info() != Eigen::Success)
        throw Diverged("energy-momentum scheme: the matrix of Newton's method is singular (" +
                       impl_->factors.lastErrorMessage() + "). Take a smaller time step.");
}

void NewtonMatrix::solve(std::span<const double> b, std::span<double> x) const { dense(x) = impl_->factors.solve(dense(b)); }

void NewtonMatrix::multiply_mass(std::span<const double> a, std::span<double> product) const {
    dense(product) = impl_->mass * dense(a);
}

void detail::refuse_newton(int iterations, double change, double dt) {
    throw Diverged("energy-momentum scheme: Newton's method has not converged after " + std::to_string(iterations) +
                       " iterations (relative change " + number(change) + ") in a step of " + number(dt) +
                       " s. Take a smaller time step.",
                   {.value = change});
}

}  // namespace abut::dynamics
