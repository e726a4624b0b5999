#include "abut/contact/nodal_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/host_checks.hpp"
#include "abut/contact/law/pair_potential.hpp"
#include "abut/contact/messages.hpp"
#include "abut/contact/nodal_pairs.hpp"
#include "abut/contact/nodal_stable_step.hpp"
#include "abut/contact/nodal_store.hpp"
#include "abut/contact/report_counters.hpp"
#include "abut/contact/saved_contact.hpp"

namespace abut::contact {
namespace {

constexpr std::uint32_t state_version = 2;

}  // namespace

/// There y^2 (3 - 2 y) is a quarter: y = 1/2 - sin(10 degrees).
double quarter_weight_cosine(const geometry::FacingFade& facing) {
    return facing.none - 0.32635182233306964 * (facing.none - facing.full);
}

template <int Dim>
class NodalContact<Dim>::Implementation {
public:
    Implementation(NodalSurface<Dim>&& surface, NodalOptions&& options, Sharing* sharing)
        : surface_(std::move(surface)),
          options_(checked(std::move(options))),
          sharing_(sharing),
          sides_(surface_.facets().view()),
          candidates_(surface_.facets().view(), options_.search, sharing),
          pairs_(options_.facing, sharing),
          law_(options_.events, sharing) {
        find_least_force_size();
    }
    Implementation(const Implementation&) = delete;  // the search has a view of the surface

    const NodalStep<Dim>& step(PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take) {
        check_size(x_0);
        check_size(x_1);
        if (!list_holds_at(x_0) || !list_holds_at(x_1)) search(x_0, x_1);
        return step_listed(x_0, x_1, take);
    }

    const NodalStep<Dim>& step_listed(PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take) {
        require_list();
        report_.inadmissible_overlaps = law_.apply(surface_, sides_, pairs_, store_.memory(), x_0, x_1, take, step_);
        count_step(report_, step_, options_.compression_warning);
        if (step_.report.compression > options_.compression_limit) refuse_depth();
        return step_;
    }

    const NodalStep<Dim>& evaluate(PointsView<Dim> x) {
        check_size(x);
        if (list_holds_at(x) || !has_searched_) {
            if (!list_holds_) search(x, x);  // the run begins here
            return evaluate_listed(x);
        }
        evaluate_elsewhere(x);
        return step_;
    }

    const NodalStep<Dim>& evaluate_listed(PointsView<Dim> x) {
        require_list();
        law_.evaluate(surface_, pairs_, store_.memory(), x, step_);
        return step_;
    }

    [[nodiscard]] bool is_valid_for(double motion) const { return list_holds_ && candidates_.is_valid_for(motion); }

    void search(PointsView<Dim> x_0, PointsView<Dim> x_1) {
        check_size(x_0);
        check_size(x_1);
        if (!std::exchange(list_holds_, false)) pairs_.assign(surface_, store_.pairs());
        search_candidates(x_0, x_1);
        found_.clear();
        for (const auto& [facet_1, facet_2] : candidates_.candidates())
            if (const FacePair pair{SurfaceFace{facet_1}, SurfaceFace{facet_2}}; is_wanted(pair)) found_.push_back(pair);
        list_contacts(x_0);
        found_.insert(found_.end(), in_contact_.begin(), in_contact_.end());
        sort_unique(found_);

        pairs_.assign(surface_, found_, in_contact_, x_0, x_1, 0.5 * candidates_.skin(), options_.compression_limit);
        store_.follow(found_, [&](std::size_t i) { return PairMemory{is_admitted_at_first(pairs_.pairs()[i], x_0)}; });
        searched_at_.clear();
        for (const std::int32_t node : surface_.nodes()) searched_at_.push_back(x_0[node]);
        step_.nodes = pairs_.nodes();
        clear_step(pairs_, step_);
        new_facets_.clear();
        list_holds_ = has_searched_ = true;
        ++report_.rebuilds;
        report_.candidates = static_cast<std::int64_t>(found_.size());
        report_.candidates_max = std::max(report_.candidates_max, report_.candidates);
    }

    [[nodiscard]] const NodalStep<Dim>& last() const { return step_; }

    [[nodiscard]] NodalStableStep stable_step(std::span<const double> mass, double omega_free) const {
        return estimate_stable_step(surface_, mass, omega_free);
    }

    [[nodiscard]] std::vector<BlindCorner<Dim>> blind_corners() const {
        return contact::blind_corners<Dim>(surface_.facets().view(), quarter_weight_cosine(options_.facing));
    }

    [[nodiscard]] std::optional<EdgePair<Dim>> unseen_edges() const {
        return contact::unseen_edges<Dim>(surface_.facets().view(), quarter_weight_cosine(options_.facing));
    }

    [[nodiscard]] std::vector<std::byte> state() const {
        return saved(state_key(), {has_searched_, candidates_.next_skin(), report_, store_, new_facets_});
    }

    void restore(std::span<const std::byte> bytes) {
        SavedContact from = read_saved(state_key(), bytes);
        candidates_.restore_skin(from.next_skin);
        store_ = std::move(from.store);
        report_ = from.report;
        has_searched_ = from.has_searched;
        new_facets_ = std::move(from.new_faces);
        drop_list();
    }

    void surface_replaced(NodalSurface<Dim>&& surface, std::span<const std::int32_t> old_face_of) {
        PairStore store = carried_over(store_, surface_, surface, old_face_of);
        std::vector<std::int32_t> new_facets = facets_that_come(new_facets_, surface_, surface, old_face_of);
        CandidateSearch<Dim> candidates(surface.facets().view(), options_.search, sharing_);
        candidates.restore_skin(candidates_.next_skin());
        SideOutlines<Dim> sides(surface.facets().view());
        // The views of the new search are of arrays that stay where they are when the surface is moved.
        surface_ = std::move(surface);
        sides_ = std::move(sides);
        candidates_ = std::move(candidates);
        store_ = std::move(store);
        new_facets_ = std::move(new_facets);
        find_least_force_size();
        drop_list();
    }

    [[nodiscard]] const NodalSurface<Dim>& surface() const { return surface_; }
    [[nodiscard]] const ContactReport& report() const { return report_; }
    [[nodiscard]] const CandidateReport& search_report() const { return candidates_.report(); }
    [[nodiscard]] double skin() const { return candidates_.skin(); }

private:
    static NodalOptions checked(NodalOptions options) {
        if (options.search.self_contact)
            throw BadInput(
                "nodal contact: faces of one body do not touch each other; leave `self_contact` off, or number the "
                "parts of a body that may touch as bodies.");
        check_compression(options.compression_warning, options.compression_limit);
        const geometry::FacingFade& facing = options.facing;
        if (!(facing.full >= -1.0 && facing.full < facing.none && facing.none <= 0.0))
            throw BadInput("nodal contact: pairs fade out from n_1 . n_2 = " + number(facing.full) + " to " +
                           number(facing.none) +
                           "; -1 <= facing.full < facing.none <= 0 is needed. -0.6 and -0.2 are the "
                           "defaults.");
        // 1 would list what is near alone, not what is deep
        options.search.facing_cosine = CandidateOptions{}.facing_cosine;
        return options;
    }

    [[nodiscard]] StateKey state_key() const {
        return {"nodal contact " + std::to_string(Dim) + "D", state_version, fingerprint(surface_.facets().view()),
                surface_.facets().size()};
    }

    void check_size(PointsView<Dim> x) const {
        if (x.size() != surface_.n_nodes())
            throw BadInput("nodal contact: positions of " + std::to_string(x.size()) + " nodes are given, the surface has " +
                               std::to_string(surface_.n_nodes()) + "; give all nodes of the host.",
                           {.value = static_cast<double>(x.size()), .allowed = static_cast<double>(surface_.n_nodes())});
    }

    /// NaN where a node is not finite: no list holds for that, and the search says which node it is.
    [[nodiscard]] bool list_holds_at(PointsView<Dim> x) const {
        if (!list_holds_) return false;
        const auto nodes = surface_.nodes();
        return candidates_.is_valid_for(std::sqrt(largest(static_cast<std::ptrdiff_t>(nodes.size()), [&](std::ptrdiff_t i) {
            return (x[nodes[i]] - searched_at_[static_cast<std::size_t>(i)]).squaredNorm();
        })));
    }

    /// By a list of its own, of which nothing is left but its result: a pair that is out of reach at x must not lose what it
    /// remembers.
    void evaluate_elsewhere(PointsView<Dim> x) {
        const PairStore store = store_;
        const ContactReport report = report_;
        const double next_skin = candidates_.next_skin();
        const std::vector<std::int32_t> new_facets = new_facets_;
        const auto take_back = [&] {
            list_holds_ = false;
            store_ = store;
            new_facets_ = new_facets;
            report_ = report;
            candidates_.restore_skin(next_skin);
        };
        try {
            search(x, x);
            law_.evaluate(surface_, pairs_, store_.memory(), x, step_);
        } catch (...) {
            take_back();
            throw;
        }
        take_back();
    }

    void require_list() const {
        if (!list_holds_)
            throw Misuse(
                "nodal contact: there is no candidate list: call `search` first, and again after an error, a "
                "`restore` or a new surface.");
    }

    [[nodiscard]] bool is_wanted(const FacePair& pair) const {
        return !options_.wanted ||
               options_.wanted(surface_.face_of(number_of(pair.face_1)), surface_.face_of(number_of(pair.face_2)));
    }

    /// Pairs in contact stay in the list however deep they are.
    void list_contacts(PointsView<Dim> x_0) {
        in_contact_.clear();
        for (std::size_t p = 0; p < pairs_.pairs().size(); ++p) {
            const NodalPair<Dim>& pair = pairs_.pairs()[p];
            if (!store_.memory()[p].admitted || !is_wanted(store_.pairs()[p])) continue;
            const geometry::PairCorners<Dim> corners = pair.at(x_0);
            if (geometry::pair_placement<Dim>(corners, pair.law).place == geometry::PairPlace::unclear &&
                geometry::pair_state<Dim>(corners, pair.law).energy > 0.0)
                in_contact_.push_back(store_.pairs()[p]);
        }
    }

    [[nodiscard]] bool is_admitted_at_first(const NodalPair<Dim>& pair, PointsView<Dim> x_0) {
        const auto is_new = [&](std::int32_t facet) { return std::ranges::binary_search(new_facets_, facet); };
        const FirstAdmission first =
            decide_first<Dim>(pair, x_0, sides_, !has_searched_ || is_new(pair.facet_1) || is_new(pair.facet_2));
        if (first == FirstAdmission::missed) ++report_.missed_contacts;
        return first == FirstAdmission::admitted;
    }

    void find_least_force_size() {
        step_.least_force_size = 0;
        const Surface<Dim>& facets = surface_.facets();
        for (std::int32_t facet = 0; facet < facets.size(); ++facet)
            if (!surface_.is_rigid(facets.body[facet]))
                for (std::int32_t v = Dim * facet; v < Dim * (facet + 1); ++v)
                    step_.least_force_size = std::max(step_.least_force_size, facets.face_vertices[v] + 1);
    }

    void drop_list() {
        list_holds_ = false;
        pairs_.assign(surface_, {});
        step_.nodes.clear();
        clear_step(pairs_, step_);
    }

    [[noreturn]] void refuse_depth() const {
        const PairStep<Dim>& pair = step_.pairs[static_cast<std::size_t>(step_.report.most_compressed)];
        throw too_deep(name_of(pair.face_1), name_of(pair.face_2), pair, options_.compression_limit);
    }
    [[nodiscard]] std::string name_of(SurfaceFace face) const {
        const std::int32_t facet = surface_.facet_offsets()[static_cast<std::size_t>(face)];
        return face_name(surface_.facets().view(), facet, number_of(face));
    }

    /// The search knows facets, the host its faces.
    void search_candidates(PointsView<Dim> x_0, PointsView<Dim> x_1) {
        try {
            candidates_.search_moved(x_0, x_1);
        } catch (const Diverged& error) {
            ErrorFacts facts = error.facts();
            const auto facet = static_cast<std::int32_t>(facts.face_1);
            const SurfaceFace face = surface_.face_of(facet);
            const std::string of_facet = face_name(surface_.facets().view(), facet);
            std::string text = error.what();
            if (const auto at = text.find(of_facet); at != std::string::npos)
                text.replace(at, of_facet.size(), name_of(face));
            facts.face_1 = number_of(face);
            throw Diverged(text, facts);
        }
    }

    NodalSurface<Dim> surface_;
    NodalOptions options_;
    Sharing* sharing_;  // null: nobody shares the work
    SideOutlines<Dim> sides_;
    CandidateSearch<Dim> candidates_;
    bool has_searched_ = false;  // once at least: the run has begun
    bool list_holds_ = false;    // the last search came to its end
    NodalPairs<Dim> pairs_;
    PairStore store_;  // in the order of the pairs
    PairPotential<Dim> law_;
    std::vector<std::int32_t> new_facets_;  // that no search has seen yet, increasing: the run begins for them
    NodalStep<Dim> step_;
    ContactReport report_;
    std::vector<FacePair> found_;  // work arrays of `search`
    std::vector<FacePair> in_contact_;
    std::vector<Vector<Dim>> searched_at_;  // nodes of the surface where the last search began
};

void detail::check_force_size(std::int64_t given, std::int32_t needed) {
    if (given < needed)
        throw BadInput("nodal contact: forces of " + std::to_string(given) +
                           " nodes are given, and contact pushes nodes up to " + std::to_string(needed - 1) +
                           "; give one for each node of the deformable bodies.",
                       {.value = static_cast<double>(given), .allowed = static_cast<double>(needed)});
}

template <int Dim>
NodalContact<Dim>::NodalContact(NodalSurface<Dim> surface, NodalOptions options, Sharing* sharing)
    : implementation_(std::make_unique<Implementation>(std::move(surface), std::move(options), sharing)) {}
template <int Dim>
NodalContact<Dim>::~NodalContact() = default;
template <int Dim>
NodalContact<Dim>::NodalContact(NodalContact&&) noexcept = default;
template <int Dim>
NodalContact<Dim>& NodalContact<Dim>::operator=(NodalContact&&) noexcept = default;

template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::step(PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take) {
    return implementation_->step(x_0, x_1, take);
}
template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::evaluate(PointsView<Dim> x) {
    return implementation_->evaluate(x);
}
template <int Dim>
bool NodalContact<Dim>::is_valid_for(double motion) const {
    return implementation_->is_valid_for(motion);
}
template <int Dim>
void NodalContact<Dim>::search(PointsView<Dim> x_0, PointsView<Dim> x_1) {
    implementation_->search(x_0, x_1);
}
template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::step_listed(PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take) {
    return implementation_->step_listed(x_0, x_1, take);
}
template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::evaluate_listed(PointsView<Dim> x) {
    return implementation_->evaluate_listed(x);
}
template <int Dim>
const NodalStep<Dim>& NodalContact<Dim>::last() const {
    return implementation_->last();
}
template <int Dim>
NodalStableStep NodalContact<Dim>::stable_step(std::span<const double> mass, double omega_free) const {
    return implementation_->stable_step(mass, omega_free);
}
template <int Dim>
std::vector<BlindCorner<Dim>> NodalContact<Dim>::blind_corners() const {
    return implementation_->blind_corners();
}
template <int Dim>
std::optional<EdgePair<Dim>> NodalContact<Dim>::unseen_edges() const {
    return implementation_->unseen_edges();
}
template <int Dim>
std::vector<std::byte> NodalContact<Dim>::state() const {
    return implementation_->state();
}
template <int Dim>
void NodalContact<Dim>::restore(std::span<const std::byte> state) {
    implementation_->restore(state);
}
template <int Dim>
void NodalContact<Dim>::surface_replaced(NodalSurface<Dim> surface, std::span<const std::int32_t> old_face_of) {
    implementation_->surface_replaced(std::move(surface), old_face_of);
}
template <int Dim>
const NodalSurface<Dim>& NodalContact<Dim>::surface() const {
    return implementation_->surface();
}
template <int Dim>
const ContactReport& NodalContact<Dim>::report() const {
    return implementation_->report();
}
template <int Dim>
const CandidateReport& NodalContact<Dim>::search_report() const {
    return implementation_->search_report();
}

template <int Dim>
double NodalContact<Dim>::skin() const {
    return implementation_->skin();
}

template class NodalContact<2>;
template class NodalContact<3>;

}  // namespace abut::contact
