#include "abut/contact/overlap/overlaps.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/simd.hpp"
#include "abut/contact/overlap/overlap_checks.hpp"
#include "abut/contact/pairs/pair.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/geometry/overlap/batch.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {
namespace {

using geometry::AreaMethod;
using geometry::IndexPair;
using geometry::TriangleBatch;

template <int Dim>
struct Scene {
    const SurfaceView<Dim>& surface;
    std::span<const Vector<Dim>> displacement;

    [[nodiscard]] bool are_facing(IndexPair pair) const {
        return contact::are_facing(surface, pair.first, pair.second, 0.0);
    }
    [[nodiscard]] Vector<Dim> motion(IndexPair pair) const { return displacement[pair.second] - displacement[pair.first]; }
    [[nodiscard]] Vector<Dim> apart(IndexPair pair) const {
        return contact::apart(surface, pair.first, pair.second, displacement[pair.first], displacement[pair.second]);
    }
    [[nodiscard]] const Vector<Dim>& corner(std::int32_t face, int i) const {
        return surface.vertices[surface.face_vertices[surface.face_offsets[face] + i]];
    }
    /// Asks for what is known of a face before it is needed: the faces of a list of pairs are all over the memory.
    void prefetch(std::int32_t face) const {
        __builtin_prefetch(&surface.normal[face]);
        __builtin_prefetch(&surface.centroid[face]);
        __builtin_prefetch(&displacement[face]);
        __builtin_prefetch(&surface.area[face]);
        __builtin_prefetch(&surface.stiffness[face]);
        for (int i = 0; i < Dim; ++i) __builtin_prefetch(&corner(face, i));
    }
    [[nodiscard]] int n_corners(std::int32_t face) const {
        return surface.face_offsets[face + 1] - surface.face_offsets[face];
    }
};

// One pair of any two faces, seen along its normal from a corner of face 1.
template <int Dim>
struct ProjectedPair {
    geometry::PlaneFrame<Dim> frame;
    std::array<PlaneVector<Dim>, geometry::max_polygon_vertices> corners_1, corners_2;
    int size_1, size_2;

    ProjectedPair(const Scene<Dim>& scene, IndexPair pair)
        : frame(pair_normal(scene.surface, pair.first, pair.second)),
          size_1(checked_size(scene, pair.first)),
          size_2(checked_size(scene, pair.second)) {
        const Vector<Dim>& origin = scene.corner(pair.first, 0);
        project_face<Dim>(scene.surface, pair.first, origin, Vector<Dim>::Zero(), frame, corners_1.begin());
        project_face<Dim>(scene.surface, pair.second, origin, scene.motion(pair), frame, corners_2.begin());
    }
    static int checked_size(const Scene<Dim>& scene, std::int32_t face) {
        const int n = scene.n_corners(face);
        if (n > geometry::max_polygon_vertices)
            throw BadInput("overlaps: " + face_name(scene.surface, face) + " has " + std::to_string(n) +
                               " corners, at most " + std::to_string(geometry::max_polygon_vertices) +
                               " are allowed. Cut it into triangles.",
                           {.face_1 = face, .value = static_cast<double>(n), .allowed = geometry::max_polygon_vertices});
        return n;
    }
    [[nodiscard]] geometry::ProjectedFace<Dim> face_1() const {
        return {corners_1.data(), static_cast<std::size_t>(size_1)};
    }
    [[nodiscard]] geometry::ProjectedFace<Dim> face_2() const {
        return {corners_2.data(), static_cast<std::size_t>(size_2)};
    }
};

template <int Dim>
geometry::OverlapArea<Dim> overlap_area(geometry::ProjectedFace<Dim> face_1, geometry::ProjectedFace<Dim> face_2,
                                        AreaMethod method, geometry::DecisionCounts& counts) {
    if constexpr (Dim == 3)
        if (method == AreaMethod::fast)
            return geometry::counted_overlap_area(face_1, face_2, PlaneVector<3>::Zero(), counts);
    ++(method == AreaMethod::fast ? counts.by_doubles : counts.by_exact_arithmetic);
    return geometry::overlap_area<Dim>(face_1, face_2, PlaneVector<Dim>::Zero(), method);
}

// Pairs one by one.
template <int Dim>
void append_overlap(const Scene<Dim>& scene, IndexPair pair, AreaMethod method, Overlaps<Dim>& overlaps) {
    if (!scene.are_facing(pair)) {
        ++overlaps.report.not_facing;
        return;
    }
    const ProjectedPair<Dim> projected(scene, pair);
    const auto shared = overlap_area<Dim>(projected.face_1(), projected.face_2(), method, overlaps.report.decided);
    if (shared.area == 0.0) return;
    const Vector<Dim>& normal = projected.frame.normal();
    overlaps.found.push_back({pair.first, pair.second, shared.area, normal, scene.apart(pair).dot(normal),
                              projected.frame.lift(shared.area_gradient)});
}

// Pairs of triangles, one a column: first gathered, then computed side by side. The larger face is a, the smaller b; both
// are seen from corner 0 of b.
class TriangleBlock {
public:
    static constexpr int capacity = TriangleBatch::size;
    static_assert(capacity % lane_count == 0);

    [[nodiscard]] int size() const { return size_; }

    void add(const Scene<3>& scene, IndexPair pair) {
        const int k = size_++;
        pairs_[k] = pair;
        is_swapped_[k] = scene.surface.area[pair.second] > scene.surface.area[pair.first];
        const bool other = is_swapped_[k];  // which face is a; an index, for branches could not be foretold
        const std::array<std::int32_t, 2> faces{pair.first, pair.second};
        const std::array<std::array<const Vector<3>*, 3>, 2> corners{corners_of(scene, pair.first, 1, 2),
                                                                     corners_of(scene, pair.second, 2, 1)};
        const auto &a = corners[other], &b = corners[!other];
        const Vector<3>& origin = *b[0];
        const Vector<3> motion = scene.displacement[faces[other]] - scene.displacement[faces[!other]];
        for (int i = 0; i < 3; ++i) put((*a[i] - origin) + motion, a_[i], k);
        for (int i = 1; i < 3; ++i) put(*b[i] - origin, b_[i - 1], k);
        put(pair_direction(scene.surface, pair.first, pair.second), normal_, k);
        put(scene.apart(pair), apart_, k);
    }

    // Appends what the pairs share and forgets them.
    void flush(AreaMethod method, Overlaps<3>& overlaps) {
        if (size_ == 0) return;
        for (int k = size_; k % lane_count != 0; ++k) repeat_first(k);
        TriangleBatch batch;
        batch.x_b[0].fill(0.0);
        batch.y_b[0].fill(0.0);
        batch.rounded_shift.fill(0.0);
        for (int k = 0; k < size_; k += lane_count) project(k, batch);
        geometry::AreaBatch result;
        if (method == AreaMethod::fast)
            result = geometry::overlap_areas(batch, size_);
        else
            result.undecided = ~std::uint64_t{0};
        for (int k = 0; k < size_; ++k) {
            if (result.undecided >> k & 1) {
                append(k, one_by_one(batch, k, is_swapped_[k], method, overlaps.report.decided), overlaps);
            } else {
                ++overlaps.report.decided.by_doubles;
                const PlaneVector<3> derivative(result.area_gradient[0][k], result.area_gradient[1][k]);
                append(k, {result.area[k], is_swapped_[k] ? PlaneVector<3>(-derivative) : derivative}, overlaps);
            }
        }
        size_ = 0;
    }

private:
    using Row = std::array<double, capacity>;
    using Rows = std::array<Row, 3>;  // the components of a vector

    static void put(const Vector<3>& v, Rows& rows, int k) {
        for (int i = 0; i < 3; ++i) rows[i][k] = v[i];
    }
    // Face 2 runs the other way about the normal of the pair: its corners come as 0, 2, 1.
    static std::array<const Vector<3>*, 3> corners_of(const Scene<3>& scene, std::int32_t face, int second, int third) {
        return {&scene.corner(face, 0), &scene.corner(face, second), &scene.corner(face, third)};
    }
    // Columns left over must hold numbers.
    void repeat_first(int k) {
        const auto repeat = [k](Rows& rows) {
            for (Row& row : rows) row[k] = row[0];
        };
        std::for_each(a_.begin(), a_.end(), repeat);
        std::for_each(b_.begin(), b_.end(), repeat);
        repeat(normal_);
        repeat(apart_);
    }

    struct VectorLanes {
        Lanes x, y, z;
    };
    static VectorLanes load(const Rows& rows, int k) {
        return {load_lanes(&rows[0][k]), load_lanes(&rows[1][k]), load_lanes(&rows[2][k])};
    }
    static void store(const VectorLanes& v, Rows& rows, int k) {
        store_lanes(v.x, &rows[0][k]);
        store_lanes(v.y, &rows[1][k]);
        store_lanes(v.z, &rows[2][k]);
    }
    static Lanes dot(const VectorLanes& a, const VectorLanes& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    static VectorLanes cross(const VectorLanes& a, const VectorLanes& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    static VectorLanes normalized(const VectorLanes& a) {
        const Lanes scale = 1.0 / square_root(dot(a, a));
        return {scale * a.x, scale * a.y, scale * a.z};
    }
    // The first tangent of PlaneFrame: the axis farthest from the normal, times the normal.
    static VectorLanes tangent_of(const VectorLanes& n) {
        const Lanes x = absolute(n.x), y = absolute(n.y), z = absolute(n.z), zero{};
        const LaneMask along_x = (x <= y) & (x <= z), along_y = ~along_x & (y <= z);
        return normalized({along_x ? zero : (along_y ? n.z : -n.y), along_x ? -n.z : (along_y ? zero : n.x),
                           along_x ? n.y : (along_y ? -n.x : zero)});
    }

    // The columns from k on that fit in one register.
    void project(int k, TriangleBatch& batch) {
        const VectorLanes normal = normalized(load(normal_, k)), tangent_0 = tangent_of(normal),
                          tangent_1 = cross(normal, tangent_0);
        const auto project_corner = [&](const Rows& corner, TriangleBatch::Row& x, TriangleBatch::Row& y) {
            const VectorLanes arm = load(corner, k);
            store_lanes(dot(tangent_0, arm), &x[k]);
            store_lanes(dot(tangent_1, arm), &y[k]);
        };
        for (int i = 0; i < 3; ++i) project_corner(a_[i], batch.x_a[i], batch.y_a[i]);
        for (int i = 0; i < 2; ++i) project_corner(b_[i], batch.x_b[i + 1], batch.y_b[i + 1]);
        store_lanes(dot(normal, load(apart_, k)), &gap_[k]);
        store(normal, normal_, k);
        store(tangent_0, tangent_0_, k);
        store(tangent_1, tangent_1_, k);
    }

    static geometry::OverlapArea<3> one_by_one(const TriangleBatch& batch, int k, bool is_swapped, AreaMethod method,
                                               geometry::DecisionCounts& counts) {
        std::array<PlaneVector<3>, 3> a, b;
        for (int i = 0; i < 3; ++i) {
            a[i] = {batch.x_a[i][k], batch.y_a[i][k]};
            b[i] = {batch.x_b[i][k], batch.y_b[i][k]};
        }
        return is_swapped ? overlap_area<3>(b, a, method, counts) : overlap_area<3>(a, b, method, counts);
    }
    void append(int k, const geometry::OverlapArea<3>& shared, Overlaps<3>& overlaps) const {
        if (shared.area == 0.0) return;
        const auto column = [k](const Rows& rows) { return Vector<3>(rows[0][k], rows[1][k], rows[2][k]); };
        overlaps.found.push_back(
            {pairs_[k].first, pairs_[k].second, shared.area, column(normal_), gap_[k],
             shared.area_gradient.x() * column(tangent_0_) + shared.area_gradient.y() * column(tangent_1_)});
    }

    int size_ = 0;
    std::array<IndexPair, capacity> pairs_;
    std::array<bool, capacity> is_swapped_;
    alignas(64) std::array<Rows, 3> a_;
    alignas(64) std::array<Rows, 2> b_;
    alignas(64) Rows normal_, apart_, tangent_0_, tangent_1_;
    alignas(64) Row gap_;
};

void append_overlaps(const Scene<2>& scene, std::span<const IndexPair> pairs, AreaMethod method, Overlaps<2>& overlaps) {
    for (const IndexPair pair : pairs) append_overlap(scene, pair, method, overlaps);
}

// Triangles wait in a block. What cannot wait there takes its turn behind them: the order is that of the pairs.
void append_overlaps(const Scene<3>& scene, std::span<const IndexPair> pairs, AreaMethod method, Overlaps<3>& overlaps) {
    constexpr std::size_t ahead = 12;
    TriangleBlock block;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const IndexPair pair = pairs[i];
        if (i + ahead < pairs.size()) scene.prefetch(pairs[i + ahead].second);
        if (scene.n_corners(pair.first) != 3 || scene.n_corners(pair.second) != 3) {
            block.flush(method, overlaps);
            append_overlap(scene, pair, method, overlaps);
        } else if (!scene.are_facing(pair)) {
            ++overlaps.report.not_facing;
        } else {
            block.add(scene, pair);
            if (block.size() == TriangleBlock::capacity) block.flush(method, overlaps);
        }
    }
    block.flush(method, overlaps);
}

// One part of the pairs a task: a part is worth a task, and there are a few for every thread.
std::size_t number_of_parts(std::size_t n_pairs) {
    const auto threads = static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency());
    return threads == 1 ? 1 : std::clamp<std::size_t>(n_pairs / 2048, 1, 8 * threads);
}

// Puts the parts behind the first one, in order, and their counts together.
template <int Dim>
void join(std::span<const Overlaps<Dim>> parts, Overlaps<Dim>& all) {
    std::size_t n = all.found.size();
    for (const Overlaps<Dim>& part : parts) n += part.found.size();
    all.found.reserve(n);
    for (const Overlaps<Dim>& part : parts) {
        all.found.insert(all.found.end(), part.found.begin(), part.found.end());
        all.report.not_facing += part.report.not_facing;
        all.report.decided += part.report.decided;
    }
}

template <int Dim>
std::vector<Vector<Dim>> polygon_of(const Scene<Dim>& scene, IndexPair pair) {
    if (!scene.are_facing(pair)) return {};
    const ProjectedPair<Dim> projected(scene, pair);
    const Vector<Dim> origin = scene.corner(pair.first, 0) + scene.displacement[pair.first];
    const Vector<Dim> centroid_1 = scene.surface.centroid[pair.first] + scene.displacement[pair.first];
    const Vector<Dim> halfway = centroid_1 + 0.5 * scene.apart(pair);
    const Vector<Dim> on_plane = origin + (halfway - origin).dot(projected.frame.normal()) * projected.frame.normal();
    std::vector<Vector<Dim>> polygon;
    for (const PlaneVector<Dim>& corner : geometry::overlap_polygon<Dim>(projected.face_1(), projected.face_2()))
        polygon.push_back(on_plane + projected.frame.lift(corner));
    return polygon;
}

}  // namespace

template <int Dim>
void find_overlaps(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement,
                   std::span<const IndexPair> pairs, AreaMethod method, Overlaps<Dim>& overlaps) {
    check_arrays(surface, displacement);
    check_pairs(surface, displacement, pairs);

    overlaps.found.clear();
    overlaps.report = {};
    const Scene<Dim> scene{surface, displacement};
    const std::size_t n_parts = number_of_parts(pairs.size());
    std::vector<Overlaps<Dim>> others(n_parts - 1);
    parallel_tasks(n_parts, [&](std::size_t i) {
        const std::size_t begin = i * pairs.size() / n_parts, end = (i + 1) * pairs.size() / n_parts;
        Overlaps<Dim>& part = i == 0 ? overlaps : others[i - 1];
        part.found.reserve(end - begin);
        append_overlaps(scene, pairs.subspan(begin, end - begin), method, part);
    });
    join<Dim>(others, overlaps);
    overlaps.report.pairs = static_cast<std::int64_t>(pairs.size());
    overlaps.report.overlaps = static_cast<std::int64_t>(overlaps.found.size());
}

template <int Dim>
Overlaps<Dim> find_overlaps(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement,
                            std::span<const IndexPair> pairs, AreaMethod method) {
    Overlaps<Dim> overlaps;
    find_overlaps(surface, displacement, pairs, method, overlaps);
    return overlaps;
}

template <int Dim>
std::vector<Vector<Dim>> overlap_polygon(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement,
                                         IndexPair pair) {
    check_arrays(surface, displacement);
    check_pair(surface, displacement, pair);
    return polygon_of(Scene<Dim>{surface, displacement}, pair);
}

template <int Dim>
std::vector<std::vector<Vector<Dim>>> overlap_polygons(const SurfaceView<Dim>& surface,
                                                       std::span<const Vector<Dim>> displacement,
                                                       std::span<const IndexPair> pairs) {
    check_arrays(surface, displacement);
    check_pairs(surface, displacement, pairs);
    const Scene<Dim> scene{surface, displacement};
    std::vector<std::vector<Vector<Dim>>> polygons;
    polygons.reserve(pairs.size());
    for (const IndexPair pair : pairs) polygons.push_back(polygon_of(scene, pair));
    return polygons;
}

#define ABUT_INSTANTIATE(Dim)                                                                                           \
    template void find_overlaps<Dim>(const SurfaceView<Dim>&, std::span<const Vector<Dim>>, std::span<const IndexPair>, \
                                     AreaMethod, Overlaps<Dim>&);                                                       \
    template Overlaps<Dim> find_overlaps<Dim>(const SurfaceView<Dim>&, std::span<const Vector<Dim>>,                    \
                                              std::span<const IndexPair>, AreaMethod);                                  \
    template std::vector<Vector<Dim>> overlap_polygon<Dim>(const SurfaceView<Dim>&, std::span<const Vector<Dim>>,       \
                                                           IndexPair);                                                  \
    template std::vector<std::vector<Vector<Dim>>> overlap_polygons<Dim>(                                               \
        const SurfaceView<Dim>&, std::span<const Vector<Dim>>, std::span<const IndexPair>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
