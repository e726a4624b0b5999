#include "abut/geometry/nearest/winding_number.hpp"

#include <cmath>
#include <numbers>

namespace abut::geometry {
namespace {

/// Solid angle of a triangle whose corners lie at a, b and c from the point [sr]; above 0 on its inner side (van
/// Oosterom and Strackee 1983).
double solid_angle(const Vector<3>& a, const Vector<3>& b, const Vector<3>& c) {
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double around = la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la;
    return 2.0 * std::atan2(a.dot(b.cross(c)), around);
}

}  // namespace

double winding_number(const FaceSoup& surface, const Vector<3>& point) {
    double sum = 0.0;
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        const auto corners = surface.vertices_of(face);
        const auto at = [&](std::size_t i) -> Vector<3> {
            return surface.vertices[static_cast<std::size_t>(corners[i])] - point;
        };
        for (std::size_t i = 2; i < corners.size(); ++i) sum += solid_angle(at(0), at(i - 1), at(i));
    }
    return sum / (4.0 * std::numbers::pi);
}

bool is_inside(const FaceSoup& surface, const Vector<3>& point) {
    constexpr double rounding = 1e-6;
    return std::abs(winding_number(surface, point) - 1.0) < rounding;
}

}  // namespace abut::geometry
