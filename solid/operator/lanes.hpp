#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "abut/base/large_array.hpp"
#include "abut/base/vector.hpp"
#include "abut/solid/operator/tensor_of.hpp"

// Passing 32-byte vectors by value has no fixed ABI without AVX; everything here is inlined within one source file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace abut::solid {

using Register2 = double __attribute__((vector_size(16)));
using Register4 = double __attribute__((vector_size(32)));
using SingleRegister2 = float __attribute__((vector_size(8)));
using SingleRegister4 = float __attribute__((vector_size(16)));

/// Numbers that an element of an array of registers takes.
template <int Dim>
inline constexpr std::ptrdiff_t lane_width = Dim == 2 ? 2 : 4;

/// A vector of Dim components in one SIMD register; in 3D the fourth lane is kept at zero.
template <int Dim, class Real = double>
struct Lanes {
    static constexpr int dim = Dim;
    static constexpr std::ptrdiff_t width = lane_width<Dim>;
    using Scalar = Real;
    using Double = Lanes<Dim>;
    using Register = std::conditional_t<std::is_same_v<Real, double>, std::conditional_t<Dim == 2, Register2, Register4>,
                                        std::conditional_t<Dim == 2, SingleRegister2, SingleRegister4>>;
    Register r{};

    [[nodiscard]] Real operator[](int i) const { return r[i]; }
    friend Lanes operator+(Lanes a, Lanes b) { return {a.r + b.r}; }
    friend Lanes operator-(Lanes a, Lanes b) { return {a.r - b.r}; }
    friend Lanes operator-(Lanes a) { return {-a.r}; }
    friend Lanes operator*(Real s, Lanes a) { return {s * a.r}; }
    Lanes& operator+=(Lanes a) {
        r += a.r;
        return *this;
    }
    Lanes& operator-=(Lanes a) {
        r -= a.r;
        return *this;
    }

    [[nodiscard]] static Lanes load(const Real* packed) {
        Lanes a;
        std::memcpy(&a.r, packed, sizeof a.r);
        return a;
    }
    void store(Real* packed) const { std::memcpy(packed, &r, sizeof r); }
};

template <int Dim>
[[nodiscard]] inline Lanes<Dim> load_packed(const Vector<Dim>& v) {
    if constexpr (Dim == 2)
        return {Register2{v[0], v[1]}};
    else
        return {Register4{v[0], v[1], v[2], 0.0}};
}

template <class To, int Dim, class From>
[[nodiscard]] inline Lanes<Dim, To> converted(Lanes<Dim, From> a) {
    if constexpr (std::is_same_v<To, From>)
        return a;
    else
        return {__builtin_convertvector(a.r, typename Lanes<Dim, To>::Register)};
}

template <int Dim, class Real>
[[nodiscard]] inline Lanes<Dim> in_double(Lanes<Dim, Real> a) {
    return converted<double>(a);
}

template <int Dim, class Real>
[[nodiscard]] inline Lanes<Dim, Real> load_packed(const LargeArray<Real>& packed, std::ptrdiff_t i) {
    return load<Lanes<Dim, Real>>(packed.data(), i);
}

template <int Dim, class Real>
inline void store(Lanes<Dim, Real> a, LargeArray<Real>& packed, std::ptrdiff_t i) {
    store(a, packed.data(), i);
}

template <int Dim, class Real>
[[nodiscard]] inline Vector<Dim> unload(Lanes<Dim, Real> a) {
    Vector<Dim> v;
    for (int i = 0; i < Dim; ++i) v[i] = a[i];
    return v;
}

template <int Dim, class Real>
[[nodiscard]] inline Real dot(Lanes<Dim, Real> a, Lanes<Dim, Real> b) {
    const auto p = a.r * b.r;
    if constexpr (Dim == 2)
        return p[0] + p[1];
    else
        return p[0] + p[1] + p[2];
}

template <int Dim, class Real = double>
using LaneTensor = TensorOf<Lanes<Dim, Real>>;

template <int Dim, class Real>
[[nodiscard]] inline LaneTensor<Dim, Real> transpose(const LaneTensor<Dim, Real>& t) {
    using Column = Lanes<Dim, Real>;
    if constexpr (Dim == 2) {
        return {Column{__builtin_shufflevector(t.col[0].r, t.col[1].r, 0, 2)},
                Column{__builtin_shufflevector(t.col[0].r, t.col[1].r, 1, 3)}};
    } else {
        const auto low = __builtin_shufflevector(t.col[0].r, t.col[1].r, 0, 4, 2, 6);
        const auto high = __builtin_shufflevector(t.col[0].r, t.col[1].r, 1, 5, 3, 7);
        const auto third = t.col[2].r;  // (x, y, z, 0)
        return {Column{__builtin_shufflevector(low, third, 0, 1, 4, 7)},
                Column{__builtin_shufflevector(high, third, 0, 1, 5, 7)},
                Column{__builtin_shufflevector(low, third, 2, 3, 6, 7)}};
    }
}

template <int Dim, class Real>
[[nodiscard]] inline LaneTensor<Dim, Real> load_tensor(const LargeArray<Real>& packed, std::ptrdiff_t i) {
    return load_tensor<Lanes<Dim, Real>>(packed.data(), i);
}

template <int Dim, class Real>
inline void store_tensor(const LaneTensor<Dim, Real>& t, LargeArray<Real>& packed, std::ptrdiff_t i) {
    store_tensor(t, packed.data(), i);
}

template <int Dim>
[[nodiscard]] inline LaneTensor<Dim> load_packed(const Matrix<Dim>& m) {
    LaneTensor<Dim> t;
    for (int j = 0; j < Dim; ++j) t.col[j] = load_packed<Dim>(Vector<Dim>(m.col(j)));
    return t;
}

template <int Dim, class Real>
[[nodiscard]] inline Matrix<Dim> unload(const LaneTensor<Dim, Real>& t) {
    Matrix<Dim> m;
    for (int j = 0; j < Dim; ++j) m.col(j) = unload(t.col[j]);
    return m;
}

}  // namespace abut::solid
