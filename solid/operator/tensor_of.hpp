#pragma once
// Private to the sources of this layer.
#include <array>

#include "abut/solid/operator/host_device.hpp"

namespace abut::solid {

/// A tensor by columns, which are vectors of type V (Lanes, Components): T v = sum_j col[j] v_j.
template <class V>
struct TensorOf {
    static constexpr int dim = V::dim;
    using Scalar = typename V::Scalar;
    V col[dim];

    [[nodiscard]] ABUT_HOST_DEVICE V operator*(V v) const {
        V product = v[0] * col[0];
        for (int j = 1; j < dim; ++j) product += v[j] * col[j];
        return product;
    }
    [[nodiscard]] ABUT_HOST_DEVICE V times(const std::array<Scalar, dim>& v) const {
        V product = v[0] * col[0];
        for (int j = 1; j < dim; ++j) product += v[j] * col[j];
        return product;
    }
    /// T += a (x) b
    ABUT_HOST_DEVICE void add_outer(V a, const std::array<Scalar, dim>& b) {
        for (int j = 0; j < dim; ++j) col[j] += b[j] * a;
    }
    [[nodiscard]] ABUT_HOST_DEVICE TensorOf transposed() const { return transpose(*this); }
};

/// Vector i of a packed array.
template <class V>
[[nodiscard]] ABUT_HOST_DEVICE inline V load(const typename V::Scalar* packed, std::ptrdiff_t i) {
    return V::load(packed + V::width * i);
}

template <class V>
ABUT_HOST_DEVICE inline void store(const V& a, typename V::Scalar* packed, std::ptrdiff_t i) {
    a.store(packed + V::width * i);
}

/// Tensor i of a packed array, by columns: shape (n, dim, dim).
template <class V>
[[nodiscard]] ABUT_HOST_DEVICE inline TensorOf<V> load_tensor(const typename V::Scalar* packed, std::ptrdiff_t i) {
    TensorOf<V> t;
    for (int j = 0; j < V::dim; ++j) t.col[j] = load<V>(packed, V::dim * i + j);
    return t;
}

template <class V>
ABUT_HOST_DEVICE inline void store_tensor(const TensorOf<V>& t, typename V::Scalar* packed, std::ptrdiff_t i) {
    for (int j = 0; j < V::dim; ++j) store(t.col[j], packed, V::dim * i + j);
}

}  // namespace abut::solid
