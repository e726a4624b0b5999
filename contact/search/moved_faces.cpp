#include "abut/contact/search/moved_faces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/contact/surface/face_name.hpp"

namespace abut::contact {
namespace {

/// Whether pairs reach farther because their faces lie against their planes at an angle.
bool reads_tilt(const CandidateOptions& options, GapOf gap) {
    return gap == GapOf::centroids && !by_distance_alone(options);
}

}  // namespace

template <int Dim>
MovedFaces<Dim>::MovedFaces(const SurfaceView<Dim>& surface, const CandidateOptions& options, PointsView<Dim> x_0,
                            PointsView<Dim> x_1, GapOf gap)
    : surface_(surface),
      options_(options),
      x_0_(x_0),
      x_1_(x_1),
      skin_tilt_(reads_tilt(options, gap) ? FaceTilt<Dim>(surface, options).largest_sine() : 0.0) {
    const auto n = static_cast<std::int32_t>(surface.vertices.size());
    for (const std::int32_t size : {x_0.size(), x_1.size()})
        if (size != n)
            throw BadInput("contact: " + std::to_string(size) + " positions are given for " + std::to_string(n) +
                               " vertices of the surface; give one each.",
                           {.value = static_cast<double>(size), .allowed = static_cast<double>(n)});
}

template <int Dim>
double MovedFaces<Dim>::motion_of_vertex(std::int32_t v) const {
    const Vector<Dim> from = x_0_[v];
    return from.allFinite() ? (x_1_[v] - from).norm() : std::numeric_limits<double>::quiet_NaN();
}

template <int Dim>
double MovedFaces<Dim>::motion(std::int32_t face) const {
    double motion = 0.0;
    for (const std::int32_t v : surface_.vertices_of(face)) motion = larger(motion, motion_of_vertex(v));
    return motion;
}

/// Name of the vertex that moves farthest, or of the first one that is not finite.
template <int Dim>
std::string MovedFaces<Dim>::name_of_vertex(std::int32_t face) const {
    std::int32_t farthest = surface_.vertices_of(face).front();
    for (const std::int32_t v : surface_.vertices_of(face)) {
        if (!(motion_of_vertex(farthest) >= motion_of_vertex(v))) farthest = v;
        if (!std::isfinite(motion_of_vertex(farthest))) break;
    }
    return "vertex " + std::to_string(farthest) + " of " + face_name(surface_, face);
}

template <int Dim>
std::string MovedFaces<Dim>::name_of_position(std::int32_t face) const {
    return "the position of " + name_of_vertex(face);
}

template <int Dim>
std::string MovedFaces<Dim>::name_of_mover(std::int32_t face) const {
    return name_of_vertex(face);
}

template <int Dim>
Vector<Dim> MovedFaces<Dim>::middle(std::int32_t face) const {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const std::int32_t v : surface_.vertices_of(face)) sum += x_0_[v];
    return sum / static_cast<double>(surface_.vertices_of(face).size());
}

/// A bound on the distance of a point of the face from its centroid. That of a polygon is no linear function of its corners:
/// there it is the longest distance of two of them.
template <int Dim>
double MovedFaces<Dim>::radius(std::int32_t face, const PointsView<Dim>& x) const {
    const auto corners = surface_.vertices_of(face);
    double squared = 0.0;
    if (corners.size() <= 3) {
        Vector<Dim> centroid = Vector<Dim>::Zero();
        for (const std::int32_t v : corners) centroid += x[v];
        centroid /= static_cast<double>(corners.size());
        for (const std::int32_t v : corners) squared = std::max(squared, (x[v] - centroid).squaredNorm());
    } else {
        for (const std::int32_t v : corners)
            for (const std::int32_t w : corners) squared = std::max(squared, (x[v] - x[w]).squaredNorm());
    }
    return std::sqrt(squared);
}

template <int Dim>
geometry::Box<Dim> MovedFaces<Dim>::box(std::ptrdiff_t i, double skin) const {
    const std::int32_t face = order_->faces[static_cast<std::size_t>(i)];
    geometry::Box<Dim> box;
    for (const std::int32_t v : surface_.vertices_of(face)) {
        const Vector<Dim> from = x_0_[v], to = x_1_[v];
        box.extend(geometry::Box<Dim>{from.cwiseMin(to), from.cwiseMax(to)});
    }
    double growth = 0.5 * (options_.distance + skin);
    if (!by_distance_alone(options_) && !surface_.is_rigid(face)) growth += 2.0 * surface_.cell_depth[face];
    if (skin_tilt_ > 0.0) {  // which face gives the normal depends on areas, and they change
        const double sine = surface_.is_rigid(face) ? 0.0 : skin_tilt_;
        growth += sine * std::max(radius(face, x_0_), radius(face, x_1_)) + skin_tilt_ * skin;
    }
    return box.grown(growth);
}

template class MovedFaces<2>;
template class MovedFaces<3>;

}  // namespace abut::contact
