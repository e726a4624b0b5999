#include "abut/contact/path/path_integral.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "abut/geometry/quadrature.hpp"

namespace abut::contact {
namespace {

using geometry::gauss_legendre;
using geometry::Quadrature;

template <class Value>
Value polynomial(const std::array<Value, 3>& c, double t) {
    return c[0] + t * (c[1] + t * c[2]);
}

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

/// h = A min(g, 0), what a pair adds to the corrections of its faces, at a time inside the piece.
template <int Dim>
double correction_measure(const PathPiece<Dim>& piece, double tau) {
    const double t = (tau - piece.begin) / (piece.end - piece.begin);
    return polynomial(piece.area, t) * polynomial(piece.depth, t);
}

/// The piece of a pair that holds tau, or null where the pair is not active.
template <int Dim>
const PathPiece<Dim>* piece_at(std::span<const PathPiece<Dim>> pieces, double tau) {
    for (const PathPiece<Dim>& piece : pieces)
        if (piece.begin <= tau && tau <= piece.end) return &piece;
    return nullptr;
}

template <int Dim>
std::span<const PathPiece<Dim>> row(const std::vector<PathPiece<Dim>>& pieces, const std::vector<std::int32_t>& offsets,
                                    std::int32_t i) {
    return {pieces.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
}

inline constexpr std::size_t run_length = 64;

/// Calls body(begin, end, work) for runs of [0, n), concurrently, run i with the work area work[i]. What it does
/// for one index must not depend on the runs.
template <class Work, class Body>
void for_each_run(std::size_t n, std::vector<Work>& work, const Body& body) {
    const std::size_t n_runs = std::max<std::size_t>(1, (n + run_length - 1) / run_length);
    if (work.size() < n_runs) work.resize(n_runs);
    const auto run = [&](std::size_t i) { body(std::min(n, i * run_length), std::min(n, (i + 1) * run_length), work[i]); };
    if (n_runs <= 2)
        for (std::size_t i = 0; i < n_runs; ++i) run(i);
    else
        oneapi::tbb::parallel_for(std::size_t{0}, n_runs, run);
}

void sort_and_close(std::vector<double>& cuts, double begin, double end) {
    cuts.push_back(begin);
    cuts.push_back(end);
    std::sort(cuts.begin(), cuts.end());
}

}  // namespace

template <int Dim>
PathIntegral<Dim>::PathIntegral(const ContactOptions& options) : options_(options) {
    if (options_.quadrature == 0) options_.quadrature = Dim;
}

template <int Dim>
void PathIntegral<Dim>::integrate(const SurfaceView<Dim>& surface, const PairList<Dim>& pairs,
                                  std::span<const std::int32_t> local_face, const FaceCoupling<Dim>& coupling,
                                  const FacePath<Dim>& path, Cuts cuts) {
    const std::size_t n_faces = path.displacement_0.size();
    mean_correction_.assign(n_faces, Vector<Dim>::Zero());
    mean_force_.assign(n_faces, Vector<Dim>::Zero());
    mean_normal_force_.assign(n_faces, 0.0);
    const Step step{surface, pairs, local_face, coupling, path, cuts};
    find_closing(step);
    find_active(step);
    if (active_.empty()) return;
    link_faces(step);
    add_mean_corrections(pairs);

    pair_forces_.resize(active_.size());
    for_each_run(active_.size(), scratch_, [&](std::size_t begin, std::size_t end, Scratch& scratch) {
        for (std::size_t a = begin; a < end; ++a) pair_forces_[a] = pair_force(step, static_cast<std::int32_t>(a), scratch);
    });
    for (std::size_t a = 0; a < active_.size(); ++a) {
        const ContactPair<Dim>& pair = pairs.pairs()[active_[a]];
        const std::int32_t f_1 = local_face[pair.face_1];
        const std::int32_t f_2 = local_face[pair.face_2];
        mean_force_[f_1] -= pair_forces_[a].force;
        mean_force_[f_2] += pair_forces_[a].force;
        mean_normal_force_[f_1] -= pair_forces_[a].normal_force;
        mean_normal_force_[f_2] -= pair_forces_[a].normal_force;
    }
}

template <int Dim>
void PathIntegral<Dim>::find_closing(const Step& step) {
    closing_.clear();
    const auto& [u_0, u_1, y_0, y_1] = step.path;
    for (std::int32_t p = 0; p < step.pairs.size(); ++p) {
        const ContactPair<Dim>& pair = step.pairs.pairs()[p];
        if (!pair.admitted) continue;
        const std::int32_t f_1 = step.local_face[pair.face_1];
        const std::int32_t f_2 = step.local_face[pair.face_2];
        const Motion motion{step.pairs.position(step.surface, pair, u_0[f_1], u_0[f_2]),
                            step.pairs.position(step.surface, pair, u_1[f_1], u_1[f_2]),
                            options_.overlap == OverlapMode::moving};
        if (motion.at_0.gap >= 0.0 && motion.at_1.gap >= 0.0) continue;
        if (step.pairs.stay_apart(pair, motion.at_0.shift, motion.at_1.shift)) continue;
        closing_.push_back({p, motion});
    }
}

template <int Dim>
void PathIntegral<Dim>::find_active(const Step& step) {
    for_each_run(closing_.size(), found_, [&](std::size_t begin, std::size_t end, Found& found) {
        found.active.clear();
        found.pieces.clear();
        found.n_pieces.clear();
        found.cuts.clear();
        found.n_cuts.clear();
        for (std::size_t i = begin; i < end; ++i) append_pair(step.pairs, closing_[i], found);
    });
    join_found();
    measure_active(step);
}

/// How deep and how far aside active pairs are pressed, and which of them slipped.
template <int Dim>
void PathIntegral<Dim>::measure_active(const Step& step) {
    compression_ = sliding_ratio_ = 0.0;
    most_compressed_ = -1;
    slipped_.clear();
    std::size_t i = 0;
    for (std::size_t a = 0; a < active_.size(); ++a) {
        while (closing_[i].pair != active_[a]) ++i;
        const ContactPair<Dim>& pair = step.pairs.pairs()[active_[a]];
        const double compression = -std::min(closing_[i].motion.at_0.gap, closing_[i].motion.at_1.gap) / pair.depth;
        if (compression > compression_) {
            compression_ = compression;
            most_compressed_ = active_[a];
        }
        const double face = std::min(step.surface.area[pair.face_1], step.surface.area[pair.face_2]);
        for (const PathPiece<Dim>& piece : row<Dim>(pieces_, piece_offsets_, static_cast<std::int32_t>(a)))
            for (const double t : {0.0, 1.0})
                sliding_ratio_ = std::max(sliding_ratio_,
                                          -polynomial(piece.depth, t) * polynomial(piece.shift_derivative, t).norm() / face);
        const auto& [at_0, at_1, overlap_moves] = closing_[i].motion;
        const double opened = at_1.gap < 0.0 ? 1.0 : at_0.gap / (at_0.gap - at_1.gap);
        const double parted = last_piece(a).end;
        if (parted < opened) slipped_.push_back({active_[a], -closing_[i].motion.gap(parted) / pair.depth});
    }
    if (!slipped_.empty()) drop_carried(step);
}

/// Takes out of `slipped_` the pairs of which a face has another partner at the end of the step. A face of an obstacle may
/// hold many and carries none.
template <int Dim>
void PathIntegral<Dim>::drop_carried(const Step& step) {
    carried_.assign(mean_correction_.size(), 0);
    for (std::size_t a = 0; a < active_.size(); ++a) {
        const PathPiece<Dim>& last = last_piece(a);
        if (last.end < 1.0 || !(polynomial(last.depth, 1.0) < 0.0)) continue;
        const ContactPair<Dim>& pair = step.pairs.pairs()[active_[a]];
        for (const std::int32_t face : {pair.face_1, pair.face_2})
            if (!step.surface.is_rigid(face)) carried_[step.local_face[face]] = 1;
    }
    std::erase_if(slipped_, [&](const SlippedPair& slipped) {
        const ContactPair<Dim>& pair = step.pairs.pairs()[slipped.pair];
        return carried_[step.local_face[pair.face_1]] || carried_[step.local_face[pair.face_2]];
    });
}

template <int Dim>
void PathIntegral<Dim>::join_found() {
    active_.clear();
    pieces_.clear();
    piece_offsets_.assign(1, 0);
    cuts_.clear();
    cut_offsets_.assign(1, 0);
    if (closing_.empty()) return;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    const std::size_t n_runs = (closing_.size() + run_length - 1) / run_length;
    for (const Found& found : std::span(found_).first(n_runs)) {
        append(active_, found.active);
        append(pieces_, found.pieces);
        append(cuts_, found.cuts);
        for (const std::int32_t n : found.n_pieces) piece_offsets_.push_back(piece_offsets_.back() + n);
        for (const std::int32_t n : found.n_cuts) cut_offsets_.push_back(cut_offsets_.back() + n);
    }
}

/// The pieces and the cuts of one pair, if it is active at all.
template <int Dim>
void PathIntegral<Dim>::append_pair(const PairList<Dim>& pairs, const Closing& closing, Found& found) const {
    const auto& [at_0, at_1, overlap_moves] = closing.motion;
    const ContactPair<Dim>& pair = pairs.pairs()[closing.pair];
    const std::size_t n_pieces = found.pieces.size();
    const std::size_t n_cuts = found.cuts.size();
    if (!options_.events) {
        append_sampled_piece(pairs, pair, closing.motion, found);
    } else {
        found.events.clear();
        if ((at_0.gap < 0.0) != (at_1.gap < 0.0)) found.events.push_back(at_0.gap / (at_0.gap - at_1.gap));
        if (closing.motion.overlap_changes()) pairs.append_overlap_events(pair, at_0.shift, at_1.shift, found.events);
        std::erase_if(found.events, [](double tau) { return !(tau > 0.0 && tau < 1.0); });
        sort_and_close(found.events, 0.0, 1.0);
        for (std::size_t k = 0; k + 1 < found.events.size(); ++k)
            if (found.events[k + 1] > found.events[k])
                append_piece(pairs, pair, closing.motion, found.events[k], found.events[k + 1], found);
    }
    if (found.pieces.size() == n_pieces) return;
    for (std::size_t i = n_pieces; i < found.pieces.size(); ++i)
        for (const double cut : {found.pieces[i].begin, found.pieces[i].end})
            if (cut > 0.0 && cut < 1.0 && (found.cuts.size() == n_cuts || found.cuts.back() != cut))
                found.cuts.push_back(cut);
    found.active.push_back(closing.pair);
    found.n_pieces.push_back(static_cast<std::int32_t>(found.pieces.size() - n_pieces));
    found.n_cuts.push_back(static_cast<std::int32_t>(found.cuts.size() - n_cuts));
}

/// Between two events g is linear and A of degree Dim - 1. Its slope dA/ds . ds/dtau is of degree Dim - 2, so A at one time
/// and dA/ds at Dim - 1 times, well inside, give all.
template <int Dim>
void PathIntegral<Dim>::append_piece(const PairList<Dim>& pairs, const ContactPair<Dim>& pair, const Motion& motion,
                                     double begin, double end, Found& found) const {
    const double length = end - begin;
    if (motion.gap(begin + 0.5 * length) >= 0.0) return;
    PathPiece<Dim> piece;
    piece.begin = begin;
    piece.end = end;
    piece.depth = {motion.gap(begin), motion.gap(end) - motion.gap(begin), 0.0};
    piece.shift_derivative.fill(PlaneVector<Dim>::Zero());

    constexpr double first = Dim == 2 ? 0.5 : 0.25;
    const geometry::SharedArea<Dim> at_first = pairs.shared_area(pair, motion.shift(begin + first * length), options_.area);
    piece.area = {at_first.area, 0.0, 0.0};
    if (motion.overlap_moves) piece.shift_derivative[0] = at_first.shift_derivative;
    if (motion.overlap_changes()) {
        const PlaneVector<Dim> travel = length * (motion.at_1.shift - motion.at_0.shift);
        const double slope = at_first.shift_derivative.dot(travel);
        double curvature = 0.0;
        if constexpr (Dim == 3) {
            constexpr double second = 0.75;
            const geometry::SharedArea<Dim> at_second =
                pairs.shared_area(pair, motion.shift(begin + second * length), options_.area);
            const PlaneVector<Dim> change = (at_second.shift_derivative - at_first.shift_derivative) / (second - first);
            piece.shift_derivative = {PlaneVector<Dim>(at_first.shift_derivative - first * change), change,
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
void PathIntegral<Dim>::append_sampled_piece(const PairList<Dim>& pairs, const ContactPair<Dim>& pair, const Motion& motion,
                                             Found& found) const {
    const Quadrature rule = gauss_legendre(options_.quadrature);
    std::array<double, 3> area{};
    std::array<double, 3> depth{};
    std::array<PlaneVector<Dim>, 3> derivative;
    derivative.fill(PlaneVector<Dim>::Zero());
    bool touches = false;
    for (int k = 0; k < rule.size; ++k) {
        const geometry::SharedArea<Dim> shared = pairs.shared_area(pair, motion.shift(rule.node[k]), options_.area);
        area[k] = shared.area;
        if (motion.overlap_moves) derivative[k] = shared.shift_derivative;
        depth[k] = std::min(motion.gap(rule.node[k]), 0.0);
        touches = touches || (area[k] > 0.0 && depth[k] < 0.0);
    }
    if (!touches) return;
    found.pieces.push_back({0.0, 1.0, interpolate(rule.size, rule.node, area, 0.0),
                            interpolate(rule.size, rule.node, depth, 0.0),
                            interpolate<PlaneVector<Dim>>(rule.size, rule.node, derivative, PlaneVector<Dim>::Zero())});
}

/// Row f of terms_: the active pairs on face f and what their h adds to its correction.
template <int Dim>
void PathIntegral<Dim>::link_faces(const Step& step) {
    const auto& [surface, pairs, local_face, coupling, path, cuts] = step;
    const std::size_t n_faces = mean_correction_.size();
    term_offsets_.assign(n_faces + 1, 0);
    const auto for_each_side = [&](auto&& visit) {
        for (std::int32_t a = 0; a < static_cast<std::int32_t>(active_.size()); ++a) {
            const ContactPair<Dim>& pair = pairs.pairs()[active_[a]];
            if (pair.theta_1 > 0.0) visit(local_face[pair.face_1], Term{a, pair.theta_1 / surface.area[pair.face_1]});
            if (pair.theta_2 > 0.0) visit(local_face[pair.face_2], Term{a, -pair.theta_2 / surface.area[pair.face_2]});
        }
    };
    for_each_side([&](std::int32_t face, const Term&) { ++term_offsets_[face + 1]; });
    for (std::size_t f = 0; f < n_faces; ++f) term_offsets_[f + 1] += term_offsets_[f];
    terms_.resize(static_cast<std::size_t>(term_offsets_[n_faces]));
    for_each_side([&](std::int32_t face, const Term& term) { terms_[term_offsets_[face]++] = term; });
    for (std::size_t f = n_faces; f > 0; --f) term_offsets_[f] = term_offsets_[f - 1];
    term_offsets_[0] = 0;
}

template <int Dim>
void PathIntegral<Dim>::add_mean_corrections(const PairList<Dim>& pairs) {
    const Quadrature rule = gauss_legendre(options_.quadrature);
    mean_measure_.assign(active_.size(), 0.0);
    for (std::size_t a = 0; a < active_.size(); ++a)
        for (const PathPiece<Dim>& piece : row<Dim>(pieces_, piece_offsets_, static_cast<std::int32_t>(a)))
            for (int k = 0; k < rule.size; ++k)
                mean_measure_[a] += rule.weight[k] * (piece.end - piece.begin) *
                                    correction_measure(piece, piece.begin + (piece.end - piece.begin) * rule.node[k]);
    for (std::size_t f = 0; f < mean_correction_.size(); ++f)
        for (std::int32_t t = term_offsets_[f]; t < term_offsets_[f + 1]; ++t)
            mean_correction_[f] +=
                terms_[t].weight * mean_measure_[terms_[t].active] * pairs.pairs()[active_[terms_[t].active]].frame.normal();
}

/// scratch.coupled: every active pair whose h enters beta of this pair through the face forces, and its factor
/// +-theta_i/|f_i| n . Q n' weight'.
template <int Dim>
void PathIntegral<Dim>::collect_coupled(const Step& step, std::int32_t active, Scratch& scratch) const {
    scratch.coupled.clear();
    const auto& coupling = step.coupling;
    const ContactPair<Dim>& pair = step.pairs.pairs()[active_[active]];
    const auto add_side = [&](std::int32_t face, double factor) {
        if (factor == 0.0) return;
        const std::int32_t f = step.local_face[face];
        for (std::int32_t c = coupling.offsets[f]; c < coupling.offsets[f + 1]; ++c) {
            const Vector<Dim> row_of_normal = factor * (coupling.blocks[c].transpose() * pair.frame.normal());
            const std::int32_t other = coupling.columns[c];
            for (std::int32_t t = term_offsets_[other]; t < term_offsets_[other + 1]; ++t) {
                const Vector<Dim>& n = step.pairs.pairs()[active_[terms_[t].active]].frame.normal();
                scratch.coupled.emplace_back(terms_[t].active, terms_[t].weight * row_of_normal.dot(n));
            }
        }
    };
    add_side(pair.face_1, pair.theta_1 / step.surface.area[pair.face_1]);
    add_side(pair.face_2, -pair.theta_2 / step.surface.area[pair.face_2]);
}

/// scratch.nodes: the times inside (begin, end) at which beta may change its formula, with both ends, sorted.
template <int Dim>
void PathIntegral<Dim>::collect_cuts(double begin, double end, Cuts cuts, Scratch& scratch) const {
    scratch.nodes.clear();
    const auto add = [&](std::int32_t a) {
        for (std::int32_t c = cut_offsets_[a]; c < cut_offsets_[a + 1]; ++c)
            if (cuts_[c] > begin && cuts_[c] < end) scratch.nodes.push_back(cuts_[c]);
    };
    if (cuts == Cuts::global)
        for (std::int32_t a = 0; a < static_cast<std::int32_t>(active_.size()); ++a) add(a);
    else
        for (const auto& [a, factor] : scratch.coupled) add(a);
    sort_and_close(scratch.nodes, begin, end);
}

/// Mean over the step of beta A and of beta (A n + g dA/ds), beta = theta_1 y_1.n/|f_1| - theta_2 y_2.n/|f_2|.
template <int Dim>
typename PathIntegral<Dim>::PairForce PathIntegral<Dim>::pair_force(const Step& step, std::int32_t active,
                                                                    Scratch& scratch) const {
    const ContactPair<Dim>& pair = step.pairs.pairs()[active_[active]];
    const Vector<Dim>& n = pair.frame.normal();
    const auto free_beta = [&](std::span<const Vector<Dim>> force) {
        return pair.theta_1 / step.surface.area[pair.face_1] * force[step.local_face[pair.face_1]].dot(n) -
               pair.theta_2 / step.surface.area[pair.face_2] * force[step.local_face[pair.face_2]].dot(n);
    };
    const double beta_0 = free_beta(step.path.force_0);
    const double beta_1 = free_beta(step.path.force_1);
    collect_coupled(step, active, scratch);

    const Quadrature rule = gauss_legendre(options_.quadrature);
    double normal_force = 0.0;
    PlaneVector<Dim> shift_force = PlaneVector<Dim>::Zero();
    for (const PathPiece<Dim>& piece : row<Dim>(pieces_, piece_offsets_, active)) {
        collect_cuts(piece.begin, piece.end, step.cuts, scratch);
        for (std::size_t i = 0; i + 1 < scratch.nodes.size(); ++i) {
            const double begin = scratch.nodes[i];
            const double length = scratch.nodes[i + 1] - begin;
            if (!(length > 0.0)) continue;
            std::array<double, 3> tau{};
            std::array<double, 3> beta{};
            for (int k = 0; k < rule.size; ++k) {
                tau[k] = begin + length * rule.node[k];
                beta[k] = beta_0 + tau[k] * (beta_1 - beta_0);
            }
            for (const auto& [other, factor] : scratch.coupled)
                if (const PathPiece<Dim>* at = piece_at(row<Dim>(pieces_, piece_offsets_, other), begin + 0.5 * length))
                    for (int k = 0; k < rule.size; ++k) beta[k] += factor * correction_measure(*at, tau[k]);
            for (int k = 0; k < rule.size; ++k) {
                const double t = (tau[k] - piece.begin) / (piece.end - piece.begin);
                const double weighted = rule.weight[k] * length * beta[k];
                normal_force += weighted * polynomial(piece.area, t);
                shift_force += (weighted * polynomial(piece.depth, t)) * polynomial(piece.shift_derivative, t);
            }
        }
    }
    return {normal_force, normal_force * n + pair.frame.lift(shift_force)};
}

template class PathIntegral<2>;
template class PathIntegral<3>;

}  // namespace abut::contact
