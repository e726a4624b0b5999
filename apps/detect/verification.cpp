#include "apps/detect/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

#include "abut/base/index.hpp"
#include "abut/geometry/merged_vertices.hpp"
#include "abut/geometry/overlap/overlap.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::apps {
namespace {

using contact::Overlap;
using contact::SurfaceView;
using geometry::IndexPair;

// Pairs nearer to a limit than this are left to rounding: over the gap's limits, the cosine, and the smaller face.
constexpr double rounding = 1e-10;
constexpr double area_allowed = 1e-7;  // difference of areas, over the smaller face

/// Faces at every place where corners meet, and the faces within some steps of one.
class Rings {
public:
    Rings(const SurfaceView<3>& surface, std::span<const Vector<3>> start)
        : surface_(surface), place_(geometry::merged_vertices<3>(start)), faces_(start.size()) {
        for (std::int32_t face = 0; face < surface.size(); ++face)
            for (const std::int32_t v : surface.vertices_of(face)) faces_[at(place_[at(v)])].push_back(face);
    }
    [[nodiscard]] std::set<std::int32_t> around(std::int32_t face, int rings) const {
        std::set<std::int32_t> reached{face};
        for (int ring = 0; ring < rings; ++ring) {
            std::set<std::int32_t> next = reached;
            for (const std::int32_t inner : reached)
                for (const std::int32_t v : surface_.vertices_of(inner))
                    next.insert(faces_[at(place_[at(v)])].begin(), faces_[at(place_[at(v)])].end());
            reached = std::move(next);
        }
        return reached;
    }

private:
    const SurfaceView<3>& surface_;
    std::vector<std::int32_t> place_;
    std::vector<std::vector<std::int32_t>> faces_;
};

/// Verdict of a plain test on a pair.
enum class Verdict { no, on_limit, required };

struct PairFacts {
    Verdict verdict = Verdict::no;
    double area = 0.0;
    double gap = 0.0;
};

class Verifier {
public:
    Verifier(const SurfaceView<3>& surface, std::span<const Vector<3>> start, const Requirement& requirement,
             std::span<const IndexPair> candidates, std::span<const Overlap<3>> overlaps)
        : surface_(surface),
          requirement_(requirement),
          rings_(surface, start),
          candidates_(candidates),
          overlaps_(overlaps) {
        for (std::int32_t face = 0; face < surface.size(); ++face) radius_.push_back(radius_of(face));
    }

    Verification check(std::span<const std::int32_t> faces, bool all) {
        result_.faces = static_cast<std::int64_t>(faces.size());
        result_.sampled = !all;
        for (const std::int32_t face : faces) {
            beside_.reset();
            for (std::int32_t other = all ? face + 1 : 0; other < surface_.size(); ++other)
                if (other != face) check_pair(std::min(face, other), std::max(face, other), face);
        }
        for (const Overlap<3>& overlap : overlaps_)
            if (std::ranges::binary_search(faces, overlap.face_1)) check_wanted(overlap);
        return result_;
    }

private:
    /// Checks that nothing is listed which should not be.
    void check_wanted(const Overlap<3>& overlap) {
        const auto [face_1, face_2] = pair_of(overlap);
        const double smaller = std::min(surface_.area[at(face_1)], surface_.area[at(face_2)]);
        if (overlap.area <= rounding * smaller) return;  // faces that only touch, up to rounding: may be there or not
        const bool one_body = surface_.body[at(face_1)] == surface_.body[at(face_2)];
        const PairFacts facts = facts_of(face_1, face_2);
        const bool near = one_body && requirement_.rings > 0 && rings_.around(face_1, requirement_.rings).contains(face_2);
        if (facts.verdict == Verdict::no || near || (one_body && !requirement_.within_bodies))
            note(result_.wrong_overlaps, "is among the overlaps, but should not be", face_1, face_2, facts);
    }
    [[nodiscard]] double radius_of(std::int32_t face) const {
        double radius = 0.0;
        for (const std::int32_t v : surface_.vertices_of(face))
            radius = std::max(radius, (surface_.vertices[at(v)] - surface_.centroid[at(face)]).norm());
        return radius;
    }

    void check_pair(std::int32_t face_1, std::int32_t face_2, std::int32_t looked_at) {
        const bool one_body = surface_.body[at(face_1)] == surface_.body[at(face_2)];
        if (one_body && !requirement_.within_bodies) return;
        ++result_.tested;
        PairFacts facts = facts_of(face_1, face_2);
        if (facts.verdict == Verdict::no) return;
        if (one_body && are_neighbours(looked_at, looked_at == face_1 ? face_2 : face_1)) return;
        compare_lists(face_1, face_2, facts);
    }

    bool are_neighbours(std::int32_t face, std::int32_t other) {
        if (requirement_.rings == 0) return false;
        if (!beside_) beside_ = rings_.around(face, requirement_.rings);
        return beside_->contains(other);
    }

    /// docs/method.md: that of a much larger face, else the mean.
    [[nodiscard]] Vector<3> pair_normal(std::int32_t face_1, std::int32_t face_2) const {
        constexpr double much_larger = 1.45 * 1.45;
        const double area_1 = surface_.area[at(face_1)], area_2 = surface_.area[at(face_2)];
        if (area_1 > much_larger * area_2) return surface_.normal[at(face_1)];
        if (area_2 > much_larger * area_1) return -surface_.normal[at(face_2)];
        return (surface_.normal[at(face_1)] - surface_.normal[at(face_2)]).normalized();
    }

    [[nodiscard]] PairFacts facts_of(std::int32_t face_1, std::int32_t face_2) const {
        const Vector<3>&n_1 = surface_.normal[at(face_1)], &n_2 = surface_.normal[at(face_2)];
        const double cosine = n_1.dot(n_2);
        if (cosine >= requirement_.facing_cosine + rounding || cosine >= 0.0) return {};
        const Vector<3> normal = pair_normal(face_1, face_2);
        const Vector<3> apart = surface_.centroid[at(face_2)] - surface_.centroid[at(face_1)];
        PairFacts facts{.gap = apart.dot(normal)};
        const double slack = rounding * (requirement_.distance + requirement_.depth + apart.norm());
        if (facts.gap > requirement_.distance + slack || facts.gap < -requirement_.depth - slack) return {};
        if ((apart - facts.gap * normal).norm() > radius_[at(face_1)] + radius_[at(face_2)] + slack) return {};
        facts.area = area_of(face_1, face_2, normal);
        if (facts.area == 0.0) return {};
        const double smaller = std::min(surface_.area[at(face_1)], surface_.area[at(face_2)]);
        const bool clear = cosine < requirement_.facing_cosine - rounding && facts.gap < requirement_.distance - slack &&
                           facts.gap > -requirement_.depth + slack && facts.area > rounding * smaller;
        facts.verdict = clear ? Verdict::required : Verdict::on_limit;
        return facts;
    }

    [[nodiscard]] double area_of(std::int32_t face_1, std::int32_t face_2, const Vector<3>& normal) const {
        const geometry::PlaneFrame<3> frame(normal);
        const auto corners_1 = projected(frame, face_1, face_1);
        auto corners_2 = projected(frame, face_2, face_1);
        std::ranges::reverse(corners_2);
        return geometry::overlap_area<3>(corners_1, corners_2, PlaneVector<3>::Zero(), geometry::AreaMethod::exact).area;
    }
    [[nodiscard]] std::vector<PlaneVector<3>> projected(const geometry::PlaneFrame<3>& frame, std::int32_t face,
                                                        std::int32_t origin) const {
        std::vector<PlaneVector<3>> corners;
        for (const std::int32_t v : surface_.vertices_of(face))
            corners.push_back(frame.project(surface_.vertices[at(v)] - surface_.centroid[at(origin)]));
        return corners;
    }

    void compare_lists(std::int32_t face_1, std::int32_t face_2, const PairFacts& facts) {
        if (facts.verdict == Verdict::on_limit) {
            ++result_.on_limit;
            return;
        }
        ++result_.required;
        if (!std::ranges::binary_search(candidates_, IndexPair{face_1, face_2}))
            note(result_.missed_candidates, "is missing among the candidates", face_1, face_2, facts);
        const auto found = std::ranges::lower_bound(overlaps_, IndexPair{face_1, face_2}, {}, pair_of);
        if (found == overlaps_.end() || pair_of(*found) != IndexPair{face_1, face_2}) {
            note(result_.missed_overlaps, "is missing among the overlaps", face_1, face_2, facts);
            return;
        }
        compare_numbers(*found, facts);
    }
    void compare_numbers(const Overlap<3>& found, const PairFacts& facts) {
        const double smaller = std::min(surface_.area[at(found.face_1)], surface_.area[at(found.face_2)]);
        const double area_error = std::abs(found.area - facts.area) / smaller, gap_error = std::abs(found.gap - facts.gap);
        result_.area_error = std::max(result_.area_error, area_error);
        result_.gap_error = std::max(result_.gap_error, gap_error);
        const Vector<3> apart = surface_.centroid[at(found.face_2)] - surface_.centroid[at(found.face_1)];
        if (area_error > area_allowed || gap_error > rounding * (requirement_.distance + requirement_.depth + apart.norm()))
            note(result_.wrong_overlaps,
                 fmt::format("has the area {:.9g} m^2 and the gap {:.9g} m in the list", found.area, found.gap),
                 found.face_1, found.face_2, facts);
    }

    static IndexPair pair_of(const Overlap<3>& overlap) { return {overlap.face_1, overlap.face_2}; }

    void note(std::int64_t& count, const std::string& what, std::int32_t face_1, std::int32_t face_2,
              const PairFacts& facts) {
        ++count;
        if (result_.first_fault.empty())
            result_.first_fault = fmt::format("the pair of faces {} and {} (area {:.9g} m^2, gap {:.9g} m) {}", face_1,
                                              face_2, facts.area, facts.gap, what);
    }

    const SurfaceView<3>& surface_;
    const Requirement& requirement_;
    Rings rings_;
    std::span<const IndexPair> candidates_;
    std::span<const Overlap<3>> overlaps_;
    std::vector<double> radius_;
    std::optional<std::set<std::int32_t>> beside_;
    Verification result_;
};

/// splitmix64: the same everywhere.
std::uint64_t next_random(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

/// `n` different faces of `all`, in order.
std::vector<std::int32_t> sample(std::int32_t all, std::int64_t n, std::uint64_t seed) {
    std::vector<std::int32_t> faces(at(all));
    std::iota(faces.begin(), faces.end(), 0);
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
        std::swap(faces[i], faces[i + next_random(seed) % (faces.size() - i)]);
    faces.resize(static_cast<std::size_t>(n));
    std::ranges::sort(faces);
    return faces;
}

}  // namespace

Verification& Verification::operator+=(const Verification& other) {
    faces += other.faces;
    sampled = sampled || other.sampled;
    tested += other.tested;
    required += other.required;
    on_limit += other.on_limit;
    missed_candidates += other.missed_candidates;
    missed_overlaps += other.missed_overlaps;
    wrong_overlaps += other.wrong_overlaps;
    area_error = std::max(area_error, other.area_error);
    gap_error = std::max(gap_error, other.gap_error);
    if (first_fault.empty()) first_fault = other.first_fault;
    return *this;
}

Verification verify(const SurfaceView<3>& surface, std::span<const Vector<3>> start, const Requirement& requirement,
                    const VerificationLimits& limits, std::span<const IndexPair> candidates,
                    std::span<const Overlap<3>> overlaps) {
    const double n = surface.size();
    const bool all = limits.samples == 0 && 0.5 * n * (n - 1.0) <= limits.tests;
    const double wanted = limits.samples > 0 ? limits.samples : std::floor(limits.tests / std::max(n, 1.0));
    const auto n_faces = static_cast<std::int64_t>(all ? n : std::clamp(wanted, std::min(n, 1.0), n));
    Verifier verifier(surface, start, requirement, candidates, overlaps);
    return verifier.check(sample(surface.size(), n_faces, limits.seed), all);
}

}  // namespace abut::apps
