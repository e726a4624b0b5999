#pragma once
// Private to the sources of this layer.
#include <type_traits>

#include "abut/geometry/vector.hpp"

// Passing 32-byte vectors by value has no fixed ABI without AVX; everything here is inlined within one source file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace abut::dynamics {

using Register2 = double __attribute__((vector_size(16)));
using Register4 = double __attribute__((vector_size(32)));

/// A vector of Dim components in one SIMD register; in 3D the fourth lane is kept at zero.
template <int Dim>
struct Lanes {
    using Register = std::conditional_t<Dim == 2, Register2, Register4>;
    Register r{};

    [[nodiscard]] double operator[](int i) const { return r[i]; }
    friend Lanes operator+(Lanes a, Lanes b) { return {a.r + b.r}; }
    friend Lanes operator-(Lanes a, Lanes b) { return {a.r - b.r}; }
    friend Lanes operator-(Lanes a) { return {-a.r}; }
    friend Lanes operator*(double s, Lanes a) { return {s * a.r}; }
    Lanes& operator+=(Lanes a) { r += a.r; return *this; }
    Lanes& operator-=(Lanes a) { r -= a.r; return *this; }
};

template <int Dim>
[[nodiscard]] inline Lanes<Dim> load(const Vector<Dim>& v) {
    if constexpr (Dim == 2) return {Register2{v[0], v[1]}};
    else return {Register4{v[0], v[1], v[2], 0.0}};
}

template <int Dim>
[[nodiscard]] inline Vector<Dim> unload(Lanes<Dim> a) {
    Vector<Dim> v;
    for (int i = 0; i < Dim; ++i) v[i] = a[i];
    return v;
}

template <int Dim>
[[nodiscard]] inline double dot(Lanes<Dim> a, Lanes<Dim> b) {
    const auto p = a.r * b.r;
    if constexpr (Dim == 2) return p[0] + p[1];
    else return p[0] + p[1] + p[2];
}

/// A tensor by columns: T v = sum_j col[j] v_j.
template <int Dim>
struct LaneTensor {
    Lanes<Dim> col[Dim];

    [[nodiscard]] Lanes<Dim> operator*(Lanes<Dim> v) const {
        Lanes<Dim> product = v[0] * col[0];
        for (int j = 1; j < Dim; ++j) product += v[j] * col[j];
        return product;
    }
    /// T += a (x) b
    void add_outer(Lanes<Dim> a, Lanes<Dim> b) {
        for (int j = 0; j < Dim; ++j) col[j] += b[j] * a;
    }
};

template <int Dim>
[[nodiscard]] inline LaneTensor<Dim> load(const Matrix<Dim>& m) {
    LaneTensor<Dim> t;
    for (int j = 0; j < Dim; ++j) t.col[j] = load<Dim>(Vector<Dim>(m.col(j)));
    return t;
}

}  // namespace abut::dynamics
