#include "abut/geometry/space_filling_order.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>  // LGPL
#include <CGAL/property_map.h>

#include <numeric>
#include <stdexcept>
#include <string>

namespace abut::geometry {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

Kernel::Point_2 cgal_point(const Vector<2>& point) { return {point.x(), point.y()}; }
Kernel::Point_3 cgal_point(const Vector<3>& point) { return {point.x(), point.y(), point.z()}; }

template <int Dim>
void check(std::span<const Vector<Dim>> points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!points[i].allFinite()) throw std::invalid_argument("point " + std::to_string(i) + " has a coordinate that is not finite");
}

template <int Dim>
auto sorting_traits(const std::vector<decltype(cgal_point(Vector<Dim>()))>& points) {
    const auto point_of = CGAL::make_property_map(points.data());
    if constexpr (Dim == 2)
        return CGAL::Spatial_sort_traits_adapter_2<Kernel, decltype(point_of)>(point_of);
    else
        return CGAL::Spatial_sort_traits_adapter_3<Kernel, decltype(point_of)>(point_of);
}

}  // namespace

template <int Dim>
std::vector<std::int32_t> space_filling_order(std::span<const Vector<Dim>> points) {
    check(points);
    std::vector<decltype(cgal_point(Vector<Dim>()))> copies;
    copies.reserve(points.size());
    for (const Vector<Dim>& point : points) copies.push_back(cgal_point(point));
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Sequential and by medians: no random numbers, no threads, and coinciding points cannot recurse for ever.
    CGAL::hilbert_sort(order.begin(), order.end(), sorting_traits<Dim>(copies), CGAL::Hilbert_sort_median_policy());
    return {order.begin(), order.end()};
}

template std::vector<std::int32_t> space_filling_order<2>(std::span<const Vector<2>>);
template std::vector<std::int32_t> space_filling_order<3>(std::span<const Vector<3>>);

}  // namespace abut::geometry
