#include "abut/contact/search/candidate_search.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/contact/messages.hpp"
#include "abut/contact/pair.hpp"
#include "abut/contact/search/face_boxes.hpp"
#include "abut/contact/search/neighbours.hpp"
#include "abut/contact/search/pair_filter.hpp"
#include "abut/contact/search/skin_choice.hpp"
#include "abut/geometry/broad_phase/sort_pairs.hpp"
#include "abut/geometry/broad_phase/spatial_order.hpp"

namespace abut::contact {
namespace {

using geometry::Box;
using geometry::IndexPair;

// Faces keep their spatial order for so many searches: bodies that turn or bend lose it only slowly.
constexpr std::int64_t searches_per_order = 50;

const CandidateOptions& checked(const CandidateOptions& options) {
    const auto refuse = [](const std::string& what, double value) {
        throw BadInput("contact options: " + what, {.value = value});
    };
    if (!(options.facing_cosine > -1.0 && options.facing_cosine <= 1.0))
        refuse("facing_cosine is " + number(options.facing_cosine) +
                   "; it must lie above -1 and not above 1. -0.5 is the default, 1 lists faces whatever their normals.",
               options.facing_cosine);
    if (!(options.distance >= 0.0) || !std::isfinite(options.distance))
        refuse("distance is " + number(options.distance) + " m; it must be finite and >= 0. Contact needs 0.",
               options.distance);
    if (!(options.skin >= 0.0) || !std::isfinite(options.skin))
        refuse("skin is " + number(options.skin) + " m; it must be finite and >= 0. Give 0 to let the library choose.",
               options.skin);
    if (options.self_contact_rings < 0)
        refuse(
            "self_contact_rings is " + std::to_string(options.self_contact_rings) + "; it must be >= 0. 1 is the default.",
            options.self_contact_rings);
    if (!(options.largest_motion > 0.0))
        refuse("largest_motion is " + number(options.largest_motion) + "; it must be > 0. 1 is the default.",
               options.largest_motion);
    return options;
}

/// What became of the pairs whose boxes overlap.
struct Counts {
    std::int64_t box_pairs = 0;
    std::int64_t neighbours = 0;
    std::int64_t both_rigid = 0;
    std::int64_t not_facing = 0;
    std::int64_t too_far_apart = 0;
};

/// Faces of one body.
struct BodyFaces {
    std::size_t begin;  ///< in the list of all faces
    std::size_t end;
    bool is_rigid;  ///< all of them are
};

}  // namespace

template <int Dim>
class CandidateSearch<Dim>::Implementation {
public:
    Implementation(SurfaceView<Dim> surface, const CandidateOptions& options)
        : surface_(surface), options_(checked(options)), skin_(Dim, options.skin, checked_face_size(surface)) {
        if (options_.self_contact && options_.self_contact_rings > 0)
            neighbours_.emplace(surface_, options_.self_contact_rings);
        measure_extent();
    }

    void surface_changed() {
        list_holds_ = false;
        check(surface_);
        measure_extent();
        const RestFaceMaker<Dim> at_rest(surface_, options_);
        parallel_each(n_faces(), [&](std::ptrdiff_t i) { faces_[i] = at_rest(faces_[i].face); });
    }

    [[nodiscard]] bool is_valid_for(double motion) const { return list_holds_ && motion <= 0.5 * list_skin_; }

    void search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
        list_holds_ = false;
        candidates_.clear();
        check_motion(u_0, u_1);
        if (report_.searches % searches_per_order == 0) order_faces(u_0);
        ++report_.searches;
        list_skin_ = skin_.skin();
        make_boxes(u_0, u_1);
        find(u_0, u_1);
        report_.candidates = static_cast<std::int64_t>(candidates_.size());
        report_.candidates_max = std::max(report_.candidates_max, report_.candidates);
        if (options_.skin == 0.0)
            skin_.learn(report_.candidates, count_at_half_skin(u_0, u_1), surface_.size(), report_.motion);
        list_holds_ = true;
    }

    [[nodiscard]] std::span<const IndexPair> candidates() const { return candidates_; }
    [[nodiscard]] double skin() const { return report_.searches > 0 ? list_skin_ : skin_.skin(); }
    [[nodiscard]] double next_skin() const { return skin_.skin(); }
    void restore_skin(double skin) {
        if (!(skin >= 0.0) || !std::isfinite(skin))
            throw BadInput("contact: a saved skin is " + number(skin) + " m; it must be finite and >= 0.", {.value = skin});
        skin_.restore(skin);
    }
    [[nodiscard]] const CandidateReport& report() const { return report_; }

private:
    static double checked_face_size(const SurfaceView<Dim>& surface) {
        check(surface);
        return mean_face_size(surface);
    }

    void measure_extent() {
        Box<Dim> box;
        for (const std::int32_t v : surface_.face_vertices) box.extend(surface_.vertices[v]);
        extent_ = box.empty() ? 0.0 : (box.upper - box.lower).norm();
    }

    /// Body by body, those of a body in spatial order.
    void order_faces(std::span<const Vector<Dim>> u) {
        std::vector<Vector<Dim>> centroids(surface_.centroid.begin(), surface_.centroid.end());
        for (std::size_t face = 0; face < centroids.size(); ++face) centroids[face] += u[face];
        std::vector<std::int32_t> order = geometry::spatial_order<Dim>(centroids);
        std::ranges::stable_sort(order, {}, [&](std::int32_t face) { return surface_.body[face]; });
        faces_.resize(order.size());
        const RestFaceMaker<Dim> at_rest(surface_, options_);
        parallel_each(n_faces(), [&](std::ptrdiff_t i) { faces_[i] = at_rest(order[static_cast<std::size_t>(i)]); });
        list_bodies();
        ++report_.orderings;
    }

    void list_bodies() {
        bodies_.clear();
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            const std::int32_t face = faces_[i].face;
            const bool rigid = surface_.is_rigid(face);
            if (i == 0 || surface_.body[face] != surface_.body[faces_[i - 1].face]) bodies_.push_back({i, i, rigid});
            bodies_.back().end = i + 1;
            bodies_.back().is_rigid = bodies_.back().is_rigid && rigid;
        }
    }

    [[nodiscard]] std::ptrdiff_t n_faces() const { return static_cast<std::ptrdiff_t>(faces_.size()); }

    void check_motion(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
        const auto n = static_cast<std::size_t>(surface_.size());
        for (const std::size_t size : {u_0.size(), u_1.size()})
            if (size != n)
                throw BadInput("contact: " + std::to_string(size) + " displacements are given for " + std::to_string(n) +
                                   " faces of the surface; give one each.",
                               {.value = static_cast<double>(size), .allowed = static_cast<double>(n)});
        // NaN where one of the two displacements is not finite
        const auto motion = [&](std::ptrdiff_t face) {
            return u_0[face].allFinite() ? (u_1[face] - u_0[face]).norm() : std::numeric_limits<double>::quiet_NaN();
        };
        report_.motion = largest(surface_.size(), motion);
        const double allowed = options_.largest_motion * extent_;
        if (std::isfinite(report_.motion) && report_.motion <= allowed) return;
        for (std::int32_t face = 0; face < surface_.size(); ++face) {
            if (!std::isfinite(motion(face)))
                throw Diverged("contact: the displacement of " + face_name(surface_, face) +
                                   " is not finite: the run has diverged. Take a smaller time step.",
                               {.face_1 = face});
            if (std::isfinite(report_.motion) && motion(face) == report_.motion)
                throw Diverged("contact: " + face_name(surface_, face) + " moves by " + number(report_.motion) +
                                   " m within a step, " + number(allowed) + " m is allowed, " +
                                   number(options_.largest_motion) +
                                   " times the extent of all surfaces: the run has diverged. Take a smaller time "
                                   "step, or raise CandidateOptions::largest_motion.",
                               {.face_1 = face, .value = report_.motion, .allowed = allowed});
        }
    }

    void make_boxes(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
        const Stopwatch watch(report_.seconds_boxes);
        const double margin = 0.5 * (options_.distance + list_skin_);
        boxes_.resize(faces_.size());
        parallel_each(n_faces(), [&](std::ptrdiff_t i) {
            const RestFace<Dim>& rest = faces_[i];
            boxes_[i] = swept_box(rest, u_0[rest.face], u_1[rest.face], margin);
        });
    }

    [[nodiscard]] std::span<const Box<Dim>> boxes_of(const BodyFaces& body) const {
        return {boxes_.data() + body.begin, body.end - body.begin};
    }

    /// Of bodies, the pairs that may touch; a body with itself where that is asked for.
    [[nodiscard]] std::vector<IndexPair> body_pairs() const {
        std::vector<Box<Dim>> boxes;
        for (const BodyFaces& body : bodies_) boxes.push_back(geometry::bounding_box<Dim>(boxes_of(body)));
        auto pairs = geometry::overlapping_pairs<Dim>({}, boxes, [&](std::int32_t a, std::int32_t b) {
            return !bodies_[static_cast<std::size_t>(a)].is_rigid || !bodies_[static_cast<std::size_t>(b)].is_rigid;
        });
        if (options_.self_contact)
            for (std::int32_t body = 0; body < static_cast<std::int32_t>(bodies_.size()); ++body)
                pairs.push_back({body, body});
        return pairs;
    }

    void find(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
        const Stopwatch watch(report_.seconds_broad_phase);
        counts_.clear();
        std::vector<IndexPair> list = std::exchange(candidates_, {});  // in its memory; a search that fails leaves none
        for (const auto& [a, b] : body_pairs()) {
            const BodyFaces &body_1 = bodies_[static_cast<std::size_t>(a)], &body_2 = bodies_[static_cast<std::size_t>(b)];
            const RestFace<Dim>*faces_1 = faces_.data() + body_1.begin, *faces_2 = faces_.data() + body_2.begin;
            const auto wanted = [&](std::int32_t i, std::int32_t j) {
                return is_candidate(faces_1[i], faces_2[j], u_0, u_1);
            };
            for (const auto& [i, j] : pairs_of_boxes(body_1, body_2, wanted, list.size())) {
                const auto [face_1, face_2] = std::minmax(faces_1[i].face, faces_2[j].face);
                list.push_back({face_1, face_2});
            }
        }
        geometry::sort_pairs(list, faces_.size());
        candidates_ = std::move(list);
        add_up_counts();
    }

    /// Of two bodies, or of one with itself; `n_before` pairs are in the list already, and count.
    [[nodiscard]] std::vector<IndexPair> pairs_of_boxes(const BodyFaces& body_1, const BodyFaces& body_2,
                                                        const geometry::PairFilter& wanted, std::size_t n_before) const {
        geometry::SearchOptions options{options_.broad_phase, options_.limits, true};
        options.limits.pairs -= static_cast<std::int64_t>(n_before);
        try {
            if (&body_1 == &body_2) return geometry::overlapping_pairs<Dim>(options, boxes_of(body_1), wanted);
            return geometry::overlapping_pairs<Dim>(options, boxes_of(body_1), boxes_of(body_2), wanted);
        } catch (const geometry::SearchLimitError& error) {
            if (n_before == 0) throw;
            throw geometry::SearchLimitError(error.what() + std::string(" Beside them ") + std::to_string(n_before) +
                                                 " pairs of other bodies are in the list and count.",
                                             error.facts().value, error.facts().allowed);
        }
    }

    bool is_candidate(const RestFace<Dim>& rest_1, const RestFace<Dim>& rest_2, std::span<const Vector<Dim>> u_0,
                      std::span<const Vector<Dim>> u_1) {
        const std::int32_t face_1 = rest_1.face, face_2 = rest_2.face;
        Counts& counts = counts_.local();
        ++counts.box_pairs;
        if (surface_.is_rigid(face_1) && surface_.is_rigid(face_2)) {
            ++counts.both_rigid;
            return false;
        }
        if (!by_distance_alone(options_)) {
            if (!are_facing(surface_, face_1, face_2, options_.facing_cosine)) {
                ++counts.not_facing;
                return false;
            }
            if (!can_touch(surface_, options_, rest_1, rest_2, u_0, u_1, list_skin_)) {
                ++counts.too_far_apart;
                return false;
            }
        }
        if (neighbours_ && surface_.body[face_1] == surface_.body[face_2] && (*neighbours_)(face_1, face_2)) {
            ++counts.neighbours;
            return false;
        }
        return true;
    }

    void add_up_counts() {
        Counts sum;
        for (const Counts& counts : counts_) {
            sum.box_pairs += counts.box_pairs;
            sum.neighbours += counts.neighbours;
            sum.both_rigid += counts.both_rigid;
            sum.not_facing += counts.not_facing;
            sum.too_far_apart += counts.too_far_apart;
        }
        report_.box_pairs = sum.box_pairs;
        report_.neighbours = sum.neighbours;
        report_.both_rigid = sum.both_rigid;
        report_.not_facing = sum.not_facing;
        report_.too_far_apart = sum.too_far_apart;
    }

    /// How many of the candidates half the skin would have found.
    [[nodiscard]] std::int64_t count_at_half_skin(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
        index_of_face_.resize(faces_.size());
        for (std::size_t i = 0; i < faces_.size(); ++i)
            index_of_face_[static_cast<std::size_t>(faces_[i].face)] = static_cast<std::int32_t>(i);
        const auto remains = [&](const IndexPair& pair) {
            const std::int32_t i = index_of_face_[static_cast<std::size_t>(pair.first)];
            const std::int32_t j = index_of_face_[static_cast<std::size_t>(pair.second)];
            return boxes_[i].grown(-0.5 * list_skin_).overlaps(boxes_[j]) &&
                   (by_distance_alone(options_) ||
                    can_touch(surface_, options_, faces_[i], faces_[j], u_0, u_1, 0.5 * list_skin_));
        };
        return std::ranges::count_if(candidates_, remains);
    }

    SurfaceView<Dim> surface_;
    CandidateOptions options_;
    SkinChoice skin_;
    double list_skin_ = 0.0;
    bool list_holds_ = false;
    std::optional<Neighbours> neighbours_;
    double extent_ = 0.0;               // of all surfaces at rest [m]
    std::vector<RestFace<Dim>> faces_;  // body by body, in spatial order
    std::vector<BodyFaces> bodies_;
    std::vector<Box<Dim>> boxes_;              // of faces_
    std::vector<std::int32_t> index_of_face_;  // in faces_
    std::vector<IndexPair> candidates_;
    oneapi::tbb::enumerable_thread_specific<Counts> counts_;
    CandidateReport report_;
};

template <int Dim>
CandidateSearch<Dim>::CandidateSearch(SurfaceView<Dim> surface, const CandidateOptions& options)
    : implementation_(std::make_unique<Implementation>(surface, options)) {}
template <int Dim>
CandidateSearch<Dim>::~CandidateSearch() = default;
template <int Dim>
CandidateSearch<Dim>::CandidateSearch(CandidateSearch&&) noexcept = default;
template <int Dim>
CandidateSearch<Dim>& CandidateSearch<Dim>::operator=(CandidateSearch&&) noexcept = default;

template <int Dim>
bool CandidateSearch<Dim>::is_valid_for(double motion) const {
    return implementation_->is_valid_for(motion);
}
template <int Dim>
void CandidateSearch<Dim>::search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
    implementation_->search(u_0, u_1);
}
template <int Dim>
void CandidateSearch<Dim>::surface_changed() {
    implementation_->surface_changed();
}
template <int Dim>
std::span<const IndexPair> CandidateSearch<Dim>::candidates() const {
    return implementation_->candidates();
}
template <int Dim>
double CandidateSearch<Dim>::skin() const {
    return implementation_->skin();
}
template <int Dim>
double CandidateSearch<Dim>::next_skin() const {
    return implementation_->next_skin();
}
template <int Dim>
void CandidateSearch<Dim>::restore_skin(double skin) {
    implementation_->restore_skin(skin);
}
template <int Dim>
const CandidateReport& CandidateSearch<Dim>::report() const {
    return implementation_->report();
}

template class CandidateSearch<2>;
template class CandidateSearch<3>;

}  // namespace abut::contact
