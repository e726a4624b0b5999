#pragma once
#include <span>
#include <type_traits>

#include "abut/base/small_matrix.hpp"

// Containers of the standard library cross the border, and those of the debug mode are laid out in another way.
#if defined(_GLIBCXX_DEBUG) && !defined(ABUT_HAS_DEBUG_CONTAINERS)
#error "Abut was built without _GLIBCXX_DEBUG: build both with it, or the host with _GLIBCXX_ASSERTIONS."
#elif defined(ABUT_HAS_DEBUG_CONTAINERS) && !defined(_GLIBCXX_DEBUG)
#error "Abut was built with _GLIBCXX_DEBUG: build the host with it as well."
#endif

namespace abut {

/// Point or direction in Dim dimensions. Plain packed doubles without an alignment demand, so that a view of vectors
/// can be laid over any host array of shape (n, Dim).
template <int Dim>
using Vector = SmallMatrix<Dim, 1>;

/// Moments, angular momenta, rotations: none on a line, one component in the plane, three in space.
template <int Dim>
using AxialVector = SmallMatrix<Dim*(Dim - 1) / 2, 1>;

/// arm × force, or any two vectors.
template <int Dim>
[[nodiscard]] AxialVector<Dim> moment(const Vector<Dim>& arm, const Vector<Dim>& force) {
    if constexpr (Dim == 1)
        return {};
    else if constexpr (Dim == 2)
        return AxialVector<2>(arm[0] * force[1] - arm[1] * force[0]);
    else
        return {arm[1] * force[2] - arm[2] * force[1], arm[2] * force[0] - arm[0] * force[2],
                arm[0] * force[1] - arm[1] * force[0]};
}

/// Second-order tensor, (Dim, Dim).
template <int Dim>
using Matrix = SmallMatrix<Dim, Dim>;

/// A point of the plane (3D) or line (2D) onto which two facing faces are projected.
template <int Dim>
using PlaneVector = SmallMatrix<Dim - 1, 1>;

/// A vector or a matrix in space, with zeros for what the plane lacks.
template <int Dim>
[[nodiscard]] Vector<3> in_3d(const Vector<Dim>& vector) {
    Vector<3> result = Vector<3>::Zero();
    for (int i = 0; i < Dim; ++i) result[i] = vector[i];
    return result;
}
template <int Dim>
[[nodiscard]] Matrix<3> in_3d(const Matrix<Dim>& matrix) requires(Dim > 1) {
    Matrix<3> result = Matrix<3>::Zero();
    for (int j = 0; j < Dim; ++j) result.col(j) = in_3d<Dim>(matrix.col(j));
    return result;
}

/// Whether a <= b in each component, and a < b.
template <int Dim>
[[nodiscard]] bool all_at_most(const Vector<Dim>& a, const Vector<Dim>& b) {
    for (int i = 0; i < Dim; ++i)
        if (!(a[i] <= b[i])) return false;
    return true;
}
template <int Dim>
[[nodiscard]] bool all_less(const Vector<Dim>& a, const Vector<Dim>& b) {
    for (int i = 0; i < Dim; ++i)
        if (!(a[i] < b[i])) return false;
    return true;
}

/// Arrays of shape (n, Dim) and arrays of n vectors are the same memory.
template <int Dim, class Double>
[[nodiscard]] auto as_vectors(std::span<Double> values) {
    using V = std::conditional_t<std::is_const_v<Double>, const Vector<Dim>, Vector<Dim>>;
    return std::span<V>(reinterpret_cast<V*>(values.data()), values.size() / Dim);
}

/// The other way round.
template <int Dim>
[[nodiscard]] std::span<double> as_values(std::span<Vector<Dim>> vectors) {
    return std::span<double>(reinterpret_cast<double*>(vectors.data()), vectors.size() * Dim);
}

}  // namespace abut
