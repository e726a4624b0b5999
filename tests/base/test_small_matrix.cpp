// Our vectors and matrices against those of Eigen, which know nothing of each other.
#include <Eigen/Dense>
#include <catch2/catch.hpp>
#include <limits>
#include <random>
#include <type_traits>

#include "abut/base/eigen.hpp"
#include "abut/base/rotation.hpp"

using namespace abut;

namespace {

constexpr double of_rounding = 1e-14;

static_assert(std::is_trivially_copyable_v<Vector<3>> && std::is_trivially_copyable_v<Matrix<3>>);
static_assert(std::is_trivially_default_constructible_v<Vector<3>> && std::is_trivially_default_constructible_v<Matrix<3>>);
static_assert(std::is_trivially_copyable_v<AxialVector<1>>);
static_assert(sizeof(Vector<2>) == 16 && sizeof(Vector<3>) == 24 && sizeof(Matrix<3>) == 72 &&
              sizeof(SmallMatrix<2, 3>) == 48);
static_assert(Vector<3>(1.0, 2.0, 3.0).dot({4.0, 5.0, 6.0}) == 32.0);
static_assert(!std::is_assignable_v<SmallMatrix<1, 3>, SmallMatrix<1, 3>>);  // m.row(0) = r would change a copy

template <int Rows, int Cols>
SmallMatrix<Rows, Cols> any(std::mt19937& random) {
    SmallMatrix<Rows, Cols> matrix;
    for (double& value : matrix) value = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    return matrix;
}

template <int Rows, int Cols, class Expected>
double difference(const SmallMatrix<Rows, Cols>& found, const Expected& expected) {
    return (found - SmallMatrix<Rows, Cols>(expected)).norm();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("sums, products and norms of matrices and vectors are those of Eigen", "[base][small_matrix]",
                       ((int N), N), 1, 2, 3, 4, 6) {
    std::mt19937 random(5);
    for (int i = 0; i < 100; ++i) {
        const auto a = any<N, N>(random), b = any<N, N>(random);
        const auto wide = any<N, 3>(random);
        const auto v = any<N, 1>(random), w = any<N, 1>(random);
        const auto e_a = as_eigen(a), e_b = as_eigen(b);
        const auto e_v = as_eigen(v), e_w = as_eigen(w);
        CHECK(difference(a + 2.0 * b - a / 3.0, e_a + 2.0 * e_b - e_a / 3.0) <= of_rounding);
        CHECK(difference(a * b, e_a * e_b) <= of_rounding);
        CHECK(difference(a * v, e_a * e_v) <= of_rounding);
        CHECK(difference(a * wide, e_a * as_eigen(wide)) <= of_rounding);
        CHECK(difference(a.transpose() * v, e_a.transpose() * e_v) <= of_rounding);
        CHECK(difference(v * w.transpose(), e_v * e_w.transpose()) <= of_rounding);
        CHECK(difference(a * v.asDiagonal(), e_a * e_v.asDiagonal()) <= of_rounding);
        CHECK(difference(v.asDiagonal() * a, e_v.asDiagonal() * e_a) <= of_rounding);
        CHECK(difference(v.normalized(), e_v.normalized()) <= of_rounding);
        CHECK(difference(v.cwiseProduct(w).cwiseMax(0.1), e_v.cwiseProduct(e_w).cwiseMax(0.1)) <= of_rounding);
        CHECK(std::abs(v.dot(w) - e_v.dot(e_w)) <= of_rounding);
        CHECK(std::abs(a.norm() - e_a.norm()) <= of_rounding);
        CHECK(std::abs(a.trace() - e_a.trace()) <= of_rounding);
        CHECK(std::abs(a.sum() - e_a.sum()) <= of_rounding);
        CHECK(std::abs((1e-200 * v).stableNorm() - 1e-200 * v.norm()) <= 1e-200 * of_rounding);
        CHECK(a.maxCoeff() == e_a.maxCoeff());
        CHECK(a.cwiseAbs().minCoeff() == e_a.cwiseAbs().minCoeff());
    }
}

TEMPLATE_TEST_CASE_SIG("determinants and inverses are those of Eigen, and an inverse undoes its matrix",
                       "[base][small_matrix]", ((int N), N), 1, 2, 3) {
    std::mt19937 random(6);
    for (int i = 0; i < 100; ++i) {
        const Matrix<N> a = any<N, N>(random) + 3.0 * Matrix<N>::Identity();
        CHECK(a.determinant() == Approx(as_eigen(a).determinant()).epsilon(of_rounding));
        CHECK(difference(a.inverse(), as_eigen(a).inverse()) <= of_rounding);
        CHECK((a * a.inverse() - Matrix<N>::Identity()).norm() <= 10.0 * of_rounding);
    }
}

TEST_CASE("parts of a matrix are where they were put", "[base][small_matrix]") {
    SmallMatrix<2, 3> m{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
    CHECK(m(1, 0) == 4.0);
    CHECK(m.col(2) == Vector<2>(3.0, 6.0));
    CHECK(m.row(1).transpose() == Vector<3>(4.0, 5.0, 6.0));
    CHECK(m.leftCols<2>() == Matrix<2>{{1.0, 2.0}, {4.0, 5.0}});
    CHECK(m.data()[2] == 2.0);
    m.col(0) = {7.0, 8.0};
    m.col(1) *= 2.0;
    CHECK(m == SmallMatrix<2, 3>::from_columns(Vector<2>(7.0, 8.0), Vector<2>(4.0, 10.0), Vector<2>(3.0, 6.0)));
    m = Matrix<2>{{0.0, 1.0}, {1.0, 0.0}} * m;
    CHECK(m == SmallMatrix<2, 3>{{8.0, 10.0, 6.0}, {7.0, 4.0, 3.0}});
    CHECK(in_3d<2>(Matrix<2>::Identity()) == Matrix<3>{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}});
}

TEST_CASE("numbers that are not finite are found, and are not zero", "[base][small_matrix]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double value : {nan, infinity, -infinity}) {
        CHECK_FALSE(Vector<3>(0.0, value, 1.0).allFinite());
        CHECK_FALSE(Vector<3>(0.0, value, 0.0).isZero());
        CHECK_FALSE(Vector<3>(0.0, value, 1.0).stableNorm() <= std::numeric_limits<double>::max());
    }
    CHECK(Vector<2>(1.0, nan) != Vector<2>(1.0, nan));
    CHECK(Vector<3>::Zero().normalized() == Vector<3>::Zero());
}

TEST_CASE("rotations are those of Eigen, and their vectors give them back", "[base][small_matrix]") {
    std::mt19937 random(7);
    for (int i = 0; i < 100; ++i) {
        const Vector<3> axis = any<3, 1>(random).normalized();
        const double angle = std::uniform_real_distribution<double>(0.0, 3.0)(random);
        const Matrix<3> turn = rotation_about(axis, angle);
        CHECK(difference(turn, Eigen::AngleAxisd(angle, Eigen::Vector3d(as_eigen(axis))).toRotationMatrix()) <= of_rounding);
        CHECK((rotation_vector(turn) - angle * axis).norm() <= 1e-7);
        CHECK(difference(rotation_in_plane(angle), Eigen::Rotation2Dd(angle).toRotationMatrix()) <= of_rounding);
        CHECK(std::abs(axis.unitOrthogonal().dot(axis)) <= of_rounding);
    }
}
