#include "abut/geometry/health/surface_health.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "abut/base/disjoint_sets.hpp"
#include "abut/base/index.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/health/self_intersections.hpp"
#include "abut/geometry/merged_vertices.hpp"
#include "abut/geometry/overlap/overlap.hpp"
#include "abut/geometry/polygon.hpp"

namespace abut::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One face along one edge.
struct EdgeUse {
    std::int32_t first, second;  ///< merged vertices, first < second
    std::int32_t face;
    bool forward;  ///< the face runs from first to second

    [[nodiscard]] bool is_same_edge(const EdgeUse& other) const { return first == other.first && second == other.second; }
    friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
        if (a.first != b.first) return a.first < b.first;
        return a.second != b.second ? a.second < b.second : a.face < b.face;
    }
};

/// Fills a report part by part.
class SurfaceCheck {
public:
    SurfaceCheck(const FaceSoup& soup, const HealthOptions& options) : soup_(soup), options_(options) {
        check_offsets(soup);
        report_.n_faces = soup.size();
        report_.n_vertices = static_cast<std::int32_t>(soup.vertices.size());
    }

    SurfaceReport report() && {
        check_vertices();
        check_faces();
        measure_faces();
        find_flipped_duplicates();
        const std::vector<EdgeUse> uses = edge_uses();
        find_components(uses);
        check_edges(uses);
        count_holes();
        measure_components();
        if (options_.self_intersections) find_self_intersections();
        return std::move(report_);
    }

private:
    [[nodiscard]] bool is_usable(std::int32_t face) const { return report_.faults[at(face)] == FaceFault::none; }
    [[nodiscard]] std::vector<std::int32_t> loop_of(std::int32_t face) const {
        return distinct_corners(soup_, report_.merged_vertices, face);
    }
    void corners_of(const std::vector<std::int32_t>& loop, std::vector<Vector<3>>& corners) const {
        corners.clear();
        for (const std::int32_t v : loop) corners.push_back(soup_.vertices[at(v)]);
    }

    void check_vertices() {
        report_.merged_vertices = merged_vertices<3>(soup_.vertices);
        std::vector<char> is_named(soup_.vertices.size(), 0);
        for (const std::int32_t v : soup_.face_vertices)
            if (v >= 0 && v < report_.n_vertices) is_named[at(v)] = 1;
        for (std::int32_t v = 0; v < report_.n_vertices; ++v) {
            if (is_named[at(v)] == 0) report_.unreferenced_vertices.push_back(v);
            if (report_.merged_vertices[at(v)] != v) ++report_.n_unwelded_vertices;
            if (!soup_.vertices[at(v)].allFinite()) ++report_.n_bad_vertices;
        }
    }

    void check_faces() {
        report_.faults = face_faults(soup_, report_.merged_vertices);
        for (std::int32_t face = 0; face < report_.n_faces; ++face) {
            ++report_.n_faults[static_cast<std::size_t>(report_.faults[at(face)])];
            if (!is_usable(face)) report_.unusable_faces.push_back(face);
        }
    }

    void measure_faces() {
        std::vector<Vector<3>> corners;
        double shortest = infinity;
        for (std::int32_t face = 0; face < report_.n_faces; ++face) {
            if (!is_usable(face)) continue;
            const std::vector<std::int32_t> loop = loop_of(face);
            if (loop.size() < soup_.vertices_of(face).size()) report_.repeated_corner_faces.push_back(face);
            corners_of(loop, corners);
            measure_edges(corners, shortest);
            const double area = face_measure<3>(corners);
            report_.area += area;
            record_aspect(face, aspect_ratio(corners));
            if (corners.size() > 3) record_planarity(face, corners, area);
        }
        if (report_.n_usable() > 0) report_.shortest_edge = shortest;
    }
    void measure_edges(const std::vector<Vector<3>>& corners, double& shortest) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            report_.box.extend(corners[i]);
            const double length = (corners[(i + 1) % corners.size()] - corners[i]).stableNorm();
            report_.longest_edge = std::max(report_.longest_edge, length);
            shortest = std::min(shortest, length);
        }
    }
    void record_aspect(std::int32_t face, double aspect) {
        if (aspect > options_.sliver_aspect) report_.slivers.push_back(face);
        constexpr auto last = static_cast<double>(std::tuple_size_v<decltype(SurfaceReport::aspect_decades)> - 1);
        const double decade = aspect < infinity ? std::clamp(std::floor(std::log10(aspect)), 0.0, last) : last;
        ++report_.aspect_decades[static_cast<std::size_t>(decade)];
        if (aspect <= report_.worst_aspect) return;
        report_.worst_aspect = aspect;
        report_.worst_aspect_face = face;
    }
    void record_planarity(std::int32_t face, const std::vector<Vector<3>>& corners, double area) {
        const double deviation = planarity_deviation<3>(corners) / std::sqrt(area);
        if (deviation > std::max(options_.planarity_tolerance, shape_tolerance(corners)))
            report_.non_planar_faces.push_back(face);
        if (deviation <= report_.worst_planarity) return;
        report_.worst_planarity = deviation;
        report_.worst_planarity_face = face;
    }

    /// Sorted; every face has each of its edges once.
    [[nodiscard]] std::vector<EdgeUse> edge_uses() const {
        std::vector<EdgeUse> uses;
        uses.reserve(soup_.face_vertices.size());
        for (std::int32_t face = 0; face < report_.n_faces; ++face) {
            if (!is_usable(face)) continue;
            const std::vector<std::int32_t> loop = loop_of(face);
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const std::int32_t a = loop[i], b = loop[(i + 1) % loop.size()];
                uses.push_back({std::min(a, b), std::max(a, b), face, a < b});
            }
        }
        std::sort(uses.begin(), uses.end());
        return uses;
    }

    /// Calls visit(faces along the edge) for every edge in turn.
    template <class Visitor>
    static void for_each_edge(const std::vector<EdgeUse>& uses, Visitor&& visit) {
        for (auto begin = uses.begin(); begin != uses.end();) {
            const auto end = std::find_if(begin, uses.end(), [&](const EdgeUse& use) { return !use.is_same_edge(*begin); });
            visit(std::span<const EdgeUse>(begin, end));
            begin = end;
        }
    }

    void find_components(const std::vector<EdgeUse>& uses) {
        DisjointSets sets(at(report_.n_faces));
        for_each_edge(uses, [&](std::span<const EdgeUse> along) {
            for (const EdgeUse& use : along.subspan(1)) sets.join(along[0].face, use.face);
        });
        report_.face_component.assign(at(report_.n_faces), -1);
        for (std::int32_t face = 0; face < report_.n_faces; ++face) {
            if (!is_usable(face)) continue;
            const std::int32_t first = sets.find(face);
            if (first == face) {
                report_.face_component[at(face)] = static_cast<std::int32_t>(report_.components.size());
                report_.components.push_back({.first_face = face});
            }
            report_.face_component[at(face)] = report_.face_component[at(first)];
            ++report_.components[at(report_.face_component[at(face)])].n_faces;
        }
    }

    void check_edges(const std::vector<EdgeUse>& uses) {
        for_each_edge(uses, [&](std::span<const EdgeUse> along) {
            const auto n = static_cast<std::int32_t>(along.size());
            const auto n_forward = static_cast<std::int32_t>(
                std::count_if(along.begin(), along.end(), [](const EdgeUse& u) { return u.forward; }));
            const SurfaceEdge edge{along[0].first, along[0].second, along[0].face, n};
            SurfaceComponent& component = report_.components[at(report_.face_component[at(edge.face)])];
            ++report_.n_edges;
            if (n == 1) report_.boundary_edges.push_back(edge);
            if (n > 2) report_.non_manifold_edges.push_back(edge);
            if (n == 2 && n_forward != 1) report_.inconsistent_edges.push_back(edge);
            if (n % 2 != 0) component.closed = false;
            if (n > 1 && std::abs(2 * n_forward - n) > n % 2) component.oriented = false;
        });
    }

    void count_holes() {
        DisjointSets rims(at(report_.n_vertices));
        for (const SurfaceEdge& edge : report_.boundary_edges) rims.join(edge.first, edge.second);
        std::vector<std::int32_t> found;
        for (const SurfaceEdge& edge : report_.boundary_edges) found.push_back(rims.find(edge.first));
        sort_unique(found);
        report_.n_holes = static_cast<std::int32_t>(found.size());
    }

    /// A sixth of the sum of the determinants about a corner of the component, so that a distant origin costs no digits.
    void measure_components() {
        std::vector<Vector<3>> corners;
        for (std::int32_t face = 0; face < report_.n_faces; ++face) {
            if (!is_usable(face)) continue;
            SurfaceComponent& component = report_.components[at(report_.face_component[at(face)])];
            if (!component.closed || !component.oriented) continue;
            const Vector<3>& origin = soup_.vertices[at(soup_.vertices_of(component.first_face)[0])];
            corners_of(loop_of(face), corners);
            const Vector<3> apex = corners[0] - origin;
            for (std::size_t i = 1; i + 1 < corners.size(); ++i)
                component.volume += apex.dot((corners[i] - origin).cross(corners[i + 1] - origin)) / 6.0;
        }
        for (SurfaceComponent& component : report_.components) component.inside_out = component.volume < 0.0;
    }

    /// Compares with the first face of each set of corners, whichever way it runs: at most one other is no duplicate of it.
    void find_flipped_duplicates() {
        struct Key {
            std::array<std::int32_t, max_polygon_vertices> corners{};
            std::int32_t face = -1;
        };
        std::vector<Key> keys;
        keys.reserve(at(report_.n_usable()));
        for (std::int32_t face = 0; face < report_.n_faces; ++face) {
            if (!is_usable(face)) continue;
            std::vector<std::int32_t> loop = loop_of(face);
            std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
            if (loop[1] > loop.back()) std::reverse(loop.begin() + 1, loop.end());
            Key key;
            key.corners.fill(-1);
            std::copy(loop.begin(), loop.end(), key.corners.begin());
            key.face = face;
            keys.push_back(key);
        }
        std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
            return a.corners != b.corners ? a.corners < b.corners : a.face < b.face;
        });
        for (std::size_t i = 1; i < keys.size(); ++i)
            if (keys[i].corners == keys[i - 1].corners)
                report_.flipped_duplicates.push_back({keys[i].face, keys[i - 1].face});
        std::sort(report_.flipped_duplicates.begin(), report_.flipped_duplicates.end(),
                  [](const FlippedFace& a, const FlippedFace& b) { return a.face < b.face; });
    }

    void find_self_intersections() {
        report_.looked_for_self_intersections = true;
        report_.self_intersections = self_intersections(soup_, report_.merged_vertices, report_.faults);
        report_.n_self_intersections = static_cast<std::int64_t>(report_.self_intersections.size());
        const std::size_t most = at(std::max(options_.max_listed_pairs, 0));
        if (report_.self_intersections.size() > most) report_.self_intersections.resize(most);
    }

    const FaceSoup& soup_;
    const HealthOptions& options_;
    SurfaceReport report_;
};

}  // namespace

double aspect_ratio(std::span<const Vector<3>> corners) {
    const std::size_t n = corners.size();
    double longest = 0.0;
    for (std::size_t i = 0; i < n; ++i) longest = std::max(longest, (corners[(i + 1) % n] - corners[i]).stableNorm());
    if (!(longest > 0.0)) return infinity;
    double smallest_height = infinity;  // in units of the longest edge, so that nothing overflows or vanishes
    for (std::size_t i = 0; i < n; ++i) {
        const Vector<3> edge = (corners[(i + 1) % n] - corners[i]) / longest;
        const double length = edge.stableNorm();
        if (!(length > 0.0)) continue;
        double height = 0.0;
        for (const Vector<3>& corner : corners)
            height = std::max(height, edge.cross(Vector<3>((corner - corners[i]) / longest)).stableNorm() / length);
        smallest_height = std::min(smallest_height, height);
    }
    return smallest_height > 0.0 ? 1.0 / smallest_height : infinity;
}

bool SurfaceReport::closed() const {
    return !components.empty() &&
           std::all_of(components.begin(), components.end(), [](const SurfaceComponent& c) { return c.closed; });
}

bool SurfaceReport::sound() const {
    const auto is_sound = [](const SurfaceComponent& c) { return c.closed && c.oriented && !c.inside_out; };
    return unusable_faces.empty() && flipped_duplicates.empty() && non_planar_faces.empty() && non_manifold_edges.empty() &&
           n_self_intersections == 0 && !components.empty() && std::all_of(components.begin(), components.end(), is_sound);
}

SurfaceReport check_surface(const FaceSoup& soup, const HealthOptions& options) {
    return SurfaceCheck(soup, options).report();
}

}  // namespace abut::geometry
