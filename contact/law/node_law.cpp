#include "abut/contact/law/node_law.hpp"

#include <algorithm>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/base/ids.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/contact/law/engine_law.hpp"
#include "abut/contact/pairs/pair.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/geometry/pair_potential/pair_facing.hpp"

namespace abut::contact {

static_assert(LawWithMemory<NodeLaw<2>> && LawWithMemory<NodeLaw<3>>);

namespace {

// Of two facets of one body: by how much n_1 . n_2 changes while a list is valid, and by how much n turns [rad].
constexpr double turns_at_most = 0.1;
constexpr double turns_in_all = 0.2;
/// The turn of a facet of a body that touches itself at which a list ends [rad]: two of them change n_1 . n_2 by
/// `turns_at_most`.
constexpr double turn_of_list = 0.05;

/// Pieces within which facets may lie inside of each other at rest: those that are given, and bodies that touch
/// themselves; -1 of all others (n_bodies).
template <int Dim>
std::vector<std::int32_t> pieces_of(const NodalSurface<Dim>& surface, const NodalOptions& options) {
    const std::int32_t n = surface.n_bodies();
    std::vector<std::int32_t> pieces(static_cast<std::size_t>(n));
    for (std::int32_t body = 0; body < n; ++body)
        pieces[static_cast<std::size_t>(body)] = options.search.self_contact && !surface.is_rigid(body) ? body : -1;
    for (const auto& [body_1, body_2] : options.search.ignored_bodies)
        if (body_1 == body_2 && body_1 < n) pieces[static_cast<std::size_t>(body_1)] = -1;
    for (std::size_t body = 0; body < options.pieces.size(); ++body)
        if (options.pieces[body] >= 0) pieces[body] = n + options.pieces[body];
    return pieces;
}

}  // namespace

template <int Dim>
NodeLaw<Dim>::NodeLaw(BevelledSurface<Dim> surface, const NodalOptions& options, Sharing* sharing)
    : surface_(std::move(surface)),
      options_(options),
      sharing_(sharing),
      sides_(acting().facets().view()),
      inside_(acting().facets().view(), pieces_of(acting(), options_)),
      watched_(options_.facing.none),
      pairs_(options_.facing, options_.friction, options_.interference, sharing),
      ramps_(options_.interference),
      looks_away_(std::cos(std::acos(std::clamp(options_.facing.none, -1.0, 1.0)) - turns_in_all)),
      law_({.events = options_.events, .gauss = options_.gauss}, options_.friction, sharing) {
    const Surface<Dim>& facets = surface_.host().facets();
    for (std::int32_t facet = 0; facet < facets.size(); ++facet)
        if (!surface_.host().is_rigid(facets.body[facet]))
            for (std::int32_t v = Dim * facet; v < Dim * (facet + 1); ++v)
                least_force_size_ = std::max(least_force_size_, facets.face_vertices[v] + 1);
}

template <int Dim>
std::string NodeLaw<Dim>::face_name(Face face) const {
    const std::int32_t facet = acting().facet_offsets()[static_cast<std::size_t>(face)];
    return contact::face_name(facets(), facet, number_of(face));
}

/// The search knows facets, the host its faces.
template <int Dim>
void NodeLaw<Dim>::search(CandidateSearch<Dim>& candidates, State x_0, State x_1) {
    geometry::PairFilter within;
    if (options_.search.self_contact) {
        place_facets(x_0, at_start_);
        place_facets(x_1, at_end_);
        const double in_step = std::sqrt(
            largest(n_watched(), [&](std::ptrdiff_t i) { return (position(x_1, i) - position(x_0, i)).squaredNorm(); }));
        within = [this, reach = std::max(0.5 * candidates.next_skin(), in_step)](std::int32_t facet_1,
                                                                                 std::int32_t facet_2) {
            const FacetPair pair{Facet{std::min(facet_1, facet_2)}, Facet{std::max(facet_1, facet_2)}};
            return may_come_together(pair, at_start_, reach) || may_come_together(pair, at_end_, reach);
        };
    }
    covered_.clear();
    if (options_.covered)
        for (std::int32_t facet = 0; facet < facets().size(); ++facet)
            covered_.push_back(options_.covered(acting().face_of(Facet{facet})) ? 1 : 0);
    try {
        candidates.search_moved(x_0, x_1, GapOf::overlap, within, covered_);
    } catch (const Diverged& error) {
        ErrorFacts facts = error.facts();
        const auto facet = static_cast<std::int32_t>(facts.face_1);
        const Face face = acting().face_of(Facet{facet});
        const std::string of_facet = contact::face_name(facets(), facet);
        std::string text = error.what();
        if (const auto at = text.find(of_facet); at != std::string::npos) text.replace(at, of_facet.size(), face_name(face));
        facts.face_1 = number_of(face);
        throw Diverged(text, facts);
    }
}

template <int Dim>
Vector<Dim> NodeLaw<Dim>::normal_of(std::int32_t facet, State x) const {
    const auto corners = facets().vertices_of(facet);
    const Vector<Dim> a = x[corners[1]] - x[corners[0]];
    if constexpr (Dim == 2)
        return Vector<2>(a[1], -a[0]).normalized();
    else
        return moment<3>(a, x[corners[2]] - x[corners[0]]).normalized();
}

template <int Dim>
void NodeLaw<Dim>::place_facets(State x, PlacedFacets& placed) {
    const std::int32_t n = facets().size();
    placed.middle.resize(static_cast<std::size_t>(n));
    placed.normal.resize(placed.middle.size());
    if (radius_.empty())
        for (std::int32_t facet = 0; facet < n; ++facet) radius_.push_back(circumradius(facets(), facet));
    parallel_each(
        n,
        [&](std::ptrdiff_t facet) {
            const auto corners = facets().vertices_of(static_cast<std::int32_t>(facet));
            Vector<Dim> sum = Vector<Dim>::Zero();
            for (const std::int32_t v : corners) sum += x[v];
            placed.middle[facet] = sum / Dim;
            placed.normal[facet] = normal_of(static_cast<std::int32_t>(facet), x);
        },
        1024);
}

template <int Dim>
bool NodeLaw<Dim>::has_turned(State x) const {
    if (!options_.search.self_contact) return false;
    const double turned = largest(facets().size(), [&](std::ptrdiff_t facet) {
        return (normal_of(static_cast<std::int32_t>(facet), x) - at_start_.normal[static_cast<std::size_t>(facet)])
            .squaredNorm();
    });
    return !(turned <= turn_of_list * turn_of_list);
}

/// Two facets of one body, when no corner moves by more than `reach`. They are neighbours on its surface, and turn little
/// against each other while a list is valid: those that look too much the same way, and those that are far above, behind
/// or beside each other seen along n, come together after the next search at the earliest. What has a mark comes out only
/// if it is shallow and the facets look at each other.
template <int Dim>
bool NodeLaw<Dim>::may_come_together(FacetPair pair, const PlacedFacets& placed, double reach) const {
    const auto& [middle, normal] = placed;
    const auto facet_1 = static_cast<std::size_t>(pair.facet_1), facet_2 = static_cast<std::size_t>(pair.facet_2);
    const double facing = normal[facet_1].dot(normal[facet_2]);
    if (facing > looks_away_) return false;
    const Vector<Dim> between = middle[facet_2] - middle[facet_1];
    const double height = between.dot((normal[facet_1] - normal[facet_2]).normalized()), distance = between.norm();
    const double sizes = radius_[facet_1] + radius_[facet_2], turned = turns_in_all * distance;
    const double tilt = std::sqrt(std::max(0.0, 0.5 * (1.0 + facing))), slack = 2.0 * reach + tilt * sizes;
    if (height > slack + turned) return false;
    const double aside = 2.0 * reach + sizes + turned;
    if (distance * distance - height * height > aside * aside) return false;
    if (inside_.has(pair)) return height >= -slack && facing <= options_.facing.none + turns_at_most;
    return height >= -(slack + turned + facets().cell_depth[facet_1] + facets().cell_depth[facet_2]);
}

/// Whether a pair has come out of its body: the facets look at each other, and none is behind the other one.
template <int Dim>
bool NodeLaw<Dim>::is_seen_from_outside(const NodalPair<Dim>& pair, State x) const {
    const geometry::PairCorners<Dim> corners = pair.at(x);
    if (geometry::pair_facing<Dim>(corners) >= options_.facing.none) return false;
    const auto state = geometry::pair_state<Dim>(corners, pair.law);
    return inside_gap<Dim>(corners, state) >= outside_gap(facets(), FacetPair{Facet{pair.facet_1}, Facet{pair.facet_2}});
}

template <int Dim>
void NodeLaw<Dim>::list(std::vector<FacetPair>& pairs, std::span<const FacetPair> in_contact, State x_0, double reach) {
    watched_.clear();
    if (!inside_.empty()) set_inside_pairs_apart(pairs, x_0);
    pairs_.assign(surface_, pairs, in_contact, watched_.pairs(), x_0, reach, options_.compression_limit);
    if (ramps_.any() && !ramps_.has_begun()) begin_interference(x_0);
}

/// Facets that look at each other overlap by less than D, else they could be far sides of their bodies.
template <int Dim>
void NodeLaw<Dim>::begin_interference(State x_0) {
    std::vector<double> overlaps(options_.interference.times.size(), 0.0);
    std::vector<const NodalPair<Dim>*> deeper(overlaps.size(), nullptr);
    for (const NodalPair<Dim>& pair : pairs_.pairs()) {
        if (pair.interference < 0) continue;
        const auto which = static_cast<std::size_t>(pair.interference);
        const auto state = geometry::pair_state<Dim>(pair.at(x_0), pair.law);
        if (state.energy <= 0.0) continue;
        if (-state.gap < pair.admission_depth) {
            overlaps[which] = std::max(overlaps[which], -state.gap);
        } else if (-state.gap >= 2.0 * pair.admission_depth) {
            deeper[which] = &pair;
        } else if (-state.gap < 2.0 * pair.admission_depth) {
            const Face face_1 = acting().face_of(Facet{pair.facet_1}), face_2 = acting().face_of(Facet{pair.facet_2});
            throw BadInput("interference: " + face_name(face_1) + " and " + face_name(face_2) + " overlap by " +
                               number(-state.gap) + " m at the start; less than " + number(pair.admission_depth) +
                               " m, half the depth of the cells behind both, can be resolved. Take deeper cells there, or a "
                               "smaller overlap.",
                           {.face_1 = number_of(face_1),
                            .face_2 = number_of(face_2),
                            .value = -state.gap,
                            .allowed = pair.admission_depth});
        }
    }
    for (std::size_t which = 0; which < overlaps.size(); ++which)
        if (overlaps[which] == 0.0 && deeper[which] != nullptr) refuse_deep_interference(*deeper[which]);
    ramps_.begin(std::move(overlaps));
    set_offsets(0.0);
}

template <int Dim>
void NodeLaw<Dim>::refuse_deep_interference(const NodalPair<Dim>& pair) const {
    const Face face_1 = acting().face_of(Facet{pair.facet_1}), face_2 = acting().face_of(Facet{pair.facet_2});
    throw BadInput("interference: " + face_name(face_1) + " and " + face_name(face_2) +
                       " look at each other, and nowhere do their bodies overlap by less than " +
                       number(pair.admission_depth) +
                       " m, half the depth of the cells behind both. Take deeper cells there, or a smaller overlap; leave "
                       "the interference out where the bodies lie apart.",
                   {.face_1 = number_of(face_1), .face_2 = number_of(face_2), .allowed = pair.admission_depth});
}

/// Sets the offsets of all pairs, at both ends of a step that takes `dt`.
template <int Dim>
void NodeLaw<Dim>::set_offsets(double dt) {
    if (!ramps_.has_begun()) return;
    ramps_.look_ahead(dt);
    pairs_.set_offsets(ramps_.start(), ramps_.end());
}

template <int Dim>
void NodeLaw<Dim>::set_memory(const LawMemory& memory) {
    inside_.restore(memory.seen);
    ramps_.restore(memory.interference);
    if (!ramps_.has_begun()) {
        const std::vector<double> none(options_.interference.times.size(), 0.0);
        pairs_.set_offsets(none, none);
    }
    set_offsets(0.0);
}

/// Takes the pairs that lie inside out of `pairs`, which has those alone that may come out while the list is valid: they are
/// watched. All others are looked at when the next list is made.
template <int Dim>
void NodeLaw<Dim>::set_inside_pairs_apart(std::vector<FacetPair>& pairs, State x_0) {
    const std::vector<char> marks = inside_.marks_of(pairs);
    std::vector<NodalPair<Dim>> watched;
    std::size_t n = 0;
    for (std::size_t p = 0; p < marks.size(); ++p) {
        if (marks[p] != 0) {
            const NodalPair<Dim> pair = pairs_.make_pair(surface_, pairs[p]);
            if (!is_seen_from_outside(pair, x_0)) {
                watched.push_back(pair);
                continue;
            }
            inside_.take_away(pairs[p]);
        }
        pairs[n++] = pairs[p];
    }
    pairs.resize(n);
    watched_.assign(std::move(watched), facets().body, x_0);
}

/// Whether a pair that is no contact since it lay inside has come out at the end of a step: it needs another list.
template <int Dim>
bool NodeLaw<Dim>::sees_from_outside(const Path& path) {
    bool any = false;
    watched_.visit(path.x_1, [&](const NodalPair<Dim>& pair) {
        const FacetPair of_facets{Facet{pair.facet_1}, Facet{pair.facet_2}};
        if (!is_seen_from_outside(pair, path.x_1) || !inside_.has(of_facets)) return;
        inside_.take_away(of_facets);
        any = true;
    });
    return any;
}

/// How much of the overlap of a pair does not act, so that it has `energy_at_first` at most [m].
template <int Dim>
double NodeLaw<Dim>::idle_overlap(const NodalPair<Dim>& pair, State x) const {
    const geometry::PairCorners<Dim> corners = pair.at(x);
    const auto state = geometry::pair_state<Dim>(corners, pair.law);
    const Face face_1 = acting().face_of(Facet{pair.facet_1}), face_2 = acting().face_of(Facet{pair.facet_2});
    const double energy = options_.energy_at_first ? state.overlap * options_.energy_at_first(face_1, face_2) : 0.0;
    if (energy <= 0.0) return -state.gap;
    if (state.energy <= energy) return 0.0;
    double acts = 0.0, idle = -state.gap;  // with this much idle it has more energy, and less
    for (int halving = 0; halving < 52; ++halving) {
        geometry::PairLaw<Dim> law = pair.law;
        law.offset = 0.5 * (acts + idle);
        (geometry::pair_state<Dim>(corners, law).energy > energy ? acts : idle) = law.offset;
    }
    return idle;
}

/// A pair of one body that is pressed in when the run begins lies inside of it.
template <int Dim>
FirstLook NodeLaw<Dim>::decide_first(std::size_t p, State x, bool run_begins) const {
    const NodalPair<Dim>& pair = pairs_.pairs()[p];
    if (pair.body_1 != pair.body_2) {
        const FirstAdmission first = contact::decide_first<Dim>(pair, x, sides_, run_begins);
        if (first != FirstAdmission::missed) return {first};
        return {first, idle_overlap(pair, x)};
    }
    const geometry::PairCorners<Dim> corners = pair.at(x);
    const auto state = geometry::pair_state<Dim>(corners, pair.law);
    const double outside = outside_gap(facets(), FacetPair{Facet{pair.facet_1}, Facet{pair.facet_2}});
    if (state.energy > 0.0 && state.gap < outside)
        return {run_begins ? FirstAdmission::not_admitted
                           : first_admission(state.gap > -pair.admission_depth, true, run_begins)};
    return {may_touch<Dim>(pair, corners, state, sides_) ? FirstAdmission::admitted : FirstAdmission::not_admitted};
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
    step.nodes = listed_nodes();
    step.least_force_size = least_force_size_;
    step.friction.clear();
    clear_step(pairs_, step);
    fold(step);
}

template <int Dim>
std::int64_t NodeLaw<Dim>::step(double dt, const Path& path, std::span<PairMemory> memory, FacetStore& facets,
                                NodalStep<Dim>& step) {
    unfold(step);
    set_offsets(dt);
    const std::int64_t inadmissible =
        law_.apply(acting(), sides_, pairs_, memory, facets, dt, path.x_0, path.x_1, path.take, step);
    pairs_.end_born_offsets(path.x_1, memory);
    fold(step);
    return inadmissible;
}

template <int Dim>
void NodeLaw<Dim>::evaluate(State x, std::span<const PairMemory> memory, const FacetStore& facets, NodalStep<Dim>& step) {
    unfold(step);
    set_offsets(0.0);
    law_.evaluate(acting(), pairs_, memory, facets, x, step);
    fold(step);
}

template class NodeLaw<2>;
template class NodeLaw<3>;

}  // namespace abut::contact
