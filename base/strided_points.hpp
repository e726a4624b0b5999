#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/vector.hpp"

namespace abut {

/// Points, or one vector per point, in an array of a host's own, where they lie: component d of point i is
/// data[i * item + d * component]. Fortran's u(dim, n), C's u[n][dim] and one array per component are all of this kind.
template <int Dim, class Double>
class StridedPoints {
public:
    StridedPoints() = default;
    /// Strides count doubles, and may be negative.
    StridedPoints(Double* data, std::int32_t size, std::ptrdiff_t item, std::ptrdiff_t component)
        : data_(data), size_(size), item_(item), component_(component) {}
    /// Packed (n, Dim). Throws BadInput for a size that is no multiple of Dim.
    StridedPoints(std::span<Double> values)  // implicit: a view
        : StridedPoints(values.data(), static_cast<std::int32_t>(values.size() / Dim), Dim, 1) {
        if (values.size() % Dim != 0)
            throw BadInput(std::to_string(values.size()) + " numbers are no points of " + std::to_string(Dim) +
                           " components; give " + std::to_string(Dim) + " for each point.");
    }
    template <class V>
    StridedPoints(std::span<V> points) requires(std::is_same_v<std::remove_const_t<V>, Vector<Dim>>)  // implicit: a view
        : StridedPoints(reinterpret_cast<Double*>(points.data()), static_cast<std::int32_t>(points.size()), Dim, 1) {}
    StridedPoints(const std::vector<Vector<Dim>>& points) requires(std::is_const_v<Double>)  // implicit: a view
        : StridedPoints(std::span(points)) {}
    StridedPoints(std::vector<Vector<Dim>>& points)  // implicit: a view
        : StridedPoints(std::span(points)) {}

    [[nodiscard]] std::int32_t size() const { return size_; }
    [[nodiscard]] Vector<Dim> operator[](std::ptrdiff_t i) const {
        const Double* const first = data_ + i * item_;
        if constexpr (Dim == 1)
            return Vector<Dim>::Constant(*first);
        else if constexpr (Dim == 2)
            return {first[0], first[component_]};
        else
            return {first[0], first[component_], first[2 * component_]};
    }
    void add(std::ptrdiff_t i, const Vector<Dim>& value) const requires(!std::is_const_v<Double>) {
        for (int d = 0; d < Dim; ++d) data_[i * item_ + d * component_] += value[d];
    }

private:
    Double* data_ = nullptr;
    std::int32_t size_ = 0;
    std::ptrdiff_t item_ = Dim;
    std::ptrdiff_t component_ = 1;
};

/// To be read.
template <int Dim>
using PointsView = StridedPoints<Dim, const double>;

/// To be added to.
template <int Dim>
using PointsSpan = StridedPoints<Dim, double>;

}  // namespace abut
