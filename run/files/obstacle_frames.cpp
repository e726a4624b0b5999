#include "abut/run/files/obstacle_frames.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numeric>

#include "abut/base/index.hpp"
#include "abut/contact/surface/obstacle_side.hpp"
#include "abut/geometry/points.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/run/body_names.hpp"

namespace abut::run {
namespace {

constexpr double far_larger = 20.0;    // than the bodies: the diagonal of a face, over that of the box around them
constexpr double extents_shown = 2.0;  // of such a face in each direction, over the same

/// The part of a convex face, or segment, where `direction` . x <= `most`.
template <int Dim>
std::vector<Vector<Dim>> clipped(const std::vector<Vector<Dim>>& corners, const Vector<Dim>& direction, double most) {
    std::vector<Vector<Dim>> kept;
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vector<Dim>&a = corners[i], &b = corners[(i + 1) % n];
        const double beyond_a = direction.dot(a) - most, beyond_b = direction.dot(b) - most;
        if (beyond_a <= 0.0) kept.push_back(a);
        const bool is_edge = Dim == 3 || i + 1 < n;
        if (is_edge && (beyond_a <= 0.0) != (beyond_b <= 0.0))
            kept.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
    }
    return kept;
}

/// The part of a face around the foot of `middle` that reaches `half_width` in all directions of the axes.
template <int Dim>
std::vector<Vector<Dim>> part_near(std::vector<Vector<Dim>> corners, const Vector<Dim>& middle, double half_width) {
    for (int axis = 0; axis < Dim; ++axis)
        for (const double sign : {1.0, -1.0}) {
            const Vector<Dim> direction = sign * Vector<Dim>::Unit(axis);
            corners = clipped<Dim>(corners, direction, direction.dot(middle) + half_width);
        }
    return corners;
}

/// Distance of a point from the plane of a face.
template <int Dim>
double height_over(const std::vector<Vector<Dim>>& corners, const Vector<Dim>& x) {
    return std::abs(geometry::face_normal<Dim>(corners).dot(x - corners.front()));
}

template <int Dim>
std::vector<std::vector<Vector<Dim>>> shown_faces(const std::vector<std::vector<Vector<Dim>>>& faces,
                                                  const geometry::Box<Dim>& bodies) {
    const double extent = (bodies.upper - bodies.lower).norm();
    const Vector<Dim> middle = 0.5 * (bodies.lower + bodies.upper);
    std::vector<std::vector<Vector<Dim>>> result;
    for (const auto& face : faces) {
        const geometry::Box<Dim> box = geometry::box_of<Dim>(face);
        if ((box.upper - box.lower).norm() <= far_larger * extent) {
            result.push_back(face);
        } else {
            auto part = part_near<Dim>(face, middle, extents_shown * extent + height_over<Dim>(face, middle));
            if (part.size() >= Dim) result.push_back(std::move(part));
        }
    }
    return result;
}

}  // namespace

template <int Dim>
ObstacleFrames<Dim>::ObstacleFrames(const std::filesystem::path& directory, const std::string& series,
                                    const Scene<Dim>& scene)
    : series_(directory, series), obstacles_(scene.solid.obstacles) {
    const geometry::Box<Dim> bodies = geometry::box_of<Dim>(scene.mesh.vertices);
    for (std::size_t i = 0; i < obstacles_.size(); ++i) {
        obstacles_[i].faces = shown_faces<Dim>(obstacles_[i].faces, bodies);
        names_.push_back({fmt::format("obstacle: {}", name_of_obstacle(scene, i)), static_cast<std::int32_t>(i)});
        for (const auto& face : obstacles_[i].faces) {
            std::vector<std::int32_t> corners(face.size());
            std::iota(corners.begin(), corners.end(), static_cast<std::int32_t>(number_.size()));
            faces_.append(corners);
            number_.resize(number_.size() + face.size(), static_cast<double>(i));
        }
    }
}

template <int Dim>
void ObstacleFrames<Dim>::write(double time) {
    std::vector<Vector<Dim>> position;
    for (const auto& obstacle : obstacles_) {
        const contact::Placement<Dim> placed = contact::placement_at(obstacle, time);
        for (const auto& face : obstacle.faces)
            for (const Vector<Dim>& corner : face) position.push_back(placed(corner));
    }
    series_.write(
        {.time = time, .position = position, .fields = {{"obstacle", number_}}, .faces = faces_, .numbers = names_});
}

template class ObstacleFrames<2>;
template class ObstacleFrames<3>;

}  // namespace abut::run
