#pragma once
// Private to the layer.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/contact/engine/report_counters.hpp"
#include "abut/contact/engine/saved_contact.hpp"
#include "abut/contact/host_checks.hpp"
#include "abut/contact/law/engine_law.hpp"
#include "abut/contact/pair_store.hpp"
#include "abut/contact/pairs/admission.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/contact/sharing.hpp"
#include "abut/contact/step.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/contact/surface/facet_store.hpp"

namespace abut::contact {

/// Bounds on |g|/D [-].
struct CompressionLimits {
    double warning;
    double limit;
};

/// Error for a pair that is pressed in deeper than a host allows.
template <int Dim>
[[nodiscard]] TooDeep too_deep(const std::string& face_1, const std::string& face_2, const PairStep<Dim>& pair,
                               double limit) {
    return TooDeep(
        "contact: " + face_1 + " and " + face_2 + " are pressed " + number(pair.compression) +
            " times the depth of their cells into each other, " + number(limit) +
            " is allowed (compression_limit). Refine the mesh at the contact, or lower the speed or the load.",
        {.face_1 = number_of(pair.face_1), .face_2 = number_of(pair.face_2), .value = pair.compression, .allowed = limit});
}

/// All that contact has in common, whatever the law: how long a candidate list is valid, the search, which pairs stay listed
/// and what they remember, their first admission, memory of facets, limits, the report, saving and restoring, and another
/// surface.
template <EngineLaw Law>
class Engine {
public:
    using State = typename Law::State;
    using Path = typename Law::Path;
    using Step = typename Law::Step;

    /// `sharing` must outlive the engine; null: nobody shares the work. Throws as CandidateSearch.
    Engine(Law law, const CandidateOptions& search, const CompressionLimits& limits, Sharing* sharing)
        : law_(std::move(law)),
          search_options_(search),
          limits_(limits),
          sharing_(sharing),
          candidates_(law_.facets(), search, sharing),
          facets_(law_.facets().size(), law_.facet_memory()) {
        law_.clear(step_);
    }
    Engine(const Engine&) = delete;  // the search has a view of the surface
    Engine& operator=(const Engine&) = delete;

    [[nodiscard]] const Law& law() const { return law_; }
    [[nodiscard]] const Step& last() const { return step_; }
    [[nodiscard]] const PairStore& pairs() const { return pairs_; }
    [[nodiscard]] const FacetStore& facets() const { return facets_; }
    [[nodiscard]] const ContactReport& report() const { return report_; }
    [[nodiscard]] const CandidateReport& search_report() const { return candidates_.report(); }
    [[nodiscard]] double skin() const { return candidates_.skin(); }

    // The list

    [[nodiscard]] bool has_list() const { return list_is_valid_; }
    [[nodiscard]] bool has_searched() const { return has_searched_; }
    [[nodiscard]] bool is_valid_for(double motion) const { return list_is_valid_ && candidates_.is_valid_for(motion); }
    /// False, too, where something is not finite: then a search says what it is.
    [[nodiscard]] bool is_valid_at(const State& state) const {
        return list_is_valid_ && candidates_.is_valid_for(std::sqrt(largest(law_.n_watched(), [&](std::ptrdiff_t i) {
            return (law_.position(state, i) - searched_at_[static_cast<std::size_t>(i)]).squaredNorm();
        }))) && !has_turned(state);
    }
    void require_list() const {
        if (!list_is_valid_)
            throw Misuse(law_.name() +
                         ": there is no candidate list: call `search` first, and again after an error, a `restore` or a "
                         "new surface.");
    }

    /// Makes a new list for a step between two states. `listed`: called with the law when its pairs
    /// are listed.
    template <class Listed>
    void search(const State& start, const State& end, const Listed& listed) {
        if (!std::exchange(list_is_valid_, false)) law_.list_remembered(pairs_.pairs());
        law_.search(candidates_, start, end);
        found_.clear();
        std::vector<FacetPair> not_seen;  // increasing, as candidates are
        for (const auto& [facet_1, facet_2] : candidates_.candidates()) {
            const FacetPair pair{Facet{facet_1}, Facet{facet_2}};
            const bool is_wanted = law_.is_wanted(pair);
            if (is_wanted) found_.push_back(pair);
            if (!is_wanted || was_kept_apart(pair)) not_seen.push_back(pair);
        }
        keep_contacts(start);
        law_.list(found_, in_contact_, start, std::max(0.5 * candidates_.skin(), candidates_.report().motion));
        pairs_.follow(found_, [&](std::size_t i) { return memory_at_first(i, start); });
        kept_apart_.clear();
        std::ranges::set_difference(not_seen, found_, std::back_inserter(kept_apart_));
        take_covered();
        if constexpr (LawWithMemory<Law>) law_.set_born_offsets(pairs_.memory());
        law_.clear(step_);
        listed(law_);
        searched_at_.clear();
        for (std::ptrdiff_t i = 0; i < law_.n_watched(); ++i) searched_at_.push_back(law_.position(start, i));
        new_facets_.clear();
        list_is_valid_ = has_searched_ = true;
        ++report_.rebuilds;
        report_.candidates = pairs_.size();
        report_.candidates_max = std::max(report_.candidates_max, report_.candidates);
    }

    /// Ends the list: others may be wanted now.
    void end_list() { list_is_valid_ = false; }

    // Contact, with the list as it is

    /// `dt`: length of the step [s].
    const Step& step(double dt, const Path& path) {
        check_step_length(dt);
        require_list();
        facets_.begin_step();
        report_.inadmissible_overlaps = law_.step(dt, path, pairs_.memory(), facets_, step_);
        count_step(report_, step_, limits_.warning);
        if (step_.report.compression > limits_.limit) refuse_depth();
        count_friction(report_, step_.report.friction, dt);
        facets_.end_step();
        if constexpr (LawWithMemory<Law>) {
            law_.end_step(dt);
            if (law_.sees_from_outside(path)) list_is_valid_ = false;
        }
        return step_;
    }

    template <class At>
    const Step& evaluate(const At& at) {
        require_list();
        law_.evaluate(at, pairs_.memory(), facets_, step_);
        return step_;
    }

    /// By a list of its own, of which nothing is left but its result: a pair that is out of reach there must not lose
    /// what it remembers.
    const Step& evaluate_elsewhere(const State& state) {
        const PairStore pairs = pairs_;
        const ContactReport report = report_;
        const double next_skin = candidates_.next_skin();
        const std::vector<Facet> new_facets = new_facets_;
        const std::vector<FacetPair> kept_apart = kept_apart_;
        const std::vector<Facet> covered = covered_;
        const LawMemory memory = law_memory();
        const auto take_back = [&] {
            list_is_valid_ = false;
            pairs_ = pairs;
            new_facets_ = new_facets;
            kept_apart_ = kept_apart;
            covered_ = covered;
            set_law_memory(memory);
            report_ = report;
            candidates_.restore_skin(next_skin);
        };
        try {
            search(state, state, [](Law&) {});
            evaluate(state);
        } catch (...) {
            take_back();
            throw;
        }
        take_back();
        return step_;
    }

    // From one run or surface to another

    /// A run begins: its report does, while pairs and facets remember what they do.
    void clear_report() { report_ = {}; }

    [[nodiscard]] std::vector<std::byte> state() const {
        return saved(state_key(), {has_searched_, candidates_.next_skin(), report_, pairs_, facets_, new_facets_,
                                   kept_apart_, covered_, law_memory()});
    }

    void restore(std::span<const std::byte> bytes) {
        SavedContact from = read_saved(state_key(), bytes);
        set_law_memory(from.law);
        candidates_.restore_skin(from.next_skin);
        pairs_ = std::move(from.pairs);
        facets_ = std::move(from.facets);
        report_ = from.report;
        has_searched_ = from.has_searched;
        new_facets_ = std::move(from.new_facets);
        kept_apart_ = std::move(from.kept_apart);
        covered_ = std::move(from.covered);
        drop_list();
    }

    /// Goes on where another engine has stopped, with the law and the surface of this one. `old_of_new`: of each facet
    /// its number there, -1 for one that was not there; for pairs of that one the run begins. Throws BadInput, and
    /// stays as it is, where the laws remember other things.
    void take_over(const Engine& before, std::span<const std::int32_t> old_of_new) {
        if (facets_.size() != before.facets_.size())
            throw BadInput(law_.name() + ": its facets remember " + std::to_string(facets_.size()) +
                           " numbers each, and those that it takes over " + std::to_string(before.facets_.size()) +
                           ". Give both the same laws of friction.");
        PairStore pairs = before.pairs_.carried_over(
            old_of_new, [&, facets = law_.facets()](FacetPair pair) { return may_touch(facets, pair); });
        FacetStore facets = before.facets_.carried_over(old_of_new);
        std::vector<Facet> new_facets;
        for (std::size_t i = 0; i < old_of_new.size(); ++i)
            if (old_of_new[i] < 0 || before.is_new(Facet{old_of_new[i]})) new_facets.push_back(Facet(i));
        std::vector<FacetPair> kept_apart = carried_over(before.kept_apart_, old_of_new, [](FacetPair) { return true; });
        std::vector<Facet> covered;
        for (std::size_t i = 0; i < old_of_new.size(); ++i)
            if (old_of_new[i] >= 0 && before.was_covered(Facet{old_of_new[i]})) covered.push_back(Facet(i));
        take_over_law_memory(before, old_of_new);
        candidates_.restore_skin(before.candidates_.next_skin());
        report_ = before.report_;
        report_.friction_dissipated += before.law_.stored_energy(before.facets_) - law_.stored_energy(facets);
        has_searched_ = before.has_searched_;
        pairs_ = std::move(pairs);
        facets_ = std::move(facets);
        new_facets_ = std::move(new_facets);
        kept_apart_ = std::move(kept_apart);
        covered_ = std::move(covered);
        drop_list();
    }

    /// Goes on with a law on another surface, as an engine that takes over this one.
    void replace(Law law, std::span<const std::int32_t> old_of_new) {
        Engine next(std::move(law), search_options_, limits_, sharing_);
        next.take_over(*this, old_of_new);
        // The views of the new search are of arrays that stay where they are when the law is moved.
        law_ = std::move(next.law_);
        candidates_ = std::move(next.candidates_);
        pairs_ = std::move(next.pairs_);
        facets_ = std::move(next.facets_);
        new_facets_ = std::move(next.new_facets_);
        kept_apart_ = std::move(next.kept_apart_);
        covered_ = std::move(next.covered_);
        report_ = next.report_;
        drop_list();
    }

private:
    [[nodiscard]] bool has_turned(const State& state) const {
        if constexpr (LawWithMemory<Law>) return law_.has_turned(state);
        return false;
    }
    [[nodiscard]] LawMemory law_memory() const {
        if constexpr (LawWithMemory<Law>) return law_.memory();
        return {};
    }
    void set_law_memory([[maybe_unused]] const LawMemory& memory) {
        if constexpr (LawWithMemory<Law>) law_.set_memory(memory);
    }
    /// Pairs whose facets have got other numbers, as PairStore::carried_over.
    [[nodiscard]] static std::vector<FacetPair> carried_over(std::span<const FacetPair> pairs,
                                                             std::span<const std::int32_t> old_of_new,
                                                             const std::function<bool(FacetPair)>& is_kept) {
        PairStore store;
        store.follow(pairs, [](std::size_t) { return PairMemory{}; });
        store = store.carried_over(old_of_new, is_kept);
        return {store.pairs().begin(), store.pairs().end()};
    }
    /// Pairs that were seen from outside keep that where they lie inside of a body of this surface, too.
    void take_over_law_memory(const Engine& before, std::span<const std::int32_t> old_of_new) {
        if constexpr (LawWithMemory<Law>) {
            LawMemory memory = before.law_.memory();
            memory.seen = carried_over(memory.seen, old_of_new, [&](FacetPair pair) { return law_.lies_inside(pair); });
            law_.set_memory(memory);
        }
    }

    /// Pairs in contact stay in the list however deep they are.
    void keep_contacts(const State& start) {
        in_contact_.clear();
        for (std::size_t p = 0; p < pairs_.pairs().size(); ++p)
            if (const FacetPair pair = pairs_.pairs()[p];
                pairs_.memory()[p].admitted && law_.is_wanted(pair) && law_.is_pressed_in(p, start))
                in_contact_.push_back(pair);
        found_.insert(found_.end(), in_contact_.begin(), in_contact_.end());
        sort_unique(found_);
    }

    /// Bodies may have become one, or rigid.
    [[nodiscard]] bool may_touch(const SurfaceView<Law::dimension>& facets, FacetPair pair) const {
        const std::int32_t facet_1 = number_of(pair.facet_1), facet_2 = number_of(pair.facet_2);
        return (search_options_.self_contact || facets.body[facet_1] != facets.body[facet_2]) &&
               !(facets.is_rigid(facet_1) && facets.is_rigid(facet_2));
    }

    [[nodiscard]] bool was_covered(Facet facet) const { return std::ranges::binary_search(covered_, facet); }
    /// Whether a host did not want the pair until now, though it could be near.
    [[nodiscard]] bool was_kept_apart(FacetPair pair) const {
        return std::ranges::binary_search(kept_apart_, pair) || was_covered(pair.facet_1) || was_covered(pair.facet_2);
    }
    void take_covered() {
        covered_.clear();
        if constexpr (LawWithMemory<Law>)
            for (std::int32_t facet = 0; facet < law_.facets().size(); ++facet)
                if (law_.is_covered(Facet{facet})) covered_.push_back(Facet{facet});
    }

    [[nodiscard]] bool is_new(Facet facet) const { return std::ranges::binary_search(new_facets_, facet); }

    /// A pair that a host has kept apart until now may be pressed in; any other one should have been seen before.
    [[nodiscard]] PairMemory memory_at_first(std::size_t i, const State& start) {
        const auto [facet_1, facet_2] = found_[i];
        const FirstLook first = law_.decide_first(i, start, !has_searched_ || is_new(facet_1) || is_new(facet_2));
        if (first.admission != FirstAdmission::missed) return {.admitted = first.admission == FirstAdmission::admitted};
        if (was_kept_apart(found_[i])) return {.admitted = true, .offset = first.idle_overlap};
        ++report_.missed_contacts;
        return {};
    }

    [[nodiscard]] StateKey state_key() const {
        const auto facets = law_.facets();
        return {law_.name() + " " + std::to_string(Law::dimension) + "D", fingerprint(facets), facets.size(),
                facets_.size()};
    }

    void drop_list() {
        list_is_valid_ = false;
        law_.drop_list();
        law_.clear(step_);
    }

    [[noreturn]] void refuse_depth() {
        const auto& pair = step_.pairs[static_cast<std::size_t>(step_.report.most_compressed)];
        throw too_deep(law_.face_name(pair.face_1), law_.face_name(pair.face_2), pair, limits_.limit);
    }

    Law law_;
    CandidateOptions search_options_;
    CompressionLimits limits_;
    Sharing* sharing_;  // null: nobody shares the work
    CandidateSearch<Law::dimension> candidates_;
    bool has_searched_ = false;   // once at least: the run has begun
    bool list_is_valid_ = false;  // the last search came to its end
    PairStore pairs_;             // in the order of the list
    FacetStore facets_;
    std::vector<Facet> new_facets_;      // that no search has seen yet, increasing: the run begins for them
    std::vector<FacetPair> kept_apart_;  // candidates that were not wanted, and in no list since then, increasing
    std::vector<Facet> covered_;         // that the last search left out, since nothing could touch them, increasing
    Step step_;
    ContactReport report_;
    std::vector<FacetPair> found_;  // work arrays of `search`
    std::vector<FacetPair> in_contact_;
    std::vector<Vector<Law::dimension>> searched_at_;  // points that are watched, where the last search began
};

}  // namespace abut::contact
