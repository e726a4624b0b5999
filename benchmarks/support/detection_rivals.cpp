// GPL parts of CGAL: for comparison only.
#include "support/detection_rivals.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <fcl/fcl.h>
#include <fcl/narrowphase/detail/primitive_shape_algorithm/triangle_distance.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>

namespace abut::benchmark {
namespace {

using geometry::Box;
using geometry::IndexPair;

std::int32_t index(std::size_t i) { return static_cast<std::int32_t>(i); }

// ---------------------------------------------------------------------------------------------------------------- CGAL

/// Sorts along axes and splits recursively (hybrid of segment tree and sweep).
class CgalBoxes : public Finder {
public:
    Pairs find(const Body& body_1, const Body& body_2, double distance) override {
        using CgalBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;
        const auto boxes_of = [&](const Body& body) {
            std::vector<CgalBox> boxes;
            boxes.reserve(body.triangles.size());
            for (const Box<3>& box : body.boxes(0.5 * distance))
                boxes.emplace_back(
                    CGAL::Bbox_3(box.lower[0], box.lower[1], box.lower[2], box.upper[0], box.upper[1], box.upper[2]),
                    index(boxes.size()));
            return boxes;
        };
        auto boxes_1 = boxes_of(body_1), boxes_2 = boxes_of(body_2);
        Pairs pairs;
        CGAL::box_intersection_d(boxes_1.begin(), boxes_1.end(), boxes_2.begin(), boxes_2.end(),
                                 [&](const CgalBox& a, const CgalBox& b) {
                                     pairs.push_back({a.info(), b.info()});
                                 });
        return pairs;
    }
};

/// A tree over the triangles of one body, asked with the box of each triangle of the other, grown by the distance.
class CgalTree : public Finder {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Triangles = std::vector<Kernel::Triangle_3>;
    using Tree =
        CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

public:
    Pairs find(const Body& body_1, const Body& body_2, double distance) override {
        Triangles triangles;
        triangles.reserve(body_2.triangles.size());
        const auto point = [](const Vector<3>& x) { return Kernel::Point_3(x[0], x[1], x[2]); };
        for (std::size_t i = 0; i < body_2.triangles.size(); ++i) {
            const auto [a, b, c] = body_2.corners(i);
            triangles.emplace_back(point(a), point(b), point(c));
        }
        Tree tree(triangles.cbegin(), triangles.cend());
        tree.build();
        Pairs pairs;
        std::vector<Triangles::const_iterator> met;
        const auto boxes = body_1.boxes(distance);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const CGAL::Bbox_3 box(boxes[i].lower[0], boxes[i].lower[1], boxes[i].lower[2], boxes[i].upper[0],
                                   boxes[i].upper[1], boxes[i].upper[2]);
            met.clear();
            tree.all_intersected_primitives(box, std::back_inserter(met));
            for (const auto& triangle : met)
                pairs.push_back({index(i), static_cast<std::int32_t>(triangle - triangles.cbegin())});
        }
        return pairs;
    }
};

// ----------------------------------------------------------------------------------------------------------------- FCL

/// Two triangle models collide: finds triangles that intersect, not those that are near.
class FclModels : public Finder {
    using Model = fcl::BVHModel<fcl::OBBRSS<double>>;

public:
    Pairs find(const Body& body_1, const Body& body_2, double) override {
        model_1_ = model(body_1);
        model_2_ = model(body_2);
        return query();
    }
    std::size_t follow(const Body& body_1, const Body& body_2, double) override {
        for (const auto& [m, body] : {std::pair(model_1_.get(), &body_1), {model_2_.get(), &body_2}}) {
            m->beginUpdateModel();
            m->updateSubModel(std::vector<fcl::Vector3d>(body->vertices.begin(), body->vertices.end()));
            m->endUpdateModel(true, true);
        }
        return query().size();
    }

private:
    static std::shared_ptr<Model> model(const Body& body) {
        auto result = std::make_shared<Model>();
        std::vector<fcl::Triangle> triangles;
        for (const auto& [a, b, c] : body.triangles) triangles.emplace_back(a, b, c);
        result->beginModel();
        result->addSubModel(std::vector<fcl::Vector3d>(body.vertices.begin(), body.vertices.end()), triangles);
        result->endModel();
        return result;
    }
    [[nodiscard]] Pairs query() const {
        const fcl::CollisionObjectd object_1(model_1_), object_2(model_2_);
        fcl::CollisionRequestd request;
        request.num_max_contacts = std::numeric_limits<std::size_t>::max();
        fcl::CollisionResultd result;
        fcl::collide(&object_1, &object_2, request, result);
        Pairs pairs;
        for (std::size_t i = 0; i < result.numContacts(); ++i)
            pairs.push_back(
                {static_cast<std::int32_t>(result.getContact(i).b1), static_cast<std::int32_t>(result.getContact(i).b2)});
        return pairs;
    }

    std::shared_ptr<Model> model_1_, model_2_;
};

/// A collision object for each triangle, in two dynamic trees that meet.
class FclManagers : public Finder {
public:
    Pairs find(const Body& body_1, const Body& body_2, double distance) override {
        first_.fill(body_1.boxes(0.5 * distance));
        second_.fill(body_2.boxes(0.5 * distance));
        return query();
    }
    std::size_t follow(const Body& body_1, const Body& body_2, double distance) override {
        first_.move(body_1.boxes(0.5 * distance));
        second_.move(body_2.boxes(0.5 * distance));
        return query().size();
    }

private:
    struct Side {
        std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
        std::unique_ptr<fcl::DynamicAABBTreeCollisionManagerd> manager;

        void fill(const std::vector<Box<3>>& boxes) {
            manager.reset();
            objects.clear();
            std::vector<fcl::CollisionObjectd*> all;
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                const Vector<3> sides = boxes[i].upper - boxes[i].lower;
                objects.push_back(std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl::Boxd>(sides)));
                objects.back()->setUserData(reinterpret_cast<void*>(i));
                place(*objects.back(), boxes[i]);
                all.push_back(objects.back().get());
            }
            manager = std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>();
            manager->registerObjects(all);
            manager->setup();
        }
        void move(const std::vector<Box<3>>& boxes) {
            for (std::size_t i = 0; i < boxes.size(); ++i) place(*objects[i], boxes[i]);
            manager->update();
        }
        static void place(fcl::CollisionObjectd& object, const Box<3>& box) {
            object.setTranslation(0.5 * (box.lower + box.upper));
            object.computeAABB();
        }
    };

    Pairs query() {
        Pairs pairs;
        first_.manager->collide(
            second_.manager.get(), &pairs, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
                static_cast<Pairs*>(data)->push_back({index(reinterpret_cast<std::size_t>(a->getUserData())),
                                                      index(reinterpret_cast<std::size_t>(b->getUserData()))});
                return false;
            });
        return pairs;
    }

    Side first_, second_;
};

// -------------------------------------------------------------------------------------------------------------- Embree

/// rtcCollide over user geometry; bounds rounded outwards to float, so that nothing is missed.
class EmbreeRaw : public Finder {
public:
    EmbreeRaw() : device_(rtcNewDevice(nullptr)) {
        if (device_ == nullptr) throw std::runtime_error("Embree gives no device");
    }
    ~EmbreeRaw() override {
        release();
        rtcReleaseDevice(device_);
    }
    EmbreeRaw(const EmbreeRaw&) = delete;
    EmbreeRaw& operator=(const EmbreeRaw&) = delete;

    Pairs find(const Body& body_1, const Body& body_2, double distance) override {
        release();
        build(sides_[0], body_1, distance);
        build(sides_[1], body_2, distance);
        return query();
    }
    std::size_t follow(const Body& body_1, const Body& body_2, double distance) override {
        for (int side = 0; side < 2; ++side) {
            sides_[side].boxes = (side == 0 ? body_1 : body_2).boxes(0.5 * distance);
            rtcSetGeometryBuildQuality(sides_[side].geometry, RTC_BUILD_QUALITY_REFIT);
            rtcCommitGeometry(sides_[side].geometry);
            rtcCommitScene(sides_[side].scene);
        }
        return query().size();
    }

private:
    struct Side {
        std::vector<Box<3>> boxes;
        RTCScene scene = nullptr;
        RTCGeometry geometry = nullptr;
    };

    static void bounds(const RTCBoundsFunctionArguments* arguments) {
        const Box<3>& box = (*static_cast<const std::vector<Box<3>>*>(arguments->geometryUserPtr))[arguments->primID];
        const auto down = [](double x) {
            return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
        };
        const auto up = [](double x) {
            return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
        };
        RTCBounds& out = *arguments->bounds_o;
        out.lower_x = down(box.lower[0]), out.lower_y = down(box.lower[1]), out.lower_z = down(box.lower[2]);
        out.upper_x = up(box.upper[0]), out.upper_y = up(box.upper[1]), out.upper_z = up(box.upper[2]);
    }

    void build(Side& side, const Body& body, double distance) const {
        side.boxes = body.boxes(0.5 * distance);
        side.scene = rtcNewScene(device_);
        side.geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(side.geometry, static_cast<unsigned>(side.boxes.size()));
        rtcSetGeometryUserData(side.geometry, &side.boxes);
        rtcSetGeometryBoundsFunction(side.geometry, bounds, nullptr);
        rtcCommitGeometry(side.geometry);
        rtcAttachGeometry(side.scene, side.geometry);
        rtcSetSceneBuildQuality(side.scene, RTC_BUILD_QUALITY_LOW);  // the fastest of the three, query included
        rtcSetSceneFlags(side.scene, RTC_SCENE_FLAG_DYNAMIC);
        rtcCommitScene(side.scene);
    }

    struct Found {
        const EmbreeRaw& finder;
        Pairs pairs;
        std::mutex in_use;
    };

    Pairs query() {
        Found found{*this, {}, {}};
        rtcCollide(
            sides_[0].scene, sides_[1].scene,
            [](void* data, RTCCollision* collisions, unsigned count) {
                auto& all = *static_cast<Found*>(data);
                const std::lock_guard lock(all.in_use);
                for (unsigned i = 0; i < count; ++i) {
                    const unsigned a = collisions[i].primID0, b = collisions[i].primID1;
                    if (all.finder.sides_[0].boxes[a].overlaps(all.finder.sides_[1].boxes[b]))
                        all.pairs.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b)});
                }
            },
            &found);
        return std::move(found.pairs);
    }

    void release() {
        for (Side& side : sides_) {
            if (side.geometry != nullptr) rtcReleaseGeometry(side.geometry);
            if (side.scene != nullptr) rtcReleaseScene(side.scene);
            side = {};
        }
    }

    RTCDevice device_;
    Side sides_[2];
};

template <class AFinder>
std::unique_ptr<Finder> make() {
    return std::make_unique<AFinder>();
}

}  // namespace

const std::vector<Rival>& rivals() {
    static const std::vector<Rival> all{
        {"rtcCollide", "Embree, user geometry, low build quality", make<EmbreeRaw>},
        {"box_intersection_d", "CGAL, sequential", make<CgalBoxes>},
        {"AABB_tree", "CGAL, tree of one body's triangles, asked with the boxes of the other's", make<CgalTree>},
        {"manager", "FCL, DynamicAABBTreeCollisionManager, an object a triangle", make<FclManagers>},
        {"BVHModel", "FCL, collide of two BVHModel<OBBRSS>", make<FclModels>}};
    return all;
}

double triangle_distance(const std::array<Vector<3>, 3>& a, const std::array<Vector<3>, 3>& b) {
    const fcl::Vector3d corners_a[3] = {a[0], a[1], a[2]}, corners_b[3] = {b[0], b[1], b[2]};
    fcl::Vector3d on_a, on_b;
    return fcl::detail::TriangleDistance<double>::triDistance(corners_a, corners_b, on_a, on_b);
}

}  // namespace abut::benchmark
