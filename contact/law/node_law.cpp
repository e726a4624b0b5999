#include "abut/contact/law/node_law.hpp"

#include <algorithm>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/contact/messages.hpp"

namespace abut::contact {
namespace {

/// Of each body.
template <int Dim>
std::vector<char> touches_itself(const NodalSurface<Dim>& surface, const CandidateOptions& search) {
    std::vector<char> touches(static_cast<std::size_t>(surface.n_bodies()), search.self_contact ? 1 : 0);
    for (std::int32_t body = 0; body < surface.n_bodies(); ++body)
        if (surface.is_rigid(body)) touches[static_cast<std::size_t>(body)] = 0;
    for (const auto& [body_1, body_2] : search.ignored_bodies)
        if (body_1 == body_2 && body_1 < surface.n_bodies()) touches[static_cast<std::size_t>(body_1)] = 0;
    return touches;
}

}  // namespace

template <int Dim>
NodeLaw<Dim>::NodeLaw(NodalSurface<Dim> surface, const NodalOptions& options, Sharing* sharing)
    : surface_(std::move(surface)),
      options_(options),
      sharing_(sharing),
      sides_(surface_.facets().view()),
      inside_(surface_.facets().view(), touches_itself(surface_, options_.search)),
      pairs_(options_.facing, options_.friction, sharing),
      law_(options_.events, options_.friction, sharing) {
    const Surface<Dim>& facets = surface_.facets();
    for (std::int32_t facet = 0; facet < facets.size(); ++facet)
        if (!surface_.is_rigid(facets.body[facet]))
            for (std::int32_t v = Dim * facet; v < Dim * (facet + 1); ++v)
                least_force_size_ = std::max(least_force_size_, facets.face_vertices[v] + 1);
}

template <int Dim>
std::string NodeLaw<Dim>::face_name(Face face) const {
    const std::int32_t facet = surface_.facet_offsets()[static_cast<std::size_t>(face)];
    return contact::face_name(facets(), facet, number_of(face));
}

/// The search knows facets, the host its faces.
template <int Dim>
void NodeLaw<Dim>::search(CandidateSearch<Dim>& candidates, State x_0, State x_1) const {
    try {
        candidates.search_moved(x_0, x_1);
    } catch (const Diverged& error) {
        ErrorFacts facts = error.facts();
        const auto facet = static_cast<std::int32_t>(facts.face_1);
        const Face face = surface_.face_of(Facet{facet});
        const std::string of_facet = contact::face_name(facets(), facet);
        std::string text = error.what();
        if (const auto at = text.find(of_facet); at != std::string::npos) text.replace(at, of_facet.size(), face_name(face));
        facts.face_1 = number_of(face);
        throw Diverged(text, facts);
    }
}

template <int Dim>
void NodeLaw<Dim>::list(std::vector<FacetPair>& pairs, std::span<const FacetPair> in_contact, State x_0, State x_1,
                        double reach) {
    watched_.clear();
    if (!inside_.empty()) set_inside_pairs_apart(pairs, x_0, x_1, reach);
    pairs_.assign(surface_, pairs, in_contact, watched_, x_0, x_1, reach, options_.compression_limit);
}

/// Takes the pairs that lie inside out of `pairs`. Watched are those so shallow that they can come out while the list is
/// valid; all others are looked at when the next list is made.
template <int Dim>
void NodeLaw<Dim>::set_inside_pairs_apart(std::vector<FacetPair>& pairs, State x_0, State x_1, double reach) {
    std::erase_if(pairs, [&](const FacetPair& facets) {
        if (!inside_.has(facets)) return false;
        const NodalPair<Dim> pair = pairs_.make_pair(surface_, facets);
        const geometry::PairCorners<Dim> start = pair.at(x_0), end = pair.at(x_1);
        const auto state = geometry::pair_state<Dim>(start, pair.law);
        if (is_outside(state, outside_gap(this->facets(), facets))) {
            inside_.take_away(facets);
            return false;
        }
        double farthest = reach;
        for (std::size_t v = 0; v < start.size(); ++v) farthest = std::max(farthest, (end[v] - start[v]).norm());
        if (std::isfinite(state.gap) && state.gap >= -2.0 * farthest) watched_.push_back(pair);
        return true;
    });
}

/// Whether a pair that is no contact since it lay inside has come out at the end of a step: it needs another list.
template <int Dim>
bool NodeLaw<Dim>::sees_from_outside(const Path& path) {
    bool any = false;
    for (const NodalPair<Dim>& pair : watched_) {
        const FacetPair of_facets{Facet{pair.facet_1}, Facet{pair.facet_2}};
        const auto state = geometry::pair_state<Dim>(pair.at(path.x_1), pair.law);
        if (!is_outside(state, outside_gap(facets(), of_facets)) || !inside_.has(of_facets)) continue;
        inside_.take_away(of_facets);
        any = true;
    }
    return any;
}

/// A pair of one body that is pressed in when the run begins lies inside of it.
template <int Dim>
FirstAdmission NodeLaw<Dim>::decide_first(std::size_t p, State x, bool run_begins) const {
    const NodalPair<Dim>& pair = pairs_.pairs()[p];
    if (pair.body_1 != pair.body_2) return contact::decide_first<Dim>(pair, x, sides_, run_begins);
    const geometry::PairCorners<Dim> corners = pair.at(x);
    const auto state = geometry::pair_state<Dim>(corners, pair.law);
    const bool is_seen = is_outside(state, outside_gap(facets(), FacetPair{Facet{pair.facet_1}, Facet{pair.facet_2}}));
    if (state.energy > 0.0 && !is_seen)
        return run_begins ? FirstAdmission::not_admitted
                          : first_admission(state.gap > -pair.admission_depth, true, run_begins);
    return may_touch<Dim>(pair, corners, state, sides_) ? FirstAdmission::admitted : FirstAdmission::not_admitted;
}

template <int Dim>
bool NodeLaw<Dim>::is_pressed_in(std::size_t p, State x) const {
    const NodalPair<Dim>& pair = pairs_.pairs()[p];
    const geometry::PairCorners<Dim> corners = pair.at(x);
    return geometry::pair_placement<Dim>(corners, pair.law).place == geometry::PairPlace::unclear &&
           geometry::pair_state<Dim>(corners, pair.law).energy > 0.0;
}

template <int Dim>
void NodeLaw<Dim>::clear(NodalStep<Dim>& step) const {
    step.nodes = pairs_.nodes();
    step.least_force_size = least_force_size_;
    step.friction.clear();
    clear_step(pairs_, step);
}

template <int Dim>
std::int64_t NodeLaw<Dim>::step(double dt, const Path& path, std::span<PairMemory> memory, FacetStore& facets,
                                NodalStep<Dim>& step) {
    return law_.apply(surface_, sides_, pairs_, memory, facets, dt, path.x_0, path.x_1, path.take, step);
}

template <int Dim>
void NodeLaw<Dim>::evaluate(State x, std::span<const PairMemory> memory, const FacetStore& facets, NodalStep<Dim>& step) {
    law_.evaluate(surface_, pairs_, memory, facets, x, step);
}

template class NodeLaw<2>;
template class NodeLaw<3>;

}  // namespace abut::contact
