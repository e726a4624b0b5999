#include "abut/contact/pairs.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

/// theta_1. The limit of the stiffness weights for a rigid face 2 is 1, for a rigid face 1 it is 0, whatever the weights.
template <int Dim>
double share_of_first(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2, Weights weights) {
    if (surface.is_rigid(face_2)) return 1.0;
    if (surface.is_rigid(face_1)) return 0.0;
    if (weights == Weights::half) return 0.5;
    const double k_1 = surface.stiffness[face_1];
    const double k_2 = surface.stiffness[face_2];
    return k_2 / (k_1 + k_2);
}

template <int PlaneDim>
double largest_norm(std::span<const Eigen::Matrix<double, PlaneDim, 1, Eigen::DontAlign>> corners) {
    double radius = 0.0;
    for (const auto& corner : corners) radius = std::max(radius, corner.norm());
    return radius;
}

/// Corners about the centroid of the face, counter-clockwise in the plane of the pair (3D), increasing (2D).
template <int Dim>
void append_projected(const SurfaceView<Dim>& surface, std::int32_t face, const geometry::PlaneFrame<Dim>& frame,
                      std::vector<PlaneVector<Dim>>& corners) {
    const auto first = static_cast<std::ptrdiff_t>(corners.size());
    for (const std::int32_t v : surface.vertices_of(face))
        corners.push_back(frame.project(surface.vertices[v] - surface.centroid[face]));
    if constexpr (Dim == 2) {
        std::sort(corners.begin() + first, corners.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
    } else {
        if (surface.normal[face].dot(frame.normal()) < 0.0) std::reverse(corners.begin() + first, corners.end());
    }
}

}  // namespace

template <int Dim>
void PairList<Dim>::append(const SurfaceView<Dim>& surface, std::int32_t first, std::int32_t second, Weights weights) {
    const double theta_1 = share_of_first(surface, first, second, weights);
    ContactPair<Dim> pair{.face_1 = first,
                          .face_2 = second,
                          .frame = geometry::PlaneFrame<Dim>(pair_normal(surface, first, second)),
                          .theta_1 = theta_1,
                          .theta_2 = 1.0 - theta_1,
                          .reach = 0.0,
                          .depth = surface.depth[first] + surface.depth[second]};
    pair.corners_1 = static_cast<std::int32_t>(corners_.size());
    append_projected(surface, first, pair.frame, corners_);
    pair.corners_2 = static_cast<std::int32_t>(corners_.size());
    append_projected(surface, second, pair.frame, corners_);
    pair.corners_end = static_cast<std::int32_t>(corners_.size());
    pair.reach = (1.0 + 1e-12) * (largest_norm<Dim - 1>(face_1(pair)) + largest_norm<Dim - 1>(face_2(pair)));
    pairs_.push_back(pair);
}

template <int Dim>
void PairList<Dim>::clear() {
    pairs_.clear();
    corners_.clear();
}

template <int Dim>
PairPosition<Dim> PairList<Dim>::position(const SurfaceView<Dim>& surface, const ContactPair<Dim>& pair,
                                          const Vector<Dim>& u_1, const Vector<Dim>& u_2) const {
    const Vector<Dim> apart = (surface.centroid[pair.face_2] - surface.centroid[pair.face_1]) + (u_2 - u_1);
    return {apart.dot(pair.frame.normal()), pair.frame.project(apart)};
}

template <int Dim>
geometry::ProjectedFace<Dim> PairList<Dim>::face_1(const ContactPair<Dim>& pair) const {
    return {corners_.data() + pair.corners_1, static_cast<std::size_t>(pair.corners_2 - pair.corners_1)};
}

template <int Dim>
geometry::ProjectedFace<Dim> PairList<Dim>::face_2(const ContactPair<Dim>& pair) const {
    return {corners_.data() + pair.corners_2, static_cast<std::size_t>(pair.corners_end - pair.corners_2)};
}

template <int Dim>
geometry::SharedArea<Dim> PairList<Dim>::shared_area(const ContactPair<Dim>& pair, const PlaneVector<Dim>& shift,
                                                     geometry::AreaMethod method) const {
    return geometry::shared_area<Dim>(face_1(pair), face_2(pair), shift, method);
}

template <int Dim>
void PairList<Dim>::append_overlap_events(const ContactPair<Dim>& pair, const PlaneVector<Dim>& shift_0,
                                          const PlaneVector<Dim>& shift_1, std::vector<double>& events) const {
    geometry::append_overlap_events<Dim>(face_1(pair), face_2(pair), shift_0, shift_1, events);
}

template <int Dim>
Vector<Dim> pair_normal(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2) {
    const Vector<Dim>& n_1 = surface.normal[face_1];
    const Vector<Dim>& n_2 = surface.normal[face_2];
    if (surface.is_rigid(face_2)) return -n_2;
    if (surface.is_rigid(face_1)) return n_1;
    return (n_1 - n_2).normalized();
}

template <int Dim>
double circumradius(const SurfaceView<Dim>& surface, std::int32_t face) {
    double radius = 0.0;
    for (const std::int32_t v : surface.vertices_of(face))
        radius = std::max(radius, (surface.vertices[v] - surface.centroid[face]).norm());
    return radius;
}

template <int Dim>
bool are_facing(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2, double facing_cosine) {
    return surface.normal[face_1].dot(surface.normal[face_2]) < facing_cosine;
}

template class PairList<2>;
template class PairList<3>;
template Vector<2> pair_normal<2>(const SurfaceView<2>&, std::int32_t, std::int32_t);
template Vector<3> pair_normal<3>(const SurfaceView<3>&, std::int32_t, std::int32_t);
template double circumradius<2>(const SurfaceView<2>&, std::int32_t);
template double circumradius<3>(const SurfaceView<3>&, std::int32_t);
template bool are_facing<2>(const SurfaceView<2>&, std::int32_t, std::int32_t, double);
template bool are_facing<3>(const SurfaceView<3>&, std::int32_t, std::int32_t, double);

}  // namespace abut::contact
