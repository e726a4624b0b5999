#include "abut/contact/overlap/face_distance.hpp"

#include <string>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/contact/overlap/overlap_checks.hpp"
#include "abut/geometry/convex_distance.hpp"

namespace abut::contact {
namespace {

template <int Dim>
std::vector<Vector<Dim>> corners_of(const SurfaceView<Dim>& surface, PointsView<Dim> x, std::int32_t face) {
    std::vector<Vector<Dim>> corners;
    for (const std::int32_t v : surface.vertices_of(face)) corners.push_back(x[v]);
    return corners;
}

}  // namespace

template <int Dim>
std::vector<double> face_distances(const SurfaceView<Dim>& surface, PointsView<Dim> x,
                                   std::span<const Overlap<Dim>> overlaps) {
    check_sizes(surface);
    if (static_cast<std::size_t>(x.size()) != surface.vertices.size())
        throw BadInput("face distances: " + std::to_string(x.size()) + " positions are given for " +
                           std::to_string(surface.vertices.size()) + " vertices of the surface; give one each.",
                       {.value = static_cast<double>(x.size()), .allowed = static_cast<double>(surface.vertices.size())});
    std::vector<geometry::IndexPair> pairs;
    for (const Overlap<Dim>& overlap : overlaps) pairs.push_back({overlap.face_1, overlap.face_2});
    check_indices<Dim>(surface, pairs);
    std::vector<double> distances(overlaps.size());
    parallel_each(static_cast<std::ptrdiff_t>(pairs.size()), [&](std::ptrdiff_t i) {
        const auto& [face_1, face_2] = pairs[static_cast<std::size_t>(i)];
        distances[static_cast<std::size_t>(i)] =
            geometry::convex_distance<Dim>(corners_of(surface, x, face_1), corners_of(surface, x, face_2));
    });
    return distances;
}

#define ABUT_INSTANTIATE(Dim)                                                                  \
    template std::vector<double> face_distances<Dim>(const SurfaceView<Dim>&, PointsView<Dim>, \
                                                     std::span<const Overlap<Dim>>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
