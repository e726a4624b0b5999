#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "abut/base/decompositions.hpp"
#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"
#include "abut/base/rotation.hpp"

using namespace abut;

namespace {

constexpr double rounding = 1e-14;

}  // namespace

TEST_CASE("the eigenvalues of a symmetric matrix come in rising order, with their vectors", "[base][decompositions]") {
    const Matrix<2> plane{{2.0, 1.0}, {1.0, 2.0}};  // 1 along (1, -1), 3 along (1, 1)
    const SymmetricEigen<2> eigen = symmetric_eigen(plane);
    CHECK((eigen.values - Vector<2>(1.0, 3.0)).norm() <= rounding);
    CHECK(std::abs(eigen.vectors.col(1).dot(Vector<2>(1.0, 1.0)) / std::sqrt(2.0)) == Approx(1.0).epsilon(rounding));
    CHECK((symmetric_eigenvalues(plane) - Vector<2>(1.0, 3.0)).norm() <= rounding);

    const Matrix<3> space{{4.0, 0.0, 0.0}, {0.0, 2.0, 1.0}, {0.0, 1.0, 2.0}};
    CHECK((symmetric_eigen(space).values - Vector<3>(1.0, 3.0, 4.0)).norm() <= 10.0 * rounding);
    CHECK((symmetric_eigenvalues(space) - Vector<3>(1.0, 3.0, 4.0)).norm() <= 10.0 * rounding);
    const DenseEigen of_any_size = symmetric_eigen(Eigen::MatrixXd(as_eigen(space)));
    CHECK((of_any_size.values - Eigen::Vector3d(1.0, 3.0, 4.0)).norm() <= 10.0 * rounding);
}

TEST_CASE("the largest eigenvalue of a tridiagonal matrix is that of a chain of equal springs", "[base][decompositions]") {
    const std::size_t n = 50;
    const double angle = std::acos(-1.0) / (2.0 * (n + 1));  // 2 - 2 cos(k pi/(n+1)), k = n
    CHECK(largest_eigenvalue(std::vector<double>(n, 2.0), std::vector<double>(n - 1, -1.0)) ==
          Approx(4.0 * std::pow(std::cos(angle), 2)).epsilon(rounding));
    CHECK(largest_eigenvalue(std::vector<double>{3.0}, {}) == 3.0);
    CHECK(largest_eigenvalue(std::vector<double>(3, 0.0), std::vector<double>(2, 0.0)) == 0.0);
    for (const double unit : {1e-60, 1e60})
        CHECK(largest_eigenvalue(std::vector<double>{2.0 * unit, 2.0 * unit}, std::vector<double>{unit}) ==
              Approx(3.0 * unit).epsilon(rounding));
}

TEST_CASE("the pseudo-inverse leaves out directions in which a matrix has next to nothing", "[base][decompositions]") {
    const Vector<3> u = Vector<3>(1.0, 2.0, 2.0) / 3.0, v = Vector<3>(2.0, 1.0, -2.0) / 3.0;  // orthonormal
    const Matrix<3> matrix = 4.0 * u * u.transpose() + 1e-13 * v * v.transpose();
    const Matrix<3> least = 0.25 * u * u.transpose();
    CHECK((pseudo_inverse(matrix, 1e-12) - least).norm() <= 10.0 * rounding);
    CHECK(pseudo_inverse(matrix, 1e-15).norm() > 1e12);
}

TEST_CASE("singular values are not negative, the largest first, and give the matrix back", "[base][decompositions]") {
    const Matrix<3> matrix{{0.0, -2.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, -3.0}};  // mirrored
    const SingularValues svd = singular_values(matrix);
    CHECK((svd.values - Vector<3>(3.0, 2.0, 1.0)).norm() <= 10.0 * rounding);
    CHECK((svd.u * svd.values.asDiagonal() * svd.v.transpose() - matrix).norm() <= 10.0 * rounding);
    CHECK(spectral_norm(matrix) == Approx(3.0).epsilon(rounding));
    CHECK(spectral_norm(Matrix<2>{{0.0, 5.0}, {-1.0, 0.0}}) == Approx(5.0).epsilon(rounding));
}

TEST_CASE("the least rotation between two directions leaves what is across both, opposite ones included",
          "[base][decompositions]") {
    const Vector<3> x = Vector<3>::UnitX(), y = Vector<3>::UnitY(), z = Vector<3>::UnitZ();
    const Matrix<3> quarter = rotation_between(x, y);
    CHECK((quarter * x - y).norm() <= rounding);
    CHECK((quarter * z - z).norm() <= rounding);
    const Matrix<3> half = rotation_between(x, -x);
    CHECK((half * x + x).norm() <= rounding);
    CHECK(half.determinant() == Approx(1.0).epsilon(rounding));
}
