#pragma once
// Private to the sources of this layer.
#include <cstddef>

#include "abut/solid/operator/host_device.hpp"
#include "abut/solid/operator/tensor_of.hpp"

namespace abut::solid {

/// A vector of Dim components for devices, whose compilers know no registers: in memory as Lanes, and the same arithmetic by
/// components.
template <int Dim>
struct Components {
    static constexpr int dim = Dim;
    static constexpr std::ptrdiff_t width = Dim == 2 ? 2 : 4;
    using Scalar = double;
    using Double = Components;
    double r[Dim]{};

    [[nodiscard]] ABUT_HOST_DEVICE double operator[](int i) const { return r[i]; }
    friend ABUT_HOST_DEVICE Components operator+(Components a, const Components& b) { return a += b; }
    friend ABUT_HOST_DEVICE Components operator-(Components a, const Components& b) { return a -= b; }
    friend ABUT_HOST_DEVICE Components operator*(double s, Components a) {
        for (double& component : a.r) component = s * component;
        return a;
    }
    ABUT_HOST_DEVICE Components& operator+=(const Components& a) {
        for (int i = 0; i < Dim; ++i) r[i] += a.r[i];
        return *this;
    }
    ABUT_HOST_DEVICE Components& operator-=(const Components& a) {
        for (int i = 0; i < Dim; ++i) r[i] -= a.r[i];
        return *this;
    }

    [[nodiscard]] static ABUT_HOST_DEVICE Components load(const double* packed) {
        const Element& element = *reinterpret_cast<const Element*>(packed);
        Components a;
        for (int i = 0; i < Dim; ++i) a.r[i] = element.r[i];
        return a;
    }
    ABUT_HOST_DEVICE void store(double* packed) const {
        Element element{};
        for (int i = 0; i < Dim; ++i) element.r[i] = r[i];
        *reinterpret_cast<Element*>(packed) = element;
    }

private:
    /// In memory: read and written in pieces of 16 bytes.
    struct alignas(16) Element {
        double r[width];
    };
};

template <int Dim>
[[nodiscard]] ABUT_HOST_DEVICE inline const Components<Dim>& in_double(const Components<Dim>& a) {
    return a;
}

template <int Dim>
[[nodiscard]] ABUT_HOST_DEVICE inline TensorOf<Components<Dim>> transpose(const TensorOf<Components<Dim>>& t) {
    TensorOf<Components<Dim>> transposed;
    for (int j = 0; j < Dim; ++j)
        for (int i = 0; i < Dim; ++i) transposed.col[j].r[i] = t.col[i].r[j];
    return transposed;
}

}  // namespace abut::solid
