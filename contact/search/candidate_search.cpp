#include "abut/contact/search/candidate_search.hpp"

#include <oneapi/tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/contact/option_table.hpp"
#include "abut/contact/search/face_boxes.hpp"
#include "abut/contact/search/face_order.hpp"
#include "abut/contact/search/moved_faces.hpp"
#include "abut/contact/search/neighbours.hpp"
#include "abut/contact/search/skin_choice.hpp"
#include "abut/contact/search/translated_faces.hpp"
#include "abut/contact/shared_work.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/geometry/broad_phase/search_part.hpp"
#include "abut/geometry/broad_phase/sort_pairs.hpp"

namespace abut::contact {
namespace {

using geometry::Box;
using geometry::IndexPair;

// Faces keep their spatial order for so many searches: bodies that turn or bend lose it only slowly.
constexpr std::int64_t searches_per_order = 50;

const CandidateOptions& checked(const CandidateOptions& options) {
    abut::check_options("contact options: ", search_options(), options);
    geometry::check_options({options.broad_phase, options.limits});
    for (const auto& [body_1, body_2] : options.ignored_bodies)
        if (body_1 < 0 || body_2 < 0)
            throw BadInput("contact options: ignored_bodies names body " + std::to_string(std::min(body_1, body_2)) +
                               "; bodies count from 0.",
                           {.value = static_cast<double>(std::min(body_1, body_2))});
    return options;
}

/// Outcome for the pairs whose boxes overlap.
struct Counts {
    std::int64_t box_pairs = 0;
    std::int64_t neighbours = 0;
    std::int64_t both_rigid = 0;
    std::int64_t not_facing = 0;
    std::int64_t too_far_apart = 0;

    Counts& operator+=(const Counts& other) {
        box_pairs += other.box_pairs;
        neighbours += other.neighbours;
        both_rigid += other.both_rigid;
        not_facing += other.not_facing;
        too_far_apart += other.too_far_apart;
        return *this;
    }
};

}  // namespace

template <int Dim>
class CandidateSearch<Dim>::Implementation {
public:
    Implementation(SurfaceView<Dim> surface, const CandidateOptions& options, Sharing* sharing)
        : surface_(surface),
          options_(checked(options)),
          shared_(sharing),
          skin_(Dim, options.skin, checked_face_size(surface, options)),
          translated_(surface_, options_) {
        if (options_.self_contact && options_.self_contact_rings > 0)
            neighbours_.emplace(surface_, options_.self_contact_rings);
        measure_extent();
    }

    [[nodiscard]] bool is_valid_for(double motion) const { return list_holds_ && motion <= 0.5 * list_skin_; }

    void search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1) {
        drop_list();
        within_ = nullptr;
        left_out_ = {};
        translated_.set_path(u_0, u_1);
        search_along(translated_);
    }

    void search_moved(PointsView<Dim> x_0, PointsView<Dim> x_1, GapOf gap, const geometry::PairFilter& within,
                      std::span<const char> left_out) {
        drop_list();
        MovedFaces<Dim> moved(surface_, options_, x_0, x_1, gap);
        within_ = &within;
        left_out_ = left_out;
        search_along(moved);
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
    static double checked_face_size(const SurfaceView<Dim>& surface, const CandidateOptions& options) {
        check(surface, options.planarity_tolerance);
        return mean_face_size(surface);
    }

    void measure_extent() {
        Box<Dim> box;
        for (const std::int32_t v : surface_.face_vertices) box.extend(surface_.vertices[v]);
        extent_ = box.empty() ? 0.0 : (box.upper - box.lower).norm();
    }

    void drop_list() {
        list_holds_ = false;
        candidates_.clear();
    }

    /// `Faces`: how they move, TranslatedFaces or MovedFaces.
    template <class Faces>
    void search_along(Faces& faces) {
        check_motion(faces);
        if (report_.searches % searches_per_order == 0) order_by_position(faces);
        take_order();
        ++report_.searches;
        list_skin_ = skin_.skin();
        make_boxes(faces);
        const std::int64_t at_half_skin = find(faces);
        report_.candidates = static_cast<std::int64_t>(candidates_.size());
        report_.candidates_max = std::max(report_.candidates_max, report_.candidates);
        if (options_.skin == 0.0) skin_.learn(report_.candidates, at_half_skin, surface_.size(), report_.motion);
        list_holds_ = true;
    }

    template <class Faces>
    void order_by_position(const Faces& faces) {
        std::vector<Vector<Dim>> middles(static_cast<std::size_t>(surface_.size()));
        for (std::size_t face = 0; face < middles.size(); ++face)
            middles[face] = faces.middle(static_cast<std::int32_t>(face));
        order_of_all_ = order_faces<Dim>(surface_, middles);
        has_new_order_ = true;
        translated_.forget();
        ++report_.orderings;
    }

    /// Takes the order of the faces that may be in pairs.
    void take_order() {
        if (!std::exchange(has_new_order_, false) && left_out_.empty() && order_.faces.size() == order_of_all_.faces.size())
            return;
        order_ = left_out_.empty() ? order_of_all_ : order_without(order_of_all_, left_out_);
        translated_.forget();
    }

    template <class Faces>
    void check_motion(const Faces& faces) {
        const auto motion = [&](std::ptrdiff_t face) { return faces.motion(static_cast<std::int32_t>(face)); };
        report_.motion = largest(surface_.size(), motion);
        const double allowed = options_.largest_motion * extent_;
        if (std::isfinite(report_.motion) && report_.motion <= allowed) return;
        for (std::int32_t face = 0; face < surface_.size(); ++face) {
            if (!std::isfinite(motion(face)))
                throw Diverged("contact: " + faces.name_of_position(face) +
                                   " is not finite: the run has diverged. Take a smaller time step.",
                               {.face_1 = face});
            if (std::isfinite(report_.motion) && motion(face) == report_.motion)
                throw Diverged("contact: " + faces.name_of_mover(face) + " moves by " + number(report_.motion) +
                                   " m within a step, " + number(allowed) + " m is allowed, " +
                                   number(options_.largest_motion) +
                                   " times the extent of all surfaces: the run has diverged. Take a smaller time "
                                   "step, or raise CandidateOptions::largest_motion.",
                               {.face_1 = face, .value = report_.motion, .allowed = allowed});
        }
    }

    template <class Faces>
    void make_boxes(Faces& faces) {
        const Stopwatch watch(report_.seconds_boxes);
        faces.prepare(order_);
        boxes_.resize(order_.faces.size());
        parallel_each(order_.size(), [&](std::ptrdiff_t i) { boxes_[i] = faces.box(i, list_skin_); });
    }

    [[nodiscard]] std::span<const Box<Dim>> boxes_of(const BodyFaces& body) const {
        return {boxes_.data() + body.begin, body.end - body.begin};
    }

    /// Pairs of bodies that may touch; a body with itself where that is asked for.
    [[nodiscard]] std::vector<IndexPair> body_pairs() const {
        std::vector<Box<Dim>> boxes;
        for (const BodyFaces& body : order_.bodies) boxes.push_back(geometry::bounding_box<Dim>(boxes_of(body)));
        auto pairs = geometry::overlapping_pairs<Dim>({}, boxes, [&](std::int32_t a, std::int32_t b) {
            const BodyFaces &body_1 = order_.bodies[static_cast<std::size_t>(a)],
                            &body_2 = order_.bodies[static_cast<std::size_t>(b)];
            return !(body_1.is_rigid && body_2.is_rigid) && !are_ignored(body_1, body_2);
        });
        if (options_.self_contact)
            for (std::int32_t b = 0; b < static_cast<std::int32_t>(order_.bodies.size()); ++b)
                if (const BodyFaces& body = order_.bodies[static_cast<std::size_t>(b)];
                    !body.is_rigid && !are_ignored(body, body))
                    pairs.push_back({b, b});
        return pairs;
    }

    [[nodiscard]] bool are_ignored(const BodyFaces& body_1, const BodyFaces& body_2) const {
        const std::int32_t a = surface_.body[order_.faces[body_1.begin]], b = surface_.body[order_.faces[body_2.begin]];
        return std::ranges::any_of(options_.ignored_bodies, [&](const std::array<std::int32_t, 2>& pair) {
            return pair == std::array{a, b} || pair == std::array{b, a};
        });
    }

    /// Makes the list; returns how many of its pairs half the skin would have found, 0 where nobody asks.
    template <class Faces>
    std::int64_t find(const Faces& faces) {
        std::vector<IndexPair> list = std::exchange(candidates_, {});  // in its memory; a search that fails leaves none
        const FoundByPart found =
            shared_.is_worth(order_.faces.size()) ? find_shared(faces, list) : find_part(faces, {}, list);
        {
            const Stopwatch watch(report_.seconds_broad_phase);
            geometry::sort_pairs(list, static_cast<std::size_t>(surface_.size()));
        }
        candidates_ = std::move(list);
        report_.box_pairs = found.counts.box_pairs;
        report_.neighbours = found.counts.neighbours;
        report_.both_rigid = found.counts.both_rigid;
        report_.not_facing = found.counts.not_facing;
        report_.too_far_apart = found.counts.too_far_apart;
        return found.at_half_skin;
    }

    /// Findings of a part beside its pairs.
    struct FoundByPart {
        Counts counts;
        std::int64_t at_half_skin = 0;
    };

    /// Each part appends its pairs, and gets those of all; in any order.
    template <class Faces>
    FoundByPart find_shared(const Faces& faces, std::vector<IndexPair>& list) {
        FoundByPart all;
        try {
            shared_.run(
                order_.faces.size(),
                [&](const IndexRange&, ShareWriter& out) {
                    out.put(find_part(faces, {shared_.part(), shared_.n_parts()}, list));
                    out.append(std::span<const IndexPair>(list));
                    list.clear();
                },
                [&](const IndexRange&, ShareReader& in) {
                    const auto of_part = in.get<FoundByPart>();
                    all.counts += of_part.counts;
                    all.at_half_skin += of_part.at_half_skin;
                    const std::size_t n = list.size();
                    list.resize(n + in.left() / sizeof(IndexPair));
                    in.fill(std::span(list).subspan(n));
                });
        } catch (const LimitExceeded& error) {  // of another part
            throw geometry::SearchLimitError(error.what(), error.facts().value, error.facts().allowed);
        }
        check_number(list.size());
        return all;
    }

    /// Checks the number of pairs of all parts together.
    void check_number(std::size_t n) const {
        if (static_cast<std::int64_t>(n) <= options_.limits.pairs) return;
        throw geometry::SearchLimitError(
            "contact: " + std::to_string(n) + " pairs of faces can touch, " + std::to_string(options_.limits.pairs) +
                " are allowed. Make `skin` or `distance` smaller, or raise SearchLimits::pairs.",
            static_cast<double>(n), static_cast<double>(options_.limits.pairs));
    }

    /// Appends the pairs of one part, unsorted.
    template <class Faces>
    FoundByPart find_part(const Faces& faces, const geometry::SearchPart& part, std::vector<IndexPair>& list) {
        append_pairs(faces, part, list);
        FoundByPart found;
        for (const Counts& counts : counts_) found.counts += counts;
        if (options_.skin == 0.0) found.at_half_skin = count_at_half_skin(faces, list);
        return found;
    }

    template <class Faces>
    void append_pairs(const Faces& faces, const geometry::SearchPart& part, std::vector<IndexPair>& list) {
        const Stopwatch watch(report_.seconds_broad_phase);
        counts_.clear();
        for (const auto& [a, b] : body_pairs()) {
            const BodyFaces &body_1 = order_.bodies[static_cast<std::size_t>(a)],
                            &body_2 = order_.bodies[static_cast<std::size_t>(b)];
            const auto begin_1 = static_cast<std::int32_t>(body_1.begin), begin_2 = static_cast<std::int32_t>(body_2.begin);
            const auto wanted = [&](std::int32_t i, std::int32_t j) {
                return is_candidate(faces, begin_1 + i, begin_2 + j);
            };
            for (const auto& [i, j] : pairs_of_boxes(body_1, body_2, part, wanted, list.size())) {
                const auto [face_1, face_2] = std::minmax({face_at(begin_1 + i), face_at(begin_2 + j)});
                list.push_back({face_1, face_2});
            }
        }
    }

    /// Pairs of boxes of two bodies, or of one with itself; `n_before` pairs are in the list already, and count.
    [[nodiscard]] std::vector<IndexPair> pairs_of_boxes(const BodyFaces& body_1, const BodyFaces& body_2,
                                                        const geometry::SearchPart& part, const geometry::PairFilter& wanted,
                                                        std::size_t n_before) const {
        geometry::SearchOptions options{options_.broad_phase, options_.limits, true};
        options.limits.pairs -= static_cast<std::int64_t>(n_before);
        try {
            if (&body_1 == &body_2) return geometry::overlapping_pairs_of_part<Dim>(part, options, boxes_of(body_1), wanted);
            return geometry::overlapping_pairs_of_part<Dim>(part, options, boxes_of(body_1), boxes_of(body_2), wanted);
        } catch (const geometry::SearchLimitError& error) {
            if (n_before == 0) throw;
            throw geometry::SearchLimitError(error.what() + std::string(" Beside them ") + std::to_string(n_before) +
                                                 " pairs of other bodies are in the list and count.",
                                             error.facts().value, error.facts().allowed);
        }
    }

    [[nodiscard]] std::int32_t face_at(std::int32_t i) const { return order_.faces[static_cast<std::size_t>(i)]; }

    template <class Faces>
    bool is_candidate(const Faces& faces, std::int32_t i, std::int32_t j) {
        const std::int32_t face_1 = face_at(i), face_2 = face_at(j);
        Counts& counts = counts_.local();
        ++counts.box_pairs;
        if (surface_.is_rigid(face_1) && surface_.is_rigid(face_2)) {
            ++counts.both_rigid;
            return false;
        }
        if (const PairVerdict verdict = faces.verdict(i, j, list_skin_); verdict != PairVerdict::may_touch) {
            ++(verdict == PairVerdict::not_facing ? counts.not_facing : counts.too_far_apart);
            return false;
        }
        if (surface_.body[face_1] != surface_.body[face_2]) return true;
        const bool is_left_out = (neighbours_ && (*neighbours_)(face_1, face_2)) ||
                                 (within_ != nullptr && *within_ && !(*within_)(face_1, face_2));
        if (is_left_out) ++counts.neighbours;
        return !is_left_out;
    }

    /// How many of these candidates half the skin would have found.
    template <class Faces>
    [[nodiscard]] std::int64_t count_at_half_skin(const Faces& faces, std::span<const IndexPair> candidates) {
        index_of_face_.resize(static_cast<std::size_t>(surface_.size()));
        for (std::size_t i = 0; i < order_.faces.size(); ++i)
            index_of_face_[static_cast<std::size_t>(order_.faces[i])] = static_cast<std::int32_t>(i);
        const double shrinkage = 0.5 * list_skin_ * faces.growth_per_skin();
        const auto remains = [&](const IndexPair& pair) {
            const std::int32_t i = index_of_face_[static_cast<std::size_t>(pair.first)];
            const std::int32_t j = index_of_face_[static_cast<std::size_t>(pair.second)];
            return boxes_[i].grown(-shrinkage).overlaps(boxes_[j]) &&
                   faces.verdict(i, j, 0.5 * list_skin_) == PairVerdict::may_touch;
        };
        return std::ranges::count_if(candidates, remains);
    }

    SurfaceView<Dim> surface_;
    CandidateOptions options_;
    SharedWork shared_;
    SkinChoice skin_;
    double list_skin_ = 0.0;
    bool list_holds_ = false;
    std::optional<Neighbours> neighbours_;
    const geometry::PairFilter* within_ = nullptr;  // of the present search
    std::span<const char> left_out_;                // of the present search
    double extent_ = 0.0;                           // of all surfaces at rest [m]
    TranslatedFaces<Dim> translated_;
    FaceOrder order_of_all_, order_;           // of all faces, and of those that may be in pairs
    bool has_new_order_ = false;               // `order_` is of another one
    std::vector<Box<Dim>> boxes_;              // in that order
    std::vector<std::int32_t> index_of_face_;  // in that order
    std::vector<IndexPair> candidates_;
    oneapi::tbb::enumerable_thread_specific<Counts> counts_;
    CandidateReport report_;
};

template <int Dim>
CandidateSearch<Dim>::CandidateSearch(SurfaceView<Dim> surface, const CandidateOptions& options, Sharing* sharing)
    : implementation_(std::make_unique<Implementation>(surface, options, sharing)) {}
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
void CandidateSearch<Dim>::search_moved(PointsView<Dim> x_0, PointsView<Dim> x_1, GapOf gap,
                                        const geometry::PairFilter& within, std::span<const char> left_out) {
    implementation_->search_moved(x_0, x_1, gap, within, left_out);
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
