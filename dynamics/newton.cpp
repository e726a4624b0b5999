#include "abut/dynamics/newton.hpp"

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <stdexcept>
#include <string>
#include <vector>

#include "abut/geometry/messages.hpp"

namespace abut::dynamics {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using ConstMap = Eigen::Map<const Eigen::VectorXd>;

Sparse assembled(std::size_t n, std::span<const MatrixEntry> entries) {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries.size());
    for (const auto& [row, column, value] : entries) triplets.emplace_back(row, column, value);
    Sparse matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
}

ConstMap vector(std::span<const double> values) { return {values.data(), static_cast<Eigen::Index>(values.size())}; }
Eigen::Map<Eigen::VectorXd> vector(std::span<double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

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
        throw std::runtime_error("energy-momentum scheme: the matrix of Newton's method is singular (" +
                                 impl_->factors.lastErrorMessage() + "). Take a smaller time step.");
}

void NewtonMatrix::solve(std::span<const double> b, std::span<double> x) const {
    vector(x) = impl_->factors.solve(vector(b));
}

void NewtonMatrix::multiply_mass(std::span<const double> a, std::span<double> product) const {
    vector(product) = impl_->mass * vector(a);
}

void detail::refuse_newton(int iterations, double change, double dt) {
    throw std::runtime_error("energy-momentum scheme: Newton's method has not converged after " +
                             std::to_string(iterations) + " iterations (relative change " + number(change) +
                             ") in a step of " + number(dt) + " s. Take a smaller time step.");
}

}  // namespace abut::dynamics
