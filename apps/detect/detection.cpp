#include "apps/detect/detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "abut/base/index.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/contact/overlap/face_distance.hpp"

namespace abut::apps {
namespace {

constexpr double default_distance = 0.5;  // mean face sizes
constexpr double no_skin = 1e-6;          // mean face sizes: for rounding, where a list serves one step
constexpr double bytes_a_megabyte = 1e6;

contact::CandidateOptions search_options(const DetectOptions& options, const Nearness& near) {
    contact::CandidateOptions search = options.search;
    search.distance = near.distance;
    search.skin = near.skin;
    search.planarity_tolerance = options.planarity_tolerance;
    if (!std::isnan(options.max_pairs)) search.limits.pairs = static_cast<std::int64_t>(options.max_pairs);
    if (!std::isnan(options.max_memory))
        search.limits.bytes = static_cast<std::size_t>(std::min(options.max_memory * bytes_a_megabyte, 1e18));
    return search;
}

}  // namespace

Nearness nearness(const DetectOptions& options, const Bodies& bodies, const Motion& motion) {
    const double size = bodies.mean_face_size();
    Nearness near{options.distance, options.depth, options.skin};
    if (std::isnan(near.distance)) near.distance = default_distance * size;
    if (std::isnan(near.depth)) near.depth = near.distance;
    if (std::isnan(near.skin)) near.skin = motion.steps() > 0 ? 0.0 : no_skin * size;
    return near;
}

Detection::Detection(const Bodies& bodies, const DetectOptions& options, const Nearness& near, bool turns)
    : bodies_(bodies),
      area_(options.area),
      facing_cosine_(options.search.facing_cosine),
      near_(near),
      turns_(turns),
      start_(bodies.surface),
      search_(start_.view(), search_options(options, near)) {}

const StepResult& Detection::find(int step) {
    result_ = {.step = step};
    {
        const Stopwatch watch(seconds_search_);
        result_.searched = !search_.is_valid_for(motion_since());
        if (result_.searched) search();
    }
    result_.box_pairs = search_.report().box_pairs;
    result_.candidates = search_.report().candidates;
    const Stopwatch watch(seconds_narrow_);
    contact::find_overlaps_moved<3>(start_.view(), bodies_.surface.vertices, search_.candidates(), area_, found_);
    keep_near_ones();
    return result_;
}

void Detection::measure_distances() {
    {
        const Stopwatch watch(seconds_narrow_);
        result_.distances = contact::face_distances<3>(start_.view(), bodies_.surface.vertices, result_.overlaps);
    }
    const Stopwatch watch(seconds_nearest_);
    result_.neighbours = neighbours(bodies_);
}

BodyContacts contacts_of(const Bodies& bodies, const StepResult& result) {
    BodyContacts contacts;
    const auto& body = bodies.surface.body;
    for (std::size_t i = 0; i < result.overlaps.size(); ++i) {
        const contact::Overlap<3>& overlap = result.overlaps[i];
        const double distance = result.distances[i];
        BodyContact& contact = contacts[std::minmax(body[at(overlap.face_1)], body[at(overlap.face_2)])];
        contact.distance_min = contact.overlaps == 0 ? distance : std::min(contact.distance_min, distance);
        contact.gap_min = contact.overlaps == 0 ? overlap.gap : std::min(contact.gap_min, overlap.gap);
        contact.area += overlap.area;
        contact.depth = -contact.distance_min;
        ++contact.overlaps;
    }
    for (const MeetingBodies& meeting : result.neighbours.meeting) {
        BodyContact& contact = contacts[{meeting.body_1, meeting.body_2}];
        contact.depth = meeting.depth;
        contact.inner = meeting.inner;
        contact.crosses = meeting.depth > 0.0 && meeting.inner < 0;
    }
    return contacts;
}

void Detection::search() {
    try {
        search_where_faces_are();
    } catch (const geometry::SearchLimitError& error) {
        throw std::runtime_error(
            fmt::format("step {}: {} Here: --distance, --skin, --max-pairs, --max-memory.", result_.step, error.what()));
    }
    at_search_ = bodies_.surface.vertices;
}

/// The gap that decides on a pair is that between the centroids.
void Detection::search_where_faces_are() {
    const auto& now = bodies_.surface.vertices;
    if (turns_) {
        search_.search_moved(now, now, contact::GapOf::centroids);
    } else {
        const auto u = translations();
        search_.search(u, u);
    }
}

/// Translation of each face, as its first corner shows it.
std::vector<Vector<3>> Detection::translations() const {
    std::vector<Vector<3>> u;
    u.reserve(start_.body.size());
    for (std::int32_t face = 0; face < start_.size(); ++face) {
        const std::size_t corner = at(start_.view().vertices_of(face).front());
        u.push_back(bodies_.surface.vertices[corner] - start_.vertices[corner]);
    }
    return u;
}

double Detection::motion_since() const {
    if (at_search_.empty()) return std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (std::size_t v = 0; v < at_search_.size(); ++v)
        largest = std::max(largest, (bodies_.surface.vertices[v] - at_search_[v]).norm());
    return largest;
}

void Detection::keep_near_ones() {
    result_.narrow = found_.report;
    result_.gap_min = std::numeric_limits<double>::infinity();
    result_.gap_max = -result_.gap_min;
    const auto& normal = bodies_.surface.normal;
    for (const contact::Overlap<3>& overlap : found_.found) {
        // A list of faces that turn holds pairs whichever way they look.
        const double cosine = normal[at(overlap.face_1)].dot(normal[at(overlap.face_2)]);
        if (!(cosine < facing_cosine_)) {
            ++result_.too_steep;
        } else if (overlap.gap > near_.distance) {
            ++result_.too_far;
        } else if (!(overlap.gap > -near_.depth)) {
            ++result_.too_deep;
        } else {
            result_.overlaps.push_back(overlap);
            result_.area += overlap.area;
            result_.gap_min = std::min(result_.gap_min, overlap.gap);
            result_.gap_max = std::max(result_.gap_max, overlap.gap);
        }
    }
}

}  // namespace abut::apps
