#include "abut/contact/pairs/pair_list.hpp"

#include <algorithm>

#include "abut/base/sort_unique.hpp"
#include "abut/contact/pairs/pair.hpp"

namespace abut::contact {
namespace {

/// theta_1. Whatever the weighting, a rigid face 2 makes it 1 and a rigid face 1 makes it 0: the limits of `stiffness`.
template <int Dim>
double share_of_first(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2,
                      InterfaceWeighting weighting) {
    if (surface.is_rigid(face_2)) return 1.0;
    if (surface.is_rigid(face_1)) return 0.0;
    if (weighting == InterfaceWeighting::half) return 0.5;
    const double k_1 = surface.stiffness[face_1];
    const double k_2 = surface.stiffness[face_2];
    return k_2 / (k_1 + k_2);
}

template <int Dim>
double largest_norm(geometry::ProjectedFace<Dim> corners) {
    double radius = 0.0;
    for (const PlaneVector<Dim>& corner : corners) radius = std::max(radius, corner.norm());
    return radius;
}

/// Corners about the centroid of the face.
template <int Dim>
void append_projected(const SurfaceView<Dim>& surface, std::int32_t face, const geometry::PlaneFrame<Dim>& frame,
                      std::vector<PlaneVector<Dim>>& corners) {
    const auto first = static_cast<std::ptrdiff_t>(corners.size());
    corners.resize(corners.size() + surface.vertices_of(face).size());
    project_face<Dim>(surface, face, surface.centroid[face], Vector<Dim>::Zero(), frame, corners.begin() + first);
}

}  // namespace

template <int Dim>
void PairList<Dim>::append(const SurfaceView<Dim>& surface, std::int32_t first, std::int32_t second,
                           InterfaceWeighting weighting, std::int32_t friction) {
    const double theta_1 = share_of_first(surface, first, second, weighting);
    ContactPair<Dim> pair{.face_1 = first,
                          .face_2 = second,
                          .frame = geometry::PlaneFrame<Dim>(pair_normal(surface, first, second)),
                          .theta_1 = theta_1,
                          .theta_2 = 1.0 - theta_1,
                          .interaction_radius = 0.0,
                          .admission_depth = surface.cell_depth[first] + surface.cell_depth[second]};
    pair.friction = friction;
    pair.corners_1 = static_cast<std::int32_t>(corners_.size());
    append_projected(surface, first, pair.frame, corners_);
    pair.corners_2 = static_cast<std::int32_t>(corners_.size());
    append_projected(surface, second, pair.frame, corners_);
    pair.corners_end = static_cast<std::int32_t>(corners_.size());
    pair.interaction_radius = (1.0 + 1e-12) * (largest_norm<Dim>(face_1(pair)) + largest_norm<Dim>(face_2(pair)));
    pairs_.push_back(pair);
}

template <int Dim>
void PairList<Dim>::clear() {
    pairs_.clear();
    corners_.clear();
}

template <int Dim>
void PairList<Dim>::list_faces(std::vector<Face>& faces) {
    faces.clear();
    for (const ContactPair<Dim>& pair : pairs_) {
        faces.push_back(Face{pair.face_1});
        faces.push_back(Face{pair.face_2});
    }
    sort_unique(faces);
    number_faces(faces);
}

template <int Dim>
void PairList<Dim>::number_faces(std::span<const Face> faces) {
    if (faces.empty()) return;
    listed_.resize(static_cast<std::size_t>(faces.back()) + 1);
    for (std::size_t i = 0; i < faces.size(); ++i)
        listed_[static_cast<std::size_t>(faces[i])] = static_cast<std::int32_t>(i);
    for (ContactPair<Dim>& pair : pairs_) {
        pair.listed_1 = listed_[static_cast<std::size_t>(pair.face_1)];
        pair.listed_2 = listed_[static_cast<std::size_t>(pair.face_2)];
    }
}

template <int Dim>
PairPosition<Dim> PairList<Dim>::position(const SurfaceView<Dim>& surface, const ContactPair<Dim>& pair,
                                          const Vector<Dim>& u_1, const Vector<Dim>& u_2) const {
    const Vector<Dim> from_1_to_2 = apart(surface, pair.face_1, pair.face_2, u_1, u_2);
    return {from_1_to_2.dot(pair.frame.normal()), pair.frame.project(from_1_to_2)};
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
geometry::OverlapArea<Dim> PairList<Dim>::overlap(const ContactPair<Dim>& pair, const PlaneVector<Dim>& tangential_offset,
                                                  geometry::AreaMethod method) const {
    return geometry::overlap_area<Dim>(face_1(pair), face_2(pair), tangential_offset, method);
}

template <int Dim>
void PairList<Dim>::append_overlap_events(const ContactPair<Dim>& pair, const PlaneVector<Dim>& s_0,
                                          const PlaneVector<Dim>& s_1, std::vector<double>& events) const {
    geometry::append_overlap_events<Dim>(face_1(pair), face_2(pair), s_0, s_1, events);
}

template class PairList<2>;
template class PairList<3>;

}  // namespace abut::contact
