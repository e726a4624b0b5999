#include "abut/contact/path_integral.hpp"

#include <algorithm>
#include <cmath>

namespace abut::contact {
namespace {

struct Quadrature {
    int size;
    std::array<double, 3> node;  // in [0, 1]
    std::array<double, 3> weight;
};

/// Gauss-Legendre on [0, 1] with 1, 2 or 3 points: exact up to degree 1, 3, 5.
Quadrature gauss_legendre(int points) {
    const double two = 0.5 / std::sqrt(3.0);
    const double three = 0.5 * std::sqrt(0.6);
    if (points == 1) return {1, {0.5}, {1.0}};
    if (points == 2) return {2, {0.5 - two, 0.5 + two}, {0.5, 0.5}};
    return {3, {0.5 - three, 0.5, 0.5 + three}, {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0}};
}

template <class Value>
Value polynomial(const std::array<Value, 3>& c, double t) {
    return c[0] + t * (c[1] + t * c[2]);
}

/// Coefficients of the polynomial of degree n - 1 through n <= 3 values at the given nodes (Newton's divided differences).
template <class Value>
std::array<Value, 3> interpolate(int n, const std::array<double, 3>& node, const std::array<Value, 3>& value, const Value& zero) {
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
std::span<const PathPiece<Dim>> row(const std::vector<PathPiece<Dim>>& pieces, const std::vector<std::int32_t>& offsets, std::int32_t i) {
    return {pieces.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
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
void PathIntegral<Dim>::integrate(const SurfaceView<Dim>& surface, const PairList<Dim>& pairs, std::span<const std::int32_t> local_face,
                                  const FaceCoupling<Dim>& coupling, const FacePath<Dim>& path, Cuts cuts) {
    const std::size_t n_faces = path.displacement_0.size();
    mean_correction_.assign(n_faces, Vector<Dim>::Zero());
    mean_force_.assign(n_faces, Vector<Dim>::Zero());
    mean_normal_force_.assign(n_faces, 0.0);
    find_active(surface, pairs, local_face, path);
    if (active_.empty()) return;
    link_faces(surface, pairs, local_face, n_faces);
    add_mean_corrections(pairs);
    for (std::int32_t a = 0; a < static_cast<std::int32_t>(active_.size()); ++a)
        add_pair_force(a, surface, pairs, local_face, coupling, path, cuts);
}

template <int Dim>
void PathIntegral<Dim>::find_active(const SurfaceView<Dim>& surface, const PairList<Dim>& pairs, std::span<const std::int32_t> local_face,
                                    const FacePath<Dim>& path) {
    active_.clear();
    pieces_.clear();
    piece_offsets_.assign(1, 0);
    cuts_.clear();
    cut_offsets_.assign(1, 0);
    n_events_ = 0;
    compression_ = 0.0;
    most_compressed_ = -1;
    for (std::int32_t p = 0; p < pairs.size(); ++p) {
        const ContactPair<Dim>& pair = pairs.pairs()[p];
        if (!pair.admitted) continue;
        const std::int32_t f_1 = local_face[pair.face_1];
        const std::int32_t f_2 = local_face[pair.face_2];
        const auto at_0 = pairs.position(surface, pair, path.displacement_0[f_1], path.displacement_0[f_2]);
        const auto at_1 = pairs.position(surface, pair, path.displacement_1[f_1], path.displacement_1[f_2]);
        if (at_0.gap >= 0.0 && at_1.gap >= 0.0) continue;
        append_pieces(pairs, pair, at_0, at_1);
        if (static_cast<std::int32_t>(pieces_.size()) == piece_offsets_.back()) {
            cuts_.resize(cut_offsets_.back());
            continue;
        }
        active_.push_back(p);
        piece_offsets_.push_back(static_cast<std::int32_t>(pieces_.size()));
        cut_offsets_.push_back(static_cast<std::int32_t>(cuts_.size()));
        n_events_ += cut_offsets_.back() - cut_offsets_[cut_offsets_.size() - 2];
        const double compression = -std::min(at_0.gap, at_1.gap) / pair.depth;
        if (compression > compression_) {
            compression_ = compression;
            most_compressed_ = p;
        }
    }
}

template <int Dim>
void PathIntegral<Dim>::append_pieces(const PairList<Dim>& pairs, const ContactPair<Dim>& pair, const PairPosition<Dim>& at_0,
                                      const PairPosition<Dim>& at_1) {
    const Motion motion{at_0, at_1, options_.overlap == OverlapMode::moving};
    if (!options_.events) {
        const Quadrature rule = gauss_legendre(options_.quadrature);
        append_piece(pairs, pair, motion, 0.0, 1.0, rule.size, rule.node);
        return;
    }
    events_.clear();
    if ((at_0.gap < 0.0) != (at_1.gap < 0.0)) events_.push_back(at_0.gap / (at_0.gap - at_1.gap));
    if (motion.overlap_moves) pairs.append_overlap_events(pair, at_0.shift, at_1.shift, events_);
    std::erase_if(events_, [](double tau) { return !(tau > 0.0 && tau < 1.0); });
    sort_and_close(events_, 0.0, 1.0);

    // A is of degree Dim - 1 between two events and sampled well inside them.
    static constexpr std::array<double, 3> inside = Dim == 2 ? std::array{0.25, 0.75, 0.0} : std::array{1.0 / 6.0, 0.5, 5.0 / 6.0};
    for (std::size_t k = 0; k + 1 < events_.size(); ++k) {
        const double begin = events_[k];
        const double end = events_[k + 1];
        if (!(end > begin) || motion.gap(0.5 * (begin + end)) >= 0.0) continue;
        append_piece(pairs, pair, motion, begin, end, Dim, inside);
    }
}

template <int Dim>
void PathIntegral<Dim>::append_piece(const PairList<Dim>& pairs, const ContactPair<Dim>& pair, const Motion& motion, double begin,
                                     double end, int n, const std::array<double, 3>& node) {
    std::array<double, 3> area{};
    std::array<double, 3> depth{};
    std::array<PlaneVector<Dim>, 3> derivative;
    derivative.fill(PlaneVector<Dim>::Zero());
    bool touches = false;
    for (int k = 0; k < n; ++k) {
        const double tau = begin + (end - begin) * node[k];
        const geometry::SharedArea<Dim> shared =
            k > 0 && !motion.overlap_changes() ? geometry::SharedArea<Dim>{area[0], derivative[0]}
                                               : pairs.shared_area(pair, motion.shift(tau), options_.area);
        area[k] = shared.area;
        if (motion.overlap_moves) derivative[k] = shared.shift_derivative;
        depth[k] = std::min(motion.gap(tau), 0.0);
        touches = touches || (area[k] > 0.0 && depth[k] < 0.0);
    }
    if (!touches) return;
    pieces_.push_back({begin, end, interpolate(n, node, area, 0.0), interpolate(n, node, depth, 0.0),
                       interpolate<PlaneVector<Dim>>(n, node, derivative, PlaneVector<Dim>::Zero())});
    for (const double cut : {begin, end})
        if (cut > 0.0 && cut < 1.0 && (static_cast<std::int32_t>(cuts_.size()) == cut_offsets_.back() || cuts_.back() != cut))
            cuts_.push_back(cut);
}

/// Row f of terms_: the active pairs on face f and what their h adds to its correction.
template <int Dim>
void PathIntegral<Dim>::link_faces(const SurfaceView<Dim>& surface, const PairList<Dim>& pairs, std::span<const std::int32_t> local_face,
                                   std::size_t n_faces) {
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
            mean_correction_[f] += terms_[t].weight * mean_measure_[terms_[t].active] * pairs.pairs()[active_[terms_[t].active]].frame.normal();
}

/// coupled_: every active pair whose h enters beta of this pair through the face forces, and its factor
/// +-theta_i/|f_i| n . Q n' weight'.
template <int Dim>
void PathIntegral<Dim>::collect_coupled(std::int32_t active, const SurfaceView<Dim>& surface, const PairList<Dim>& pairs,
                                        std::span<const std::int32_t> local_face, const FaceCoupling<Dim>& coupling) {
    coupled_.clear();
    const ContactPair<Dim>& pair = pairs.pairs()[active_[active]];
    const auto add_side = [&](std::int32_t face, double factor) {
        if (factor == 0.0) return;
        const std::int32_t f = local_face[face];
        for (std::int32_t c = coupling.offsets[f]; c < coupling.offsets[f + 1]; ++c) {
            const Vector<Dim> row_of_normal = factor * (coupling.blocks[c].transpose() * pair.frame.normal());
            const std::int32_t other = coupling.columns[c];
            for (std::int32_t t = term_offsets_[other]; t < term_offsets_[other + 1]; ++t) {
                const Vector<Dim>& n = pairs.pairs()[active_[terms_[t].active]].frame.normal();
                coupled_.emplace_back(terms_[t].active, terms_[t].weight * row_of_normal.dot(n));
            }
        }
    };
    add_side(pair.face_1, pair.theta_1 / surface.area[pair.face_1]);
    add_side(pair.face_2, -pair.theta_2 / surface.area[pair.face_2]);
}

/// nodes_: the times inside (begin, end) at which beta may change its formula, with both ends, sorted.
template <int Dim>
void PathIntegral<Dim>::collect_cuts(double begin, double end, Cuts cuts) {
    nodes_.clear();
    const auto add = [&](std::int32_t a) {
        for (std::int32_t c = cut_offsets_[a]; c < cut_offsets_[a + 1]; ++c)
            if (cuts_[c] > begin && cuts_[c] < end) nodes_.push_back(cuts_[c]);
    };
    if (cuts == Cuts::global)
        for (std::int32_t a = 0; a < static_cast<std::int32_t>(active_.size()); ++a) add(a);
    else
        for (const auto& [a, factor] : coupled_) add(a);
    sort_and_close(nodes_, begin, end);
}

template <int Dim>
void PathIntegral<Dim>::add_pair_force(std::int32_t active, const SurfaceView<Dim>& surface, const PairList<Dim>& pairs,
                                       std::span<const std::int32_t> local_face, const FaceCoupling<Dim>& coupling,
                                       const FacePath<Dim>& path, Cuts cuts) {
    const ContactPair<Dim>& pair = pairs.pairs()[active_[active]];
    const std::int32_t f_1 = local_face[pair.face_1];
    const std::int32_t f_2 = local_face[pair.face_2];
    const double factor_1 = pair.theta_1 / surface.area[pair.face_1];
    const double factor_2 = -pair.theta_2 / surface.area[pair.face_2];
    const Vector<Dim>& n = pair.frame.normal();
    const auto free_beta = [&](std::span<const Vector<Dim>> force) { return factor_1 * force[f_1].dot(n) + factor_2 * force[f_2].dot(n); };
    const double beta_0 = free_beta(path.force_0);
    const double beta_1 = free_beta(path.force_1);
    collect_coupled(active, surface, pairs, local_face, coupling);

    const Quadrature rule = gauss_legendre(options_.quadrature);
    double normal_force = 0.0;  // mean of beta A
    PlaneVector<Dim> shift_force = PlaneVector<Dim>::Zero();  // mean of beta g dA/ds
    for (const PathPiece<Dim>& piece : row<Dim>(pieces_, piece_offsets_, active)) {
        collect_cuts(piece.begin, piece.end, cuts);
        for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
            const double length = nodes_[i + 1] - nodes_[i];
            if (!(length > 0.0)) continue;
            std::array<double, 3> tau{};
            std::array<double, 3> beta{};
            for (int k = 0; k < rule.size; ++k) {
                tau[k] = nodes_[i] + length * rule.node[k];
                beta[k] = beta_0 + tau[k] * (beta_1 - beta_0);
            }
            for (const auto& [other, factor] : coupled_)
                if (const PathPiece<Dim>* at = piece_at(row<Dim>(pieces_, piece_offsets_, other), nodes_[i] + 0.5 * length))
                    for (int k = 0; k < rule.size; ++k) beta[k] += factor * correction_measure(*at, tau[k]);
            for (int k = 0; k < rule.size; ++k) {
                const double t = (tau[k] - piece.begin) / (piece.end - piece.begin);
                const double weighted = rule.weight[k] * length * beta[k];
                normal_force += weighted * polynomial(piece.area, t);
                shift_force += (weighted * polynomial(piece.depth, t)) * polynomial(piece.shift_derivative, t);
            }
        }
    }
    const Vector<Dim> force = normal_force * n + pair.frame.lift(shift_force);
    mean_force_[f_2] += force;
    mean_force_[f_1] -= force;
    mean_normal_force_[f_1] -= normal_force;
    mean_normal_force_[f_2] -= normal_force;
}

template class PathIntegral<2>;
template class PathIntegral<3>;

}  // namespace abut::contact
