#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "abut/base/large_array.hpp"
#include "abut/base/vector.hpp"

// Passing 32-byte vectors by value has no fixed ABI without AVX; everything here is inlined within one source file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace abut::solid {

using Register2 = double __attribute__((vector_size(16)));
using Register4 = double __attribute__((vector_size(32)));
using SingleRegister2 = float __attribute__((vector_size(8)));
using SingleRegister4 = float __attribute__((vector_size(16)));

/// A vector of Dim components in one SIMD register; in 3D the fourth lane is kept at zero.
template <int Dim, class Real = double>
struct Lanes {
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

/// Numbers that an element of an array of registers takes.
template <int Dim>
inline constexpr std::size_t lane_width = Dim == 2 ? 2 : 4;

template <int Dim, class Real>
[[nodiscard]] inline Lanes<Dim, Real> load_packed(const LargeArray<Real>& packed, std::ptrdiff_t i) {
    Lanes<Dim, Real> a;
    std::memcpy(&a.r, packed.data() + lane_width<Dim> * i, sizeof a.r);
    return a;
}

template <int Dim, class Real>
inline void store(Lanes<Dim, Real> a, LargeArray<Real>& packed, std::ptrdiff_t i) {
    std::memcpy(packed.data() + lane_width<Dim> * i, &a.r, sizeof a.r);
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

/// A tensor by columns: T v = sum_j col[j] v_j.
template <int Dim, class Real = double>
struct LaneTensor {
    using Column = Lanes<Dim, Real>;
    Column col[Dim];

    [[nodiscard]] Column operator*(Column v) const {
        Column product = v[0] * col[0];
        for (int j = 1; j < Dim; ++j) product += v[j] * col[j];
        return product;
    }
    [[nodiscard]] Column times(const std::array<Real, Dim>& v) const {
        Column product = v[0] * col[0];
        for (int j = 1; j < Dim; ++j) product += v[j] * col[j];
        return product;
    }
    /// T += a (x) b
    void add_outer(Column a, const std::array<Real, Dim>& b) {
        for (int j = 0; j < Dim; ++j) col[j] += b[j] * a;
    }
    [[nodiscard]] LaneTensor transposed() const {
        if constexpr (Dim == 2) {
            return {Column{__builtin_shufflevector(col[0].r, col[1].r, 0, 2)},
                    Column{__builtin_shufflevector(col[0].r, col[1].r, 1, 3)}};
        } else {
            const auto low = __builtin_shufflevector(col[0].r, col[1].r, 0, 4, 2, 6);
            const auto high = __builtin_shufflevector(col[0].r, col[1].r, 1, 5, 3, 7);
            const auto third = col[2].r;  // (x, y, z, 0)
            return {Column{__builtin_shufflevector(low, third, 0, 1, 4, 7)},
                    Column{__builtin_shufflevector(high, third, 0, 1, 5, 7)},
                    Column{__builtin_shufflevector(low, third, 2, 3, 6, 7)}};
        }
    }
};

/// Element i of a packed array of tensors, by columns: shape (n, Dim, Dim).
template <int Dim, class Real>
[[nodiscard]] inline LaneTensor<Dim, Real> load_tensor(const LargeArray<Real>& packed, std::ptrdiff_t i) {
    LaneTensor<Dim, Real> t;
    for (int j = 0; j < Dim; ++j) t.col[j] = load_packed<Dim>(packed, Dim * i + j);
    return t;
}

template <int Dim, class Real>
inline void store_tensor(const LaneTensor<Dim, Real>& t, LargeArray<Real>& packed, std::ptrdiff_t i) {
    for (int j = 0; j < Dim; ++j) store(t.col[j], packed, Dim * i + j);
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
