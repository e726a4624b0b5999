// Two gears that turn in each other: a list that is kept from step to step holds every pair that is near.
#include <algorithm>
#include <catch2/catch.hpp>
#include <optional>

#include "abut/base/rotation.hpp"
#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "contact/turning.hpp"

using namespace abut;
using namespace abut::test;
using contact::GapOf;
using geometry::IndexPair;

namespace {

constexpr int n_teeth = 12;
constexpr double pitch = 2.0 * std::numbers::pi / n_teeth;
constexpr double root_radius = 0.85, tip_radius = 1.05, middle_distance = 1.92;
constexpr int parts_of_an_edge = 2;

/// The outline of a gear about the origin, counter-clockwise: trapezoidal teeth, one of them about the x axis. The tips are
/// narrower than the gaps between the roots, so that teeth of two gears pass through each other's gaps.
Points<2> outline() {
    std::vector<std::pair<double, double>> corners;  // angle, radius
    for (int tooth = 0; tooth < n_teeth; ++tooth)
        for (const auto& [share, radius] :
             {std::pair{-0.28, root_radius}, {-0.14, tip_radius}, {0.14, tip_radius}, {0.28, root_radius}})
            corners.emplace_back((tooth + share) * pitch, radius);
    Points<2> points;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto at = [](const std::pair<double, double>& p) {
            return Vector<2>(p.second * std::cos(p.first), p.second * std::sin(p.first));
        };
        const Vector<2> from = at(corners[i]), to = at(corners[(i + 1) % corners.size()]);
        for (int part = 0; part < parts_of_an_edge; ++part) points.push_back(from + part * (to - from) / parts_of_an_edge);
    }
    return points;
}

/// Segments (2D), or the side of a prism in triangles (3D).
template <int Dim>
void append_gear(contact::Surface<Dim>& surface, const Vector<2>& centre, double turned, double depth, std::int32_t body) {
    const Matrix<2> turn = rotation_in_plane(turned);
    const auto points = outline();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector<2> a = Vector<2>(turn * points[i]) + centre,
                        b = Vector<2>(turn * points[(i + 1) % points.size()]) + centre;
        if constexpr (Dim == 2) {
            surface.append(Points<2>{a, b}, depth, 1.0, body);
        } else {
            const double height = 0.1;
            const Vector<3> a_0(a[0], a[1], 0.0), b_0(b[0], b[1], 0.0), up = height * Vector<3>::UnitZ();
            surface.append(Points<3>{a_0, b_0, a_0 + up}, depth, 1.0, body);
            surface.append(Points<3>{b_0, b_0 + up, a_0 + up}, depth, 1.0, body);
        }
    }
}

/// The vertices when body 0 has turned by `angle` about the origin and body 1 by minus that about its own middle.
template <int Dim>
Points<Dim> turned_by(const contact::Surface<Dim>& surface, double angle) {
    Points<Dim> x = surface.vertices;
    for (std::int32_t face = 0; face < surface.size(); ++face)
        for (const std::int32_t v : surface.view().vertices_of(face)) {
            const double sign = surface.body[face] == 0 ? 1.0 : -1.0;
            const Vector<2> centre(surface.body[face] == 0 ? 0.0 : middle_distance, 0.0);
            const Matrix<2> turn = rotation_in_plane(sign * angle);
            const Vector<2> turned = turn * (surface.vertices[v].template head<2>() - centre) + centre;
            std::ranges::copy(turned, x[v].begin());
        }
    return x;
}

template <int Dim>
double largest_motion(const Points<Dim>& from, const Points<Dim>& to) {
    double largest = 0.0;
    for (std::size_t v = 0; v < from.size(); ++v) largest = std::max(largest, (to[v] - from[v]).norm());
    return largest;
}

/// Of the pairs that overlap those that look at each other and have a gap of (-depth, distance).
template <int Dim>
std::vector<IndexPair> near_ones(const contact::Overlaps<Dim>& overlaps, const contact::Surface<Dim>& now, double depth,
                                 double distance) {
    std::vector<IndexPair> near;
    for (const auto& overlap : overlaps.found)
        if (now.normal[overlap.face_1].dot(now.normal[overlap.face_2]) < -0.2 && overlap.gap > -depth &&
            overlap.gap < distance)
            near.push_back({overlap.face_1, overlap.face_2});
    return near;
}

std::ptrdiff_t missing(const std::vector<IndexPair>& required, std::span<const IndexPair> list) {
    return std::ranges::count_if(required, [&](IndexPair pair) { return !std::ranges::binary_search(list, pair); });
}

/// The list that a host keeps by the motion of vertices alone, though its faces turn: made from the normals of a step.
template <int Dim>
class ListOfNormals {
public:
    explicit ListOfNormals(const contact::CandidateOptions& options) : options_(options) {}

    std::span<const IndexPair> at(const contact::Surface<Dim>& now) {
        if (made_.size() == 0 || !search_->is_valid_for(largest_motion<Dim>(made_.vertices, now.vertices))) {
            made_ = now;
            search_.emplace(made_.view(), options_);
            search_->search(at_rest(made_), at_rest(made_));
            ++lists;
        }
        return search_->candidates();
    }
    int lists = 0;

private:
    contact::CandidateOptions options_;
    contact::Surface<Dim> made_;
    std::optional<contact::CandidateSearch<Dim>> search_;
};

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "between turning gears a list of moved vertices misses no pair, and one of the normals of a step does",
    "[contact][candidates][gears]", ((int Dim), Dim), 2, 3) {
    const double size = 0.1, depth = 0.2 * size, distance = size, skin = 2.0 * size;
    contact::Surface<Dim> surface;
    append_gear<Dim>(surface, Vector<2>::Zero(), 0.0, 0.1 * depth, 0);
    append_gear<Dim>(surface, Vector<2>(middle_distance, 0.0), std::numbers::pi + 0.5 * pitch, 0.1 * depth, 1);
    const auto all = all_pairs(surface);
    const contact::CandidateOptions options{.distance = distance, .skin = skin};
    contact::CandidateSearch<Dim> search(surface.view(), options);
    ListOfNormals<Dim> of_normals(options);

    const int steps = 120;
    Points<Dim> made;
    std::ptrdiff_t required = 0, missed = 0, missed_by_normals = 0, lists = 0;
    int differing_steps = 0;
    for (int step = 0; step <= steps; ++step) {
        const auto x = turned_by(surface, 1.5 * pitch * step / steps);  // one tooth and a half
        if (!search.is_valid_for(made.empty() ? 0.0 : largest_motion<Dim>(made, x))) {
            search.search_moved(x, x, GapOf::centroids);
            made = x;
            ++lists;
        }
        const auto now = rebuilt(surface, x);
        const auto near = near_ones<Dim>(contact::find_overlaps<Dim>(now.view(), at_rest(now), all), now, depth, distance);
        required += static_cast<std::ptrdiff_t>(near.size());
        missed += missing(near, search.candidates());
        missed_by_normals += missing(near, of_normals.at(now));
        const auto overlaps = contact::find_overlaps_moved<Dim>(surface.view(), x, search.candidates());
        differing_steps += near_ones<Dim>(overlaps, now, depth, distance) != near;
    }
    CHECK(missed == 0);
    CHECK(differing_steps == 0);
    CHECK(missed_by_normals > 0);
    CHECK(required > 1000);
    CHECK(lists < steps);
    CHECK(lists == of_normals.lists);
}
