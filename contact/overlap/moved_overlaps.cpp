// The part of overlaps.hpp for faces whose vertices have moved.
#include <array>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/contact/overlap/overlap_checks.hpp"
#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::contact {
namespace {

using geometry::IndexPair;

/// The faces that pairs name, with their corners where they are now: a surface of its own, and the pairs in its numbers.
template <int Dim>
class NamedFaces {
public:
    NamedFaces(const SurfaceView<Dim>& at_rest, PointsView<Dim> x, std::span<const IndexPair> pairs)
        : at_rest_(at_rest), x_(x) {
        number_faces(pairs);
        lay_out_corners();
        copy_values();
        find_measures();
        refuse_first_bad_one();
    }

    [[nodiscard]] SurfaceView<Dim> view() const { return surface_.view(); }
    [[nodiscard]] std::span<const IndexPair> pairs() const { return pairs_; }
    /// The corners have moved themselves.
    [[nodiscard]] std::vector<Vector<Dim>> no_displacement() const {
        return std::vector<Vector<Dim>>(at_rest_of_.size(), Vector<Dim>::Zero());
    }
    [[nodiscard]] std::int32_t at_rest(std::int32_t face) const { return at_rest_of_[static_cast<std::size_t>(face)]; }

private:
    /// In the order of the host, so that those which lie together there do so here.
    void number_faces(std::span<const IndexPair> pairs) {
        constexpr std::int32_t unnamed = -1;
        std::vector<std::int32_t> number(static_cast<std::size_t>(at_rest_.size()), unnamed);
        for (const IndexPair pair : pairs) number[pair.first] = number[pair.second] = 0;
        for (std::size_t face = 0; face < number.size(); ++face) {
            if (number[face] == unnamed) continue;
            number[face] = static_cast<std::int32_t>(at_rest_of_.size());
            at_rest_of_.push_back(static_cast<std::int32_t>(face));
        }
        pairs_.reserve(pairs.size());
        for (const IndexPair pair : pairs) pairs_.push_back({number[pair.first], number[pair.second]});
    }

    void lay_out_corners() {
        std::int32_t n = 0;
        surface_.face_offsets.reserve(at_rest_of_.size() + 1);
        for (const std::int32_t face : at_rest_of_)
            surface_.face_offsets.push_back(n += static_cast<std::int32_t>(at_rest_.vertices_of(face).size()));
        surface_.vertices.resize(static_cast<std::size_t>(n));
        surface_.face_vertices.resize(static_cast<std::size_t>(n));
        parallel_each(n, [&](std::ptrdiff_t i) { surface_.face_vertices[i] = static_cast<std::int32_t>(i); });
    }

    /// Depth and body play no part in an overlap.
    void copy_values() {
        const std::size_t n = at_rest_of_.size();
        surface_.cell_depth.resize(n);
        surface_.body.resize(n);
        surface_.stiffness.resize(n);
        if (!at_rest_.steps_to_sharp_edge.empty()) surface_.steps_to_sharp_edge.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            surface_.stiffness[i] = at_rest_.stiffness[at_rest_of_[i]];
            if (!at_rest_.steps_to_sharp_edge.empty())
                surface_.steps_to_sharp_edge[i] = at_rest_.steps_to_sharp_edge[at_rest_of_[i]];
        }
    }

    void find_measures() {
        const std::size_t n = at_rest_of_.size();
        surface_.centroid.resize(n);
        surface_.normal.resize(n);
        surface_.area.resize(n);
        is_bad_.resize(n);
        parallel_each(static_cast<std::ptrdiff_t>(n),
                      [&](std::ptrdiff_t i) { find_measures_of(static_cast<std::int32_t>(i)); });
    }

    void find_measures_of(std::int32_t i) {
        const auto corners = std::span(surface_.vertices).subspan(surface_.face_offsets[i], n_corners(i));
        for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = x_[at_rest_.vertices_of(at_rest(i))[k]];
        surface_.centroid[i] = geometry::face_centroid<Dim>(corners);
        surface_.normal[i] = outward_normal(i, corners);
        surface_.area[i] = geometry::face_measure<Dim>(corners);
        is_bad_[i] = !std::isfinite(surface_.area[i]) || (corners.size() > 3 && !is_convex(i));
    }

    /// In 2D corners come in any order: which side is outside follows from the face at rest.
    [[nodiscard]] Vector<Dim> outward_normal(std::int32_t i, geometry::FaceVertices<Dim> corners) const {
        const Vector<Dim> normal = geometry::face_normal<Dim>(corners);
        if constexpr (Dim == 2) {
            const auto ends = at_rest_.vertices_of(at_rest(i));
            const std::array<Vector<2>, 2> rest{at_rest_.vertices[ends[0]], at_rest_.vertices[ends[1]]};
            if (geometry::face_normal<2>(rest).dot(at_rest_.normal[at_rest(i)]) < 0.0) return -normal;
        }
        return normal;
    }

    [[nodiscard]] std::size_t n_corners(std::int32_t i) const {
        return static_cast<std::size_t>(surface_.face_offsets[i + 1] - surface_.face_offsets[i]);
    }
    [[nodiscard]] geometry::FaceVertices<Dim> corners(std::int32_t i) const {
        return std::span(surface_.vertices).subspan(surface_.face_offsets[i], n_corners(i));
    }
    [[nodiscard]] bool is_convex(std::int32_t i) const {
        const double area = surface_.area[i];
        const double allowed = geometry::face_tolerance<Dim>(surface_.centroid[i], area) * std::sqrt(area);
        return area == 0.0 || geometry::is_convex<Dim>(corners(i), allowed);
    }

    void refuse_first_bad_one() const {
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(is_bad_.size()); ++i)
            if (is_bad_[i]) refuse(i);
    }

    [[noreturn]] void refuse(std::int32_t i) const {
        const std::string face = face_name(at_rest_, at_rest(i));
        for (std::size_t k = 0; k < n_corners(i); ++k)
            if (!corners(i)[k].allFinite())
                throw Diverged("overlaps: the position of vertex " + std::to_string(at_rest_.vertices_of(at_rest(i))[k]) +
                                   " of " + face + " is not finite: the run has diverged. Take a smaller time step.",
                               {.face_1 = at_rest(i)});
        if (!std::isfinite(surface_.area[i]))
            throw Diverged(
                "overlaps: " + face + " has grown beyond all numbers: the run has diverged. Take a smaller time step.",
                {.face_1 = at_rest(i)});
        throw Diverged("overlaps: " + face +
                           " is not convex where its vertices are now. Cut it into triangles, or take a "
                           "smaller time step.",
                       {.face_1 = at_rest(i)});
    }

    const SurfaceView<Dim>& at_rest_;
    PointsView<Dim> x_;
    Surface<Dim> surface_;
    std::vector<std::int32_t> at_rest_of_;  // the host's number of each face
    std::vector<IndexPair> pairs_;
    std::vector<char> is_bad_;
};

template <int Dim>
void check_input(const SurfaceView<Dim>& surface, PointsView<Dim> x, std::span<const IndexPair> pairs) {
    check_sizes(surface);
    if (static_cast<std::size_t>(x.size()) != surface.vertices.size())
        throw BadInput("overlaps: " + std::to_string(x.size()) + " positions are given for " +
                           std::to_string(surface.vertices.size()) + " vertices of the surface; give one each.",
                       {.value = static_cast<double>(x.size()), .allowed = static_cast<double>(surface.vertices.size())});
    check_indices(surface, pairs);
}

}  // namespace

template <int Dim>
void find_overlaps_moved(const SurfaceView<Dim>& surface, PointsView<Dim> x, std::span<const IndexPair> pairs,
                         geometry::AreaMethod method, Overlaps<Dim>& overlaps) {
    check_input(surface, x, pairs);
    const NamedFaces<Dim> named(surface, x, pairs);
    find_overlaps<Dim>(named.view(), named.no_displacement(), named.pairs(), method, overlaps);
    for (Overlap<Dim>& overlap : overlaps.found) {
        overlap.face_1 = named.at_rest(overlap.face_1);
        overlap.face_2 = named.at_rest(overlap.face_2);
    }
}

template <int Dim>
Overlaps<Dim> find_overlaps_moved(const SurfaceView<Dim>& surface, PointsView<Dim> x, std::span<const IndexPair> pairs,
                                  geometry::AreaMethod method) {
    Overlaps<Dim> overlaps;
    find_overlaps_moved(surface, x, pairs, method, overlaps);
    return overlaps;
}

template <int Dim>
std::vector<std::vector<Vector<Dim>>> overlap_polygons_moved(const SurfaceView<Dim>& surface, PointsView<Dim> x,
                                                             std::span<const IndexPair> pairs) {
    check_input(surface, x, pairs);
    const NamedFaces<Dim> named(surface, x, pairs);
    return overlap_polygons<Dim>(named.view(), named.no_displacement(), named.pairs());
}

#define ABUT_INSTANTIATE(Dim)                                                                                             \
    template void find_overlaps_moved<Dim>(const SurfaceView<Dim>&, PointsView<Dim>, std::span<const IndexPair>,          \
                                           geometry::AreaMethod, Overlaps<Dim>&);                                         \
    template Overlaps<Dim> find_overlaps_moved<Dim>(const SurfaceView<Dim>&, PointsView<Dim>, std::span<const IndexPair>, \
                                                    geometry::AreaMethod);                                                \
    template std::vector<std::vector<Vector<Dim>>> overlap_polygons_moved<Dim>(const SurfaceView<Dim>&, PointsView<Dim>,  \
                                                                               std::span<const IndexPair>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
