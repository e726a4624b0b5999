#include "abut/contact/pairs/nodal_pairs.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::contact {
namespace {

constexpr std::ptrdiff_t pairs_per_task = 256;               // pairs that are worth a task
constexpr std::size_t looks_at_once = std::size_t{1} << 14;  // outlooks that are kept until they are used

// Steps like the present one after which the pairs in reach are chosen again.
constexpr double steps_between = 8.0;

double admission_depth(double stiffness, double depth) {
    return stiffness == std::numeric_limits<double>::infinity() ? 0.0 : depth;
}

/// One that may not act says nothing of pairs that are deeper.
template <int Dim>
geometry::PairOutlook<Dim> outlook_of(const geometry::PairOutlook<Dim>& found) {
    if (found.may_act) return found;
    geometry::PairOutlook<Dim> nothing;
    nothing.may_act = false;
    return nothing;
}

/// All that is asked of it: of one that may not act, whether it is apart.
template <int Dim>
void write_outlook(const geometry::PairOutlook<Dim>& outlook, ShareWriter& out) {
    out.put(outlook.may_act);
    out.put(outlook.is_apart);
    if (!outlook.may_act) return;
    out.put(outlook.normal);
    out.put(outlook.aside);
    out.put(outlook.aside_allowance);
}

template <int Dim>
void read_outlook(geometry::PairOutlook<Dim>& outlook, ShareReader& in) {
    outlook.may_act = in.get<bool>();
    outlook.is_apart = in.get<bool>();
    if (!outlook.may_act) return;
    outlook.normal = in.get<Vector<Dim>>();
    outlook.aside = in.get<Vector<Dim>>();
    outlook.aside_allowance = in.get<double>();
}

BodyPair in_order(std::int32_t body_1, std::int32_t body_2) { return {std::min(body_1, body_2), std::max(body_1, body_2)}; }

/// Index of a value in a sorted list that has it.
template <class T>
std::int32_t index_in(const std::vector<T>& sorted, const T& value) {
    return static_cast<std::int32_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

}  // namespace

template <int Dim>
NodalPair<Dim> NodalPairs<Dim>::make_pair(const BevelledSurface<Dim>& surface, const FacetPair& of_facets) const {
    const Surface<Dim>& facets = surface.acting().facets();
    const std::int32_t facet_1 = number_of(of_facets.facet_1), facet_2 = number_of(of_facets.facet_2);
    NodalPair<Dim> pair{.facet_1 = facet_1, .facet_2 = facet_2};
    for (int v = 0; v < Dim; ++v) {
        pair.node[v] = facets.face_vertices[Dim * facet_1 + v];
        pair.node[Dim + v] = facets.face_vertices[Dim * facet_2 + v];
    }
    const double k_1 = facets.stiffness[facet_1], k_2 = facets.stiffness[facet_2];
    pair.law.stiffness = series_stiffness(k_1, k_2);
    pair.law.facing = facing_;
    if constexpr (Dim == 2) pair.law.length = {facets.area[facet_1], facets.area[facet_2]};
    pair.admission_depth =
        admission_depth(k_1, facets.cell_depth[facet_1]) + admission_depth(k_2, facets.cell_depth[facet_2]);
    if (friction_.any())
        pair.friction =
            friction_.law_between(surface.acting().face_of(of_facets.facet_1), surface.acting().face_of(of_facets.facet_2));
    if (interference_.any())
        pair.interference =
            interference_.between(surface.acting().face_of(of_facets.facet_1), surface.acting().face_of(of_facets.facet_2));
    if (pair.interference >= 0) pair.offset_before = pair.law.offset = offsets_[static_cast<std::size_t>(pair.interference)];
    pair.has_bevel = surface.has_bevel(facet_1, facet_2);
    if (pair.has_bevel) pair.law = surface.law_with_bevel(facet_1, facet_2, pair.law);
    return pair;
}

template <int Dim>
void NodalPairs<Dim>::assign(const BevelledSurface<Dim>& surface, std::vector<FacetPair>& facets,
                             std::span<const FacetPair> in_contact, std::span<const NodalPair<Dim>> watched,
                             PointsView<Dim> x, double reach, double compression) {
    compression_ = compression;
    pairs_.clear();
    pairs_.reserve(facets.size());
    for (const FacetPair& of_facets : facets) pairs_.push_back(make_pair(surface, of_facets));
    std::size_t n = 0;
    look_ahead(x, reach, [&](std::size_t p, const geometry::PairOutlook<Dim>& outlook) {
        if (!outlook.may_act && !std::ranges::binary_search(in_contact, facets[p])) return;
        facets[n] = facets[p];
        pairs_[n] = pairs_[p];
        pairs_[n].outlook = outlook_of(outlook);
        ++n;
    });
    facets.resize(n);
    pairs_.resize(n);
    pairs_.shrink_to_fit();  // most candidates go, and the list lives long
    index(surface, watched);
}

template <int Dim>
void NodalPairs<Dim>::assign(const BevelledSurface<Dim>& surface, std::span<const FacetPair> facets) {
    pairs_.clear();
    for (const FacetPair& of_facets : facets) pairs_.push_back(make_pair(surface, of_facets));
    index(surface);
}

template <int Dim>
template <class Use>
void NodalPairs<Dim>::look_ahead(PointsView<Dim> x, double reach, const Use& use) {
    for (std::size_t begin = 0; begin < pairs_.size(); begin += looks_at_once) {
        const std::size_t n = std::min(looks_at_once, pairs_.size() - begin);
        look_at(begin, n, x, reach);
        for (std::size_t i = 0; i < n; ++i) use(begin + i, outlooks_[i]);
    }
}

template <int Dim>
void NodalPairs<Dim>::look_at(std::size_t begin, std::size_t n, PointsView<Dim> x, double reach) {
    outlooks_.resize(n);
    const auto look = [&](const IndexRange& range) {
        parallel_each(
            static_cast<std::ptrdiff_t>(range.size()),
            [&](std::ptrdiff_t i) {
                const std::size_t at = range.begin + static_cast<std::size_t>(i);
                const NodalPair<Dim>& pair = pairs_[begin + at];
                outlooks_[at] =
                    geometry::pair_outlook<Dim>(pair.at(x), pair.law, reach, compression_ * pair.admission_depth);
            },
            pairs_per_task);
    };
    if (!shared_.is_worth(n)) return look({0, n});
    shared_.run(
        n,
        [&](const IndexRange& mine, ShareWriter& out) {
            look(mine);
            for (std::size_t i = mine.begin; i < mine.end; ++i) write_outlook(outlooks_[i], out);
        },
        [&](const IndexRange& range, ShareReader& in) {
            for (std::size_t i = range.begin; i < range.end; ++i) read_outlook(outlooks_[i], in);
        });
}

template <int Dim>
void NodalPairs<Dim>::prune(PointsView<Dim> x_0, PointsView<Dim> x_1, std::span<PairMemory> memory) {
    const auto motion = [&](std::ptrdiff_t i) { return (x_1[nodes_[i]] - x_0[nodes_[i]]).squaredNorm(); };
    prune_reach_ = steps_between * std::sqrt(largest(std::ssize(nodes_), motion));
    in_reach_.clear();
    in_reach_.reserve(pairs_.size());
    look_ahead(x_0, prune_reach_, [&](std::size_t p, const geometry::PairOutlook<Dim>& outlook) {
        const bool is_kept_anyway = !pairs_[p].outlook.may_act;
        if (!outlook.may_act && !is_kept_anyway) {
            memory[p] = {.admitted = outlook.is_apart};
            pairs_[p].law.offset = pairs_[p].interference >= 0 ? pairs_[p].law.offset : 0.0;
            return;
        }
        in_reach_.push_back(pairs_[p]);
        in_reach_.back().outlook = outlook_of(outlook);
    });
    pruned_at_.clear();
    for (const std::int32_t node : nodes_) pruned_at_.push_back(x_0[node]);
}

template <int Dim>
void NodalPairs<Dim>::set_offsets(std::span<const double> start, std::span<const double> end) {
    offsets_.assign(end.begin(), end.end());
    for (std::vector<NodalPair<Dim>>* pairs : {&pairs_, &in_reach_})
        for (NodalPair<Dim>& pair : *pairs)
            if (pair.interference >= 0) {
                pair.offset_before = start[static_cast<std::size_t>(pair.interference)];
                pair.law.offset = end[static_cast<std::size_t>(pair.interference)];
            }
}

template <int Dim>
void NodalPairs<Dim>::set_born_offsets(std::span<const PairMemory> memory) {
    any_born_offset_ = std::ranges::any_of(memory, [](const PairMemory& of_pair) { return of_pair.offset > 0.0; });
    for (std::vector<NodalPair<Dim>>* pairs : {&pairs_, &in_reach_})
        for (NodalPair<Dim>& pair : *pairs)
            if (pair.interference < 0)
                pair.offset_before = pair.law.offset = memory[static_cast<std::size_t>(pair.memory)].offset;
}

template <int Dim>
void NodalPairs<Dim>::end_born_offsets(PointsView<Dim> x_1, std::span<PairMemory> memory) {
    if (!any_born_offset_) return;
    bool any_ends = false;
    for (const NodalPair<Dim>& pair : in_reach_) {
        double& offset = memory[static_cast<std::size_t>(pair.memory)].offset;
        if (offset == 0.0) continue;
        geometry::PairLaw<Dim> without = pair.law;
        without.offset = 0.0;
        if (geometry::pair_state<Dim>(pair.at(x_1), without).energy > 0.0) continue;
        offset = 0.0;
        any_ends = true;
    }
    if (any_ends) set_born_offsets(memory);
}

template <int Dim>
bool NodalPairs<Dim>::is_pruned_at(PointsView<Dim> x) const {
    if (pruned_at_.size() != nodes_.size()) return false;
    const auto motion = [&](std::ptrdiff_t i) { return (x[nodes_[i]] - pruned_at_[i]).squaredNorm(); };
    return std::sqrt(largest(std::ssize(nodes_), motion)) <= prune_reach_;
}

template <int Dim>
std::span<const NodalPair<Dim>> NodalPairs<Dim>::in_reach(PointsView<Dim> x_0, PointsView<Dim> x_1,
                                                          std::span<PairMemory> memory) {
    if (!is_pruned_at(x_0) || !is_pruned_at(x_1)) prune(x_0, x_1, memory);
    return in_reach_;
}

template <int Dim>
std::span<const NodalPair<Dim>> NodalPairs<Dim>::in_reach(PointsView<Dim> x) const {
    return is_pruned_at(x) ? std::span<const NodalPair<Dim>>(in_reach_) : pairs_;
}

template <int Dim>
void NodalPairs<Dim>::index(const BevelledSurface<Dim>& surface, std::span<const NodalPair<Dim>> watched) {
    nodes_.clear();
    bodies_.clear();
    body_pairs_.clear();
    in_reach_.clear();
    pruned_at_.clear();
    const std::vector<std::int32_t>& body = surface.acting().facets().body;
    for (const NodalPair<Dim>& pair : watched) nodes_.insert(nodes_.end(), pair.node.begin(), pair.node.end());
    for (const NodalPair<Dim>& pair : pairs_) {
        nodes_.insert(nodes_.end(), pair.node.begin(), pair.node.end());
        const BodyPair of_bodies = in_order(body[pair.facet_1], body[pair.facet_2]);
        if (!body_pairs_.empty() && body_pairs_.back() == of_bodies) continue;
        body_pairs_.push_back(of_bodies);
        bodies_.insert(bodies_.end(), {of_bodies.body_1, of_bodies.body_2});
    }
    surface.append_host_nodes(nodes_);
    sort_unique(nodes_);
    sort_unique(bodies_);
    sort_unique(body_pairs_);
    index_of_node_.resize(surface.acting().facets().vertices.size());
    std::int32_t n = 0;
    for (const std::int32_t node : nodes_) index_of_node_[node] = n++;
    n = 0;
    for (NodalPair<Dim>& pair : pairs_) {
        for (std::size_t v = 0; v < pair.node.size(); ++v) pair.listed[v] = index_of_node_[pair.node[v]];
        const std::int32_t body_1 = body[pair.facet_1], body_2 = body[pair.facet_2];
        pair.body_1 = index_in(bodies_, body_1);
        pair.body_2 = index_in(bodies_, body_2);
        pair.body_pair = index_in(body_pairs_, in_order(body_1, body_2));
        pair.memory = n++;
    }
}

template class NodalPairs<2>;
template class NodalPairs<3>;

}  // namespace abut::contact
