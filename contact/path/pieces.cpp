#include "abut/contact/path/pieces.hpp"

#include <algorithm>

#include "abut/base/quadrature.hpp"
#include "abut/contact/path/runs.hpp"

namespace abut::contact {
namespace {

/// Coefficients of the polynomial of degree n - 1 through n <= 3 values at the given nodes (Newton's divided differences).
template <class Value>
std::array<Value, 3> interpolate(int n, const std::array<double, 3>& node, const std::array<Value, 3>& value,
                                 const Value& zero) {
    if (n == 1) return {value[0], zero, zero};
    const Value first = (value[1] - value[0]) / (node[1] - node[0]);
    if (n == 2) return {value[0] - first * node[0], first, zero};
    const Value next = (value[2] - value[1]) / (node[2] - node[1]);
    const Value second = (next - first) / (node[2] - node[0]);
    return {value[0] - first * node[0] + second * (node[0] * node[1]), first - second * (node[0] + node[1]), second};
}

}  // namespace

template <int Dim>
PieceFinder<Dim>::PieceFinder(const ContactOptions& options, Sharing* sharing) : options_(options), shared_(sharing) {
    options_.quadrature = quadrature_points<Dim>(options);
}

template <int Dim>
const ActivePairs<Dim>& PieceFinder<Dim>::find(const SurfaceView<Dim>& surface, const PairList<Dim>& list,
                                               std::span<const PairMemory> memory, std::span<const Vector<Dim>> u_0,
                                               std::span<const Vector<Dim>> u_1) {
    find_penetrating(surface, list, memory, u_0, u_1);
    clear_active();
    const std::size_t n = penetrating_.size();
    if (!shared_.is_worth(n)) {
        for (const Found& found : find_pieces(list, {0, n})) append(found);
        return active_;
    }
    shared_.run(
        n,
        [&](const IndexRange& mine, ShareWriter& out) {
            for (const Found& found : find_pieces(list, mine)) write(found, out);
        },
        [&](const IndexRange&, ShareReader& in) {
            while (!in.is_done()) read(in);
        });
    return active_;
}

/// By run.
template <int Dim>
std::span<const typename PieceFinder<Dim>::Found> PieceFinder<Dim>::find_pieces(const PairList<Dim>& list,
                                                                                const IndexRange& of_penetrating) {
    for_each_run(of_penetrating, found_, [&](std::size_t begin, std::size_t end, Found& found) {
        found.penetrating.clear();
        found.pieces.clear();
        found.n_pieces.clear();
        found.cuts.clear();
        found.n_cuts.clear();
        for (std::size_t i = begin; i < end; ++i) append_pair(list, static_cast<std::int32_t>(i), found);
    });
    return std::span(found_).first(number_of_runs(of_penetrating));
}

template <int Dim>
void PieceFinder<Dim>::find_penetrating(const SurfaceView<Dim>& surface, const PairList<Dim>& list,
                                        std::span<const PairMemory> memory, std::span<const Vector<Dim>> u_0,
                                        std::span<const Vector<Dim>> u_1) {
    penetrating_.clear();
    for (std::int32_t p = 0; p < list.size(); ++p) {
        if (!memory[static_cast<std::size_t>(p)].admitted) continue;
        const ContactPair<Dim>& pair = list[p];
        const PairMotion<Dim> motion{list.position(surface, pair, u_0[pair.listed_1], u_0[pair.listed_2]),
                                     list.position(surface, pair, u_1[pair.listed_1], u_1[pair.listed_2]),
                                     options_.overlap == OverlapMode::moving};
        if (motion.at_0.gap >= 0.0 && motion.at_1.gap >= 0.0) continue;
        if (list.stay_apart(pair, motion.at_0.tangential_offset, motion.at_1.tangential_offset)) continue;
        penetrating_.push_back({p, motion});
    }
}

template <int Dim>
void PieceFinder<Dim>::clear_active() {
    active_.pairs.clear();
    active_.motions.clear();
    active_.pieces.clear();
    active_.piece_offsets.assign(1, 0);
    active_.cuts.clear();
    active_.cut_offsets.assign(1, 0);
}

template <int Dim>
void PieceFinder<Dim>::append(const Found& found) {
    auto& [pairs, motions, pieces, piece_offsets, cuts, cut_offsets] = active_;
    for (const std::int32_t i : found.penetrating) {
        pairs.push_back(penetrating_[static_cast<std::size_t>(i)].pair);
        motions.push_back(penetrating_[static_cast<std::size_t>(i)].motion);
    }
    const auto append_all = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append_all(pieces, found.pieces);
    append_all(cuts, found.cuts);
    for (const std::int32_t n : found.n_pieces) piece_offsets.push_back(piece_offsets.back() + n);
    for (const std::int32_t n : found.n_cuts) cut_offsets.push_back(cut_offsets.back() + n);
}

template <int Dim>
void PieceFinder<Dim>::write(const Found& found, ShareWriter& out) {
    out.put_all(found.penetrating);
    out.put_all(found.pieces);
    out.put_all(found.n_pieces);
    out.put_all(found.cuts);
    out.put_all(found.n_cuts);
}

/// Reads and appends a run.
template <int Dim>
void PieceFinder<Dim>::read(ShareReader& in) {
    in.get_all(received_.penetrating);
    in.get_all(received_.pieces);
    in.get_all(received_.n_pieces);
    in.get_all(received_.cuts);
    in.get_all(received_.n_cuts);
    append(received_);
}

/// The pieces and the cuts of one pair, if it is active at all.
template <int Dim>
void PieceFinder<Dim>::append_pair(const PairList<Dim>& list, std::int32_t penetrating, Found& found) const {
    const PairMotion<Dim>& motion = penetrating_[static_cast<std::size_t>(penetrating)].motion;
    const ContactPair<Dim>& pair = list[penetrating_[static_cast<std::size_t>(penetrating)].pair];
    const auto& [at_0, at_1, overlap_moves] = motion;
    const std::size_t n_pieces = found.pieces.size();
    const std::size_t n_cuts = found.cuts.size();
    if (!options_.events) {
        append_sampled_piece(list, pair, motion, found);
    } else {
        found.events.clear();
        if ((at_0.gap < 0.0) != (at_1.gap < 0.0)) found.events.push_back(at_0.gap / (at_0.gap - at_1.gap));
        if (motion.overlap_changes())
            list.append_overlap_events(pair, at_0.tangential_offset, at_1.tangential_offset, found.events);
        std::erase_if(found.events, [](double tau) { return !(tau > 0.0 && tau < 1.0); });
        sort_and_close(found.events, 0.0, 1.0);
        for (std::size_t k = 0; k + 1 < found.events.size(); ++k)
            if (found.events[k + 1] > found.events[k])
                append_piece(list, pair, motion, found.events[k], found.events[k + 1], found);
    }
    if (found.pieces.size() == n_pieces) return;
    for (std::size_t i = n_pieces; i < found.pieces.size(); ++i)
        for (const double cut : {found.pieces[i].begin, found.pieces[i].end})
            if (cut > 0.0 && cut < 1.0 && (found.cuts.size() == n_cuts || found.cuts.back() != cut))
                found.cuts.push_back(cut);
    found.penetrating.push_back(penetrating);
    found.n_pieces.push_back(static_cast<std::int32_t>(found.pieces.size() - n_pieces));
    found.n_cuts.push_back(static_cast<std::int32_t>(found.cuts.size() - n_cuts));
}

/// Between two events g is linear and A of degree Dim - 1. Its slope dA/ds . ds/dtau is of degree Dim - 2, so A at one time
/// and dA/ds at Dim - 1 times, well inside, give all.
template <int Dim>
void PieceFinder<Dim>::append_piece(const PairList<Dim>& list, const ContactPair<Dim>& pair, const PairMotion<Dim>& motion,
                                    double begin, double end, Found& found) const {
    const double length = end - begin;
    if (motion.gap(begin + 0.5 * length) >= 0.0) return;
    PathPiece<Dim> piece;
    piece.begin = begin;
    piece.end = end;
    piece.penetration = {motion.gap(begin), motion.gap(end) - motion.gap(begin), 0.0};
    piece.area_gradient.fill(PlaneVector<Dim>::Zero());

    constexpr double first = Dim == 2 ? 0.5 : 0.25;
    const geometry::OverlapArea<Dim> at_first = list.overlap(pair, motion.offset(begin + first * length), options_.area);
    piece.area = {at_first.area, 0.0, 0.0};
    if (motion.overlap_moves) piece.area_gradient[0] = at_first.area_gradient;
    if (motion.overlap_changes()) {
        const PlaneVector<Dim> travel = length * (motion.at_1.tangential_offset - motion.at_0.tangential_offset);
        const double slope = at_first.area_gradient.dot(travel);
        double curvature = 0.0;
        if constexpr (Dim == 3) {
            constexpr double second = 0.75;
            const geometry::OverlapArea<Dim> at_second =
                list.overlap(pair, motion.offset(begin + second * length), options_.area);
            const PlaneVector<Dim> change = (at_second.area_gradient - at_first.area_gradient) / (second - first);
            piece.area_gradient = {PlaneVector<Dim>(at_first.area_gradient - first * change), change,
                                   PlaneVector<Dim>::Zero()};
            curvature = change.dot(travel);
        }
        // A(t) = A_first + slope (t - first) + curvature (t - first)^2 / 2
        piece.area = {at_first.area - slope * first + 0.5 * curvature * first * first, slope - curvature * first,
                      0.5 * curvature};
    }
    if (piece.area[0] == 0.0 && piece.area[1] == 0.0 && piece.area[2] == 0.0) return;
    found.pieces.push_back(piece);
}

/// Without events the step is one piece, and A and min(g, 0) are known at the quadrature points only.
template <int Dim>
void PieceFinder<Dim>::append_sampled_piece(const PairList<Dim>& list, const ContactPair<Dim>& pair,
                                            const PairMotion<Dim>& motion, Found& found) const {
    const Quadrature rule = gauss_legendre(options_.quadrature);
    std::array<double, 3> area{};
    std::array<double, 3> penetration{};
    std::array<PlaneVector<Dim>, 3> gradient;
    gradient.fill(PlaneVector<Dim>::Zero());
    bool touches = false;
    for (int k = 0; k < rule.size; ++k) {
        const geometry::OverlapArea<Dim> overlap = list.overlap(pair, motion.offset(rule.node[k]), options_.area);
        area[k] = overlap.area;
        if (motion.overlap_moves) gradient[k] = overlap.area_gradient;
        penetration[k] = std::min(motion.gap(rule.node[k]), 0.0);
        touches = touches || (area[k] > 0.0 && penetration[k] < 0.0);
    }
    if (!touches) return;
    found.pieces.push_back({0.0, 1.0, interpolate(rule.size, rule.node, area, 0.0),
                            interpolate(rule.size, rule.node, penetration, 0.0),
                            interpolate<PlaneVector<Dim>>(rule.size, rule.node, gradient, PlaneVector<Dim>::Zero())});
}

template class PieceFinder<2>;
template class PieceFinder<3>;

}  // namespace abut::contact
