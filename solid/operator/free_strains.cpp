#include "abut/solid/operator/free_strains.hpp"

#include <algorithm>
#include <numbers>

#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"

namespace abut::solid {
namespace {

constexpr double no_strain = 1e-5;   // of the largest: what rounding makes of a rotation
constexpr double edge_cosine = 0.5;  // of the angle between two faces of a sharp edge: it is less than 60 degrees

/// A symmetric tensor as a vector with the same norm.
template <int Dim>
Eigen::VectorXd mandel(const Matrix<Dim>& tensor) {
    Eigen::VectorXd packed(Dim * (Dim + 1) / 2);
    Eigen::Index next = 0;
    for (int i = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j)
            packed[next++] = i == j ? tensor(i, i) : (tensor(i, j) + tensor(j, i)) / std::numbers::sqrt2;
    return packed;
}

}  // namespace

template <int Dim>
bool is_tip(std::span<const FreeFaceOfCell<Dim>> faces) {
    const auto are_opposite = [](const FreeFaceOfCell<Dim>& a, const FreeFaceOfCell<Dim>& b) {
        return a.free_part.isIdentity(0.0) && b.free_part.isIdentity(0.0) && a.normal.dot(b.normal) < -edge_cosine;
    };
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (are_opposite(faces[i], faces[j])) return true;
    return false;
}

template <int Dim>
BalancingCombinations balancing_combinations(std::span<const FreeFaceOfCell<Dim>> faces) {
    if (faces.size() == 1 && faces.front().free_part.isIdentity(0.0)) return {Eigen::MatrixXd::Identity(Dim, Dim)};
    Eigen::MatrixXd strains(Dim * (Dim + 1) / 2, std::ssize(faces) * Dim);
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int j = 0; j < Dim; ++j)
            strains.col(static_cast<Eigen::Index>(i) * Dim + j) =
                mandel<Dim>(faces[i].free_part.col(j) * faces[i].normal.transpose());
    const auto [squares, combinations] = symmetric_eigen(Eigen::MatrixXd(strains.transpose() * strains));
    const double largest = squares[squares.size() - 1];
    const auto n_above = [&](double strain) {
        return std::ranges::count_if(squares, [&](double square) { return square > strain * strain * largest; });
    };
    const auto n_kept = n_above(is_tip<Dim>(faces) ? no_strain : least_strain);
    return {combinations.rightCols(n_kept), n_kept < n_above(no_strain)};
}

template bool is_tip<2>(std::span<const FreeFaceOfCell<2>>);
template bool is_tip<3>(std::span<const FreeFaceOfCell<3>>);
template BalancingCombinations balancing_combinations<2>(std::span<const FreeFaceOfCell<2>> faces);
template BalancingCombinations balancing_combinations<3>(std::span<const FreeFaceOfCell<3>> faces);

}  // namespace abut::solid
