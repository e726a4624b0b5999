#include "abut/geometry/convex_distance.hpp"

#include <algorithm>

#include "abut/geometry/convex_bodies.hpp"

namespace abut::geometry {

template <int Dim>
double convex_distance(std::span<const Vector<Dim>> body_1, std::span<const Vector<Dim>> body_2) {
    const auto [bodies, unit] = unit_bodies<Dim>(body_1, body_2, "convex_distance");
    return std::max(best_of_gjk(bodies, Dim == 2).separation, 0.0) * unit;
}

template double convex_distance<2>(std::span<const Vector<2>>, std::span<const Vector<2>>);
template double convex_distance<3>(std::span<const Vector<3>>, std::span<const Vector<3>>);

}  // namespace abut::geometry
