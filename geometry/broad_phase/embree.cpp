// Embree 3 and 4 differ, for what is used here, in the name of the header only.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <type_traits>

#include "abut/base/error.hpp"
#include "abut/base/fork_join.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/broad_phase/backends.hpp"

namespace abut::geometry::backend {
namespace {

template <class Handle, void (*release)(Handle)>
struct Release {
    void operator()(Handle handle) const { release(handle); }
};
template <class Handle, void (*release)(Handle)>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<Handle, release>>;
using Device = Owned<RTCDevice, rtcReleaseDevice>;
using Scene = Owned<RTCScene, rtcReleaseScene>;
using Geometry = Owned<RTCGeometry, rtcReleaseGeometry>;

// One device for the whole program: making one starts a thread pool and costs more than many a query.
RTCDevice device() {
    static const Device shared(rtcNewDevice(nullptr));
    if (!shared) throw BadInput("Embree gives no device; use another BroadPhase");
    return shared.get();
}

void check_device() {
    const RTCError error = rtcGetDeviceError(device());
    if (error != RTC_ERROR_NONE)
        throw BadInput("Embree failed with error " + std::to_string(error) + "; use another BroadPhase");
}

// Embree's tree is in single precision. Every bound goes through one function per coordinate that never decreases, and
// the test of its tree is closed: whatever touches in double still touches in float, no pair is lost.
struct FloatBox {
    std::array<float, 3> lower, upper;
};
using FloatBoxes = std::vector<FloatBox>;

double largest_side(const Box<3>& box) { return (box.upper - box.lower).maxCoeff(); }

// Whether the float image of `region` is too coarse for a tenth of the boxes or more: their boxes would swell so
// much that the number of false pairs could grow with the square of theirs.
bool float_is_too_coarse(Boxes boxes, const Box<3>& region) {
    constexpr double resolution = 1e-5;  // of the region: some 100 times the spacing of floats
    const auto is_small = [limit = resolution * largest_side(region)](const Box<3>& box) {
        return largest_side(box) < limit;
    };
    return 10 * std::count_if(boxes.begin(), boxes.end(), is_small) >= static_cast<std::ptrdiff_t>(boxes.size());
}

// The common origin comes out and the region becomes of unit size before anything is rounded to float.
FloatBoxes scaled(Boxes boxes, const Box<3>& region) {
    const Vector<3> origin = region.lower + 0.5 * (region.upper - region.lower);
    const double size = largest_side(region);
    const double unit = size > 0.0 ? size : 1.0;
    FloatBoxes result(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            result[i].lower[axis] = static_cast<float>((boxes[i].lower[axis] - origin[axis]) / unit);
            result[i].upper[axis] = static_cast<float>((boxes[i].upper[axis] - origin[axis]) / unit);
        }
    return result;
}

std::vector<double> sorted_bounds(std::span<const Boxes> sets, int axis) {
    std::vector<double> bounds;
    for (const Boxes& boxes : sets)
        for (const Box<3>& box : boxes) bounds.insert(bounds.end(), {box.lower[axis], box.upper[axis]});
    sort_unique(bounds);
    return bounds;
}

// Each bound becomes its rank among all bounds of its axis: any range of sizes fits into a float (exactly up to 2^24
// different bounds, without loss of pairs beyond).
void rank_axis(Boxes boxes, int axis, const std::vector<double>& bounds, FloatBoxes& result) {
    const auto rank = [&bounds](double bound) {
        return static_cast<float>(std::lower_bound(bounds.begin(), bounds.end(), bound) - bounds.begin());
    };
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        result[i].lower[axis] = rank(boxes[i].lower[axis]);
        result[i].upper[axis] = rank(boxes[i].upper[axis]);
    }
}

std::vector<FloatBoxes> float_boxes(std::span<const Boxes> sets) {
    Box<3> region;
    for (const Boxes& boxes : sets) region.extend(bounding_box(boxes));
    std::vector<FloatBoxes> result;
    if (std::none_of(sets.begin(), sets.end(), [&](const Boxes& boxes) { return float_is_too_coarse(boxes, region); })) {
        for (const Boxes& boxes : sets) result.push_back(scaled(boxes, region));
        return result;
    }
    for (const Boxes& boxes : sets) result.emplace_back(boxes.size());
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double> bounds = sorted_bounds(sets, axis);
        for (std::size_t k = 0; k < sets.size(); ++k) rank_axis(sets[k], axis, bounds, result[k]);
    }
    return result;
}

/// Data that Embree's threads read while it builds a tree.
struct Source {
    const FloatBoxes& boxes;
    ForkJoin loop{};
};

void give_bounds(const RTCBoundsFunctionArguments* arguments) {
    Source& source = *static_cast<Source*>(arguments->geometryUserPtr);
    const ForkJoin::Task task(source.loop);
    const FloatBox& box = source.boxes[arguments->primID];
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = box.lower[0], bounds.lower_y = box.lower[1], bounds.lower_z = box.lower[2];
    bounds.upper_x = box.upper[0], bounds.upper_y = box.upper[1], bounds.upper_z = box.upper[2];
}

Scene scene_of(const FloatBoxes& boxes) {
    Source source{boxes};
    Scene scene(rtcNewScene(device()));
    const Geometry geometry(rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(boxes.size()));
    rtcSetGeometryUserData(geometry.get(), &source);
    rtcSetGeometryBoundsFunction(geometry.get(), give_bounds, nullptr);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene.get(), geometry.get());
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);  // half the build time for the same query time
    source.loop.begin(&source);
    rtcCommitScene(scene.get());
    rtcSetGeometryUserData(geometry.get(), nullptr);  // `source` ends here, and the scene lives on
    check_device();
    return scene;
}

// rtcCollide reports from several threads at once, whole leaves without a test of each pair, and both orders (with
// every box against itself) when a scene meets itself. It cannot be stopped: pairs beyond the limit are dropped.
struct Collector {
    Boxes boxes_1, boxes_2;
    bool within_one_set;
    FoundPairs& found;
    ForkJoin loop{};

    static void report(void* user, RTCCollision* collisions, unsigned count) {
        auto& self = *static_cast<Collector*>(user);
        const ForkJoin::Task task(self.loop);
        FoundPairs::Local& mine = self.found.local();
        for (const RTCCollision& collision : std::span(collisions, count)) {
            const IndexPair pair{static_cast<std::int32_t>(collision.primID0), static_cast<std::int32_t>(collision.primID1)};
            if (self.within_one_set && pair.first >= pair.second) continue;
            if (self.boxes_1[pair.first].overlaps(self.boxes_2[pair.second])) mine.add(pair.first, pair.second);
        }
    }
};

void collide(RTCScene scene_1, RTCScene scene_2, Collector& collector) {
    collector.loop.begin(&collector);
    rtcCollide(scene_1, scene_2, Collector::report, &collector);
    check_device();
}

}  // namespace

const bool has_embree = true;

void find_by_embree(Boxes boxes_1, Boxes boxes_2, FoundPairs& found) {
    const std::vector<FloatBoxes> images = float_boxes(std::array{boxes_1, boxes_2});
    const Scene scene_1 = scene_of(images[0]), scene_2 = scene_of(images[1]);
    Collector collector{boxes_1, boxes_2, false, found};
    collide(scene_1.get(), scene_2.get(), collector);
}

void find_by_embree(Boxes boxes, FoundPairs& found) {
    const std::vector<FloatBoxes> images = float_boxes(std::array{boxes});
    const Scene scene = scene_of(images[0]);
    Collector collector{boxes, boxes, true, found};
    collide(scene.get(), scene.get(), collector);
}

}  // namespace abut::geometry::backend
