#include "abut/contact/law/reconstruction.hpp"

#include <array>
#include <span>

#include "abut/base/quadrature.hpp"
#include "abut/contact/path/runs.hpp"

namespace abut::contact {
namespace {

/// The piece of a pair that holds tau, or null where the pair is not active.
template <int Dim>
const PathPiece<Dim>* piece_at(std::span<const PathPiece<Dim>> pieces, double tau) {
    for (const PathPiece<Dim>& piece : pieces)
        if (piece.begin <= tau && tau <= piece.end) return &piece;
    return nullptr;
}

}  // namespace

template <int Dim>
Reconstruction<Dim>::Reconstruction(const ContactOptions& options, Sharing* sharing)
    : quadrature_(quadrature_points<Dim>(options)), shared_(sharing) {}

template <int Dim>
void Reconstruction<Dim>::apply(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
                                const FaceCoupling<Dim>& coupling, const FacePath<Dim>& path, ContactStep<Dim>& result,
                                Cuts cuts) {
    const std::size_t n_faces = path.displacement_0.size();
    result.mean_correction.assign(n_faces, Vector<Dim>::Zero());
    result.mean_gradient.assign(n_faces, Vector<Dim>::Zero());
    result.mean_normal_force.assign(n_faces, 0.0);
    result.energy = 0.0;
    if (active.empty()) return;
    const Step step{surface, list, active, coupling, path, cuts};
    link_faces(step);
    add_mean_corrections(step, result.mean_correction.values());
    result.energy = energy_at_end(step);

    find_pair_gradients(step);
    for (std::int32_t a = 0; a < active.size(); ++a) {
        const auto& [normal, gradient] = pair_gradients_[static_cast<std::size_t>(a)];
        const ListedFace f_1{step.pair(a).listed_1}, f_2{step.pair(a).listed_2};
        result.mean_gradient[f_1] -= gradient;
        result.mean_gradient[f_2] += gradient;
        result.mean_normal_force[f_1] -= normal;
        result.mean_normal_force[f_2] -= normal;
        result.pairs[static_cast<std::size_t>(a)].normal_force = -normal;
        result.pairs[static_cast<std::size_t>(a)].force = -gradient;
    }
}

template <int Dim>
void Reconstruction<Dim>::find_pair_gradients(const Step& step) {
    const auto n = static_cast<std::size_t>(step.active.size());
    pair_gradients_.resize(n);
    const auto find = [&](const IndexRange& range) {
        for_each_run(range, scratch_, [&](std::size_t begin, std::size_t end, Scratch& scratch) {
            for (std::size_t a = begin; a < end; ++a)
                pair_gradients_[a] = pair_gradient(step, static_cast<std::int32_t>(a), scratch);
        });
    };
    if (!shared_.is_worth(n)) return find({0, n});
    const auto of = [&](const IndexRange& range) { return std::span(pair_gradients_).subspan(range.begin, range.size()); };
    shared_.run(
        n,
        [&](const IndexRange& mine, ShareWriter& out) {
            find(mine);
            out.append(std::span<const PairGradient>(of(mine)));
        },
        [&](const IndexRange& range, ShareReader& in) { in.fill(of(range)); });
}

/// Row f of terms_: the active pairs on face f and what their h adds to its correction.
template <int Dim>
void Reconstruction<Dim>::link_faces(const Step& step) {
    const std::size_t n_faces = step.path.displacement_0.size();
    term_offsets_.assign(n_faces + 1, 0);
    const auto for_each_side = [&](auto&& visit) {
        for (std::int32_t a = 0; a < step.active.size(); ++a) {
            const ContactPair<Dim>& pair = step.pair(a);
            if (pair.theta_1 > 0.0) visit(pair.listed_1, Term{a, pair.theta_1 / step.surface.area[pair.face_1]});
            if (pair.theta_2 > 0.0) visit(pair.listed_2, Term{a, -pair.theta_2 / step.surface.area[pair.face_2]});
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
void Reconstruction<Dim>::add_mean_corrections(const Step& step, std::span<Vector<Dim>> mean_correction) {
    const Quadrature rule = gauss_legendre(quadrature_);
    mean_measure_.assign(static_cast<std::size_t>(step.active.size()), 0.0);
    for (std::int32_t a = 0; a < step.active.size(); ++a)
        for (const PathPiece<Dim>& piece : step.active.pieces_of(a))
            for (int k = 0; k < rule.size; ++k)
                mean_measure_[a] += rule.weight[k] * (piece.end - piece.begin) *
                                    piece.correction_measure(piece.begin + (piece.end - piece.begin) * rule.node[k]);
    for (std::size_t f = 0; f < mean_correction.size(); ++f)
        for (std::int32_t t = term_offsets_[f]; t < term_offsets_[f + 1]; ++t)
            mean_correction[f] +=
                terms_[t].weight * mean_measure_[terms_[t].active] * step.pair(terms_[t].active).frame.normal();
}

/// sum_f y_f . delta_f + 1/2 sum_ff' delta_f . Q_ff' delta_f' with all of the end of the step.
template <int Dim>
double Reconstruction<Dim>::energy_at_end(const Step& step) {
    const std::size_t n_faces = step.path.displacement_1.size();
    end_correction_.assign(n_faces, Vector<Dim>::Zero());
    for (std::size_t f = 0; f < n_faces; ++f)
        for (std::int32_t t = term_offsets_[f]; t < term_offsets_[f + 1]; ++t) {
            const PathPiece<Dim>& last = step.active.pieces_of(terms_[t].active).back();
            if (last.end == 1.0)
                end_correction_[f] +=
                    terms_[t].weight * last.correction_measure(1.0) * step.pair(terms_[t].active).frame.normal();
        }
    double energy = 0.0;
    for (std::size_t f = 0; f < n_faces; ++f) {
        if (term_offsets_[f] == term_offsets_[f + 1]) continue;
        Vector<Dim> answer = Vector<Dim>::Zero();  // sum_f' Q_ff' delta_f'
        for (std::int32_t c = step.coupling.offsets[f]; c < step.coupling.offsets[f + 1]; ++c)
            answer += step.coupling.blocks[c] * end_correction_[step.coupling.columns[c]];
        energy += end_correction_[f].dot(step.path.gradient_1[f] + 0.5 * answer);
    }
    return energy;
}

/// scratch.coupled: every active pair whose h enters beta of this pair through the gradients of its faces, and its factor
/// +-theta_i/|f_i| n . Q n' weight'.
template <int Dim>
void Reconstruction<Dim>::collect_coupled(const Step& step, std::int32_t a, Scratch& scratch) const {
    scratch.coupled.clear();
    const auto& coupling = step.coupling;
    const ContactPair<Dim>& pair = step.pair(a);
    const auto add_side = [&](std::int32_t f, double factor) {
        if (factor == 0.0) return;
        for (std::int32_t c = coupling.offsets[f]; c < coupling.offsets[f + 1]; ++c) {
            const Vector<Dim> row_of_normal = factor * (coupling.blocks[c].transpose() * pair.frame.normal());
            const std::int32_t other = coupling.columns[c];
            for (std::int32_t t = term_offsets_[other]; t < term_offsets_[other + 1]; ++t) {
                const Vector<Dim>& n = step.pair(terms_[t].active).frame.normal();
                scratch.coupled.emplace_back(terms_[t].active, terms_[t].weight * row_of_normal.dot(n));
            }
        }
    };
    add_side(pair.listed_1, pair.theta_1 / step.surface.area[pair.face_1]);
    add_side(pair.listed_2, -pair.theta_2 / step.surface.area[pair.face_2]);
}

/// scratch.nodes: the times inside (begin, end) at which beta may change its formula, with both ends, sorted.
template <int Dim>
void Reconstruction<Dim>::collect_cuts(const Step& step, double begin, double end, Scratch& scratch) const {
    scratch.nodes.clear();
    const auto add = [&](std::int32_t a) {
        for (const double cut : step.active.cuts_of(a))
            if (cut > begin && cut < end) scratch.nodes.push_back(cut);
    };
    if (step.cuts == Cuts::global)
        for (std::int32_t a = 0; a < step.active.size(); ++a) add(a);
    else
        for (const auto& [a, factor] : scratch.coupled) add(a);
    sort_and_close(scratch.nodes, begin, end);
}

/// Mean over the step of beta A and of beta (A n + g dA/ds), beta = theta_1 y_1.n/|f_1| - theta_2 y_2.n/|f_2|.
template <int Dim>
typename Reconstruction<Dim>::PairGradient Reconstruction<Dim>::pair_gradient(const Step& step, std::int32_t a,
                                                                              Scratch& scratch) const {
    const ContactPair<Dim>& pair = step.pair(a);
    const Vector<Dim>& n = pair.frame.normal();
    const auto free_beta = [&](std::span<const Vector<Dim>> gradient) {
        return pair.theta_1 / step.surface.area[pair.face_1] * gradient[pair.listed_1].dot(n) -
               pair.theta_2 / step.surface.area[pair.face_2] * gradient[pair.listed_2].dot(n);
    };
    const double beta_0 = free_beta(step.path.gradient_0);
    const double beta_1 = free_beta(step.path.gradient_1);
    collect_coupled(step, a, scratch);

    const Quadrature rule = gauss_legendre(quadrature_);
    double normal = 0.0;
    PlaneVector<Dim> in_plane = PlaneVector<Dim>::Zero();
    for (const PathPiece<Dim>& piece : step.active.pieces_of(a)) {
        collect_cuts(step, piece.begin, piece.end, scratch);
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
                if (const PathPiece<Dim>* at = piece_at(step.active.pieces_of(other), begin + 0.5 * length))
                    for (int k = 0; k < rule.size; ++k) beta[k] += factor * at->correction_measure(tau[k]);
            for (int k = 0; k < rule.size; ++k) {
                const double t = (tau[k] - piece.begin) / (piece.end - piece.begin);
                const double weighted = rule.weight[k] * length * beta[k];
                normal += weighted * polynomial(piece.area, t);
                in_plane += (weighted * polynomial(piece.penetration, t)) * polynomial(piece.area_gradient, t);
            }
        }
    }
    return {normal, normal * n + pair.frame.lift(in_plane)};
}

template class Reconstruction<2>;
template class Reconstruction<3>;

}  // namespace abut::contact
