#include "apps/detect/detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "abut/base/stopwatch.hpp"

namespace abut::apps {
namespace {

constexpr double default_distance = 0.5;  // mean face sizes
constexpr double no_skin = 1e-6;          // mean face sizes: for rounding, where a list serves one step
constexpr double bytes_a_megabyte = 1e6;

contact::CandidateOptions search_options(const DetectOptions& options, const Nearness& near) {
    contact::CandidateOptions search = options.search;
    search.distance = near.distance;
    search.skin = near.skin;
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
    if (std::isnan(near.skin)) near.skin = motion.steps() > 0 && motion.only_translates() ? 0.0 : no_skin * size;
    return near;
}

Detection::Detection(const Bodies& bodies, const DetectOptions& options, const Nearness& near)
    : bodies_(bodies),
      area_(options.area),
      near_(near),
      at_rest_(bodies.surface.body.size(), Vector<3>::Zero()),
      search_(bodies.surface.view(), search_options(options, near)) {}

const StepResult& Detection::find(int step, bool turned) {
    result_ = {.step = step};
    {
        const Stopwatch watch(seconds_search_);
        result_.searched = turned || !search_.is_valid_for(motion_since());
        if (result_.searched) search();
    }
    result_.box_pairs = search_.report().box_pairs;
    result_.candidates = search_.report().candidates;
    const Stopwatch watch(seconds_narrow_);
    contact::find_overlaps<3>(bodies_.surface.view(), at_rest_, search_.candidates(), area_, found_);
    keep_near_ones();
    return result_;
}

void Detection::search() {
    if (!at_search_.empty()) search_.surface_changed();
    try {
        search_.search(at_rest_, at_rest_);
    } catch (const geometry::SearchLimitError& error) {
        throw std::runtime_error(
            fmt::format("step {}: {} Here: --distance, --skin, --max-pairs, --max-memory.", result_.step, error.what()));
    }
    at_search_ = bodies_.surface.vertices;
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
    for (const contact::Overlap<3>& overlap : found_.found) {
        if (overlap.gap > near_.distance) {
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
