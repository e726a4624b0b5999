#include "apps/detect/nearest.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "abut/base/index.hpp"
#include "abut/geometry/box.hpp"
#include "abut/geometry/nearest/nearest_faces.hpp"
#include "abut/geometry/nearest/penetration.hpp"
#include "abut/geometry/nearest/winding_number.hpp"

namespace abut::apps {
namespace {

using Box = geometry::Box<3>;
using BodyPair = std::pair<std::int32_t, std::int32_t>;

double distance(const Box& a, const Box& b) { return (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(0.0).norm(); }

/// The faces of one body.
struct BodyFaces {
    std::vector<std::int32_t> face;  ///< of all
    std::vector<std::int32_t> offsets{0};
    std::vector<std::int32_t> corners;
    Box box;
};

class NearestSearch {
public:
    explicit NearestSearch(const Bodies& bodies) : vertices_(bodies.surface.vertices), bodies_(bodies.names.size()) {
        for (std::int32_t face = 0; face < bodies.surface.size(); ++face) {
            BodyFaces& of = bodies_[at(bodies.surface.body[at(face)])];
            of.face.push_back(face);
            for (const std::int32_t v : bodies.surface.view().vertices_of(face)) {
                of.corners.push_back(v);
                of.box.extend(vertices_[at(v)]);
            }
            of.offsets.push_back(static_cast<std::int32_t>(of.corners.size()));
        }
    }

    /// Pairs whose boxes say that one could be inside of the other; every so many of its vertices stand for all.
    std::vector<InsideBody> inside() {
        std::vector<InsideBody> found;
        const auto n = static_cast<std::int32_t>(bodies_.size());
        for (std::int32_t inner = 0; inner < n; ++inner)
            for (std::int32_t outer = 0; outer < n; ++outer) {
                if (inner == outer || !is_within(bodies_[at(inner)].box, bodies_[at(outer)].box)) continue;
                const double apart = measured(std::minmax(inner, outer)).points.distance;
                if (apart > 0.0 && is_wholly_inside(bodies_[at(inner)], bodies_[at(outer)]))
                    found.push_back({inner, outer, apart});
            }
        return found;
    }

    /// `inside`: of these bodies.
    std::vector<MeetingBodies> meeting(const std::vector<InsideBody>& inside) {
        std::map<BodyPair, std::int32_t> inner;
        for (const InsideBody& one : inside) inner.emplace(std::minmax(one.inner, one.outer), one.inner);
        std::vector<MeetingBodies> found;
        const auto n = static_cast<std::int32_t>(bodies_.size());
        for (std::int32_t one = 0; one < n; ++one)
            for (std::int32_t two = one + 1; two < n; ++two) {
                if (!bodies_[at(one)].box.overlaps(bodies_[at(two)].box)) continue;
                const auto contained = inner.find({one, two});
                if (contained == inner.end() && measured({one, two}).points.distance > 0.0) continue;
                found.push_back({one, two, depth_of(bodies_[at(one)], bodies_[at(two)]),
                                 contained == inner.end() ? -1 : contained->second});
            }
        return found;
    }

    std::vector<NearestBodies> all() {
        for (std::int32_t body = 0; at(body) < bodies_.size(); ++body) add_nearest_of(body);
        std::vector<NearestBodies> result;
        for (const auto& [pair, faces] : wanted_) result.push_back({pair.first, pair.second, faces});
        return result;
    }

private:
    static bool is_within(const Box& inner, const Box& outer) {
        return !inner.empty() && !outer.empty() && all_at_most(outer.lower, inner.lower) &&
               all_at_most(inner.upper, outer.upper);
    }
    [[nodiscard]] bool is_wholly_inside(const BodyFaces& inner, const BodyFaces& outer) const {
        constexpr std::size_t most_points = 64;
        const std::size_t stride = 1 + inner.corners.size() / most_points;
        for (std::size_t i = 0; i < inner.corners.size(); i += stride)
            if (!geometry::is_inside({vertices_, outer.offsets, outer.corners}, vertices_[at(inner.corners[i])]))
                return false;
        return true;
    }

    [[nodiscard]] double depth_of(const BodyFaces& one, const BodyFaces& two) const {
        return geometry::penetration_depth({vertices_, one.offsets, one.corners}, {vertices_, two.offsets, two.corners});
    }

    void add_nearest_of(std::int32_t body) {
        std::vector<std::pair<double, std::int32_t>> others;
        for (std::int32_t other = 0; at(other) < bodies_.size(); ++other)
            if (other != body && !bodies_[at(other)].face.empty())
                others.emplace_back(distance(bodies_[at(body)].box, bodies_[at(other)].box), other);
        if (others.empty() || bodies_[at(body)].face.empty()) return;
        std::ranges::sort(others);
        BodyPair nearest;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [between_boxes, other] : others) {
            if (!(between_boxes < least)) break;
            const BodyPair pair = std::minmax(body, other);
            const double found = measured(pair).points.distance;
            if (found < least) std::tie(least, nearest) = std::pair(found, pair);
        }
        wanted_.emplace(nearest, measured(nearest));
    }

    const geometry::NearestFaces& measured(const BodyPair& pair) {
        const auto [entry, is_new] = known_.try_emplace(pair);
        if (!is_new) return entry->second;
        const BodyFaces &one = bodies_[at(pair.first)], &two = bodies_[at(pair.second)];
        entry->second =
            geometry::nearest_faces({vertices_, one.offsets, one.corners}, {vertices_, two.offsets, two.corners});
        entry->second.face_1 = one.face[at(entry->second.face_1)];
        entry->second.face_2 = two.face[at(entry->second.face_2)];
        return entry->second;
    }

    const std::vector<Vector<3>>& vertices_;
    std::vector<BodyFaces> bodies_;
    std::map<BodyPair, geometry::NearestFaces> known_, wanted_;
};

}  // namespace

Neighbours neighbours(const Bodies& bodies) {
    if (bodies.names.size() > most_nearest_bodies) return {};
    NearestSearch search(bodies);
    Neighbours found{.nearest = search.all(), .inside = {}, .meeting = {}};
    found.inside = search.inside();
    found.meeting = search.meeting(found.inside);
    return found;
}

}  // namespace abut::apps
