#include "abut/contact/search/face_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/contact/pairs/pair.hpp"

namespace abut::contact {
namespace {

/// Largest sine of the angle between a face and the plane of a pair it takes part in. Where the pair normal is the mean, the
/// angle is half of that between n_1 and -n_2; where it is that of the other face, the whole.
double largest_tilt_sine(double facing_cosine, bool along_other_normal) {
    const double angle = std::acos(-facing_cosine), tilt = along_other_normal ? angle : 0.5 * angle;
    return tilt < 0.5 * std::numbers::pi ? std::sin(tilt) : 1.0;
}

template <int Dim>
bool any_rigid(const SurfaceView<Dim>& surface) {
    for (std::int32_t face = 0; face < surface.size(); ++face)
        if (surface.is_rigid(face)) return true;
    return false;
}

template <int Dim>
double largest_elastic_face(const SurfaceView<Dim>& surface) {
    double area = 0.0;
    for (std::int32_t face = 0; face < surface.size(); ++face)
        if (!surface.is_rigid(face)) area = std::max(area, surface.area[face]);
    return area;
}

}  // namespace

template <int Dim>
FaceTilt<Dim>::FaceTilt(const SurfaceView<Dim>& surface, const CandidateOptions& options)
    : elsewhere_(largest_tilt_sine(options.facing_cosine, any_rigid(surface))),
      of_whole_angle_(largest_tilt_sine(options.facing_cosine, true)),
      much_larger_exist_below_((1.0 + 1e-12) * largest_elastic_face(surface) / much_larger_area<Dim>) {}

template <int Dim>
RestFaceMaker<Dim>::RestFaceMaker(const SurfaceView<Dim>& surface, const CandidateOptions& options)
    : surface_(surface), by_distance_alone_(by_distance_alone(options)), tilt_(surface, options) {}

template <int Dim>
RestFace<Dim> RestFaceMaker<Dim>::operator()(std::int32_t face) const {
    RestFace<Dim> rest{.corners = {}, .interaction_radius = 0.0, .radius = circumradius(surface_, face), .face = face};
    for (const std::int32_t v : surface_.vertices_of(face)) rest.corners.extend(surface_.vertices[v]);
    if (!by_distance_alone_ && !surface_.is_rigid(face))
        rest.interaction_radius = 2.0 * surface_.cell_depth[face] + rest.radius * tilt_.sine(surface_, face);
    return rest;
}

template <int Dim>
double mean_face_size(const SurfaceView<Dim>& surface) {
    double size = 0.0;
    std::int32_t n = 0;
    for (std::int32_t face = 0; face < surface.size(); ++face) {
        if (surface.is_rigid(face)) continue;
        size += Dim == 2 ? surface.area[face] : std::sqrt(surface.area[face]);
        ++n;
    }
    return n > 0 ? size / n : 0.0;
}

template class FaceTilt<2>;
template class FaceTilt<3>;
template class RestFaceMaker<2>;
template class RestFaceMaker<3>;
template double mean_face_size<2>(const SurfaceView<2>&);
template double mean_face_size<3>(const SurfaceView<3>&);

}  // namespace abut::contact
