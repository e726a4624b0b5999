#include "abut/contact/path/measures.hpp"

#include <algorithm>

namespace abut::contact {
namespace {

constexpr double far_tilt_cosine = 0.93969262078590843;  // of 20 degrees

template <int Dim>
PairStep<Dim> geometry_of(const ContactPair<Dim>& pair, const ActivePairs<Dim>& active, std::int32_t a) {
    const PairMotion<Dim>& motion = active.motions[static_cast<std::size_t>(a)];
    double area = 0.0, share = 0.0;
    for (const PathPiece<Dim>& piece : active.pieces_of(a)) {
        const double length = piece.end - piece.begin;
        area += length * (piece.area[0] + piece.area[1] / 2.0 + piece.area[2] / 3.0);
        share += length;
    }
    return {.face_1 = Face{pair.face_1},
            .face_2 = Face{pair.face_2},
            .normal = pair.frame.normal(),
            .gap_0 = motion.at_0.gap,
            .gap_1 = motion.at_1.gap,
            .area = area,
            .normal_force = 0.0,
            .force = Vector<Dim>::Zero(),
            .events = static_cast<std::int32_t>(active.cuts_of(a).size()),
            .active_share = share,
            .compression = -std::min(motion.at_0.gap, motion.at_1.gap) / pair.admission_depth};
}

template <int Dim>
bool is_tilted(const SurfaceView<Dim>& surface, const ContactPair<Dim>& pair) {
    const Vector<Dim>& n = pair.frame.normal();
    return n.dot(surface.normal[pair.face_1]) < far_tilt_cosine && -n.dot(surface.normal[pair.face_2]) < far_tilt_cosine;
}

}  // namespace

template <int Dim>
void PathMeasures<Dim>::fill(const SurfaceView<Dim>& surface, const PairList<Dim>& list, const ActivePairs<Dim>& active,
                             ContactStep<Dim>& step) {
    step.report = {.events = static_cast<std::int64_t>(active.cuts.size())};
    step.pairs.clear();
    slipped_.clear();
    for (std::int32_t a = 0; a < active.size(); ++a) {
        const ContactPair<Dim>& pair = list[active.pairs[static_cast<std::size_t>(a)]];
        step.pairs.push_back(geometry_of(pair, active, a));
        if (const double compression = step.pairs.back().compression; compression > step.report.compression) {
            step.report.compression = compression;
            step.report.most_compressed = a;
        }
        if (is_tilted(surface, pair)) ++step.report.tilted_pairs;
        const double face = std::min(surface.area[pair.face_1], surface.area[pair.face_2]);
        for (const PathPiece<Dim>& piece : active.pieces_of(a))
            for (const double t : {0.0, 1.0})
                step.report.sliding_ratio =
                    std::max(step.report.sliding_ratio,
                             -polynomial(piece.penetration, t) * polynomial(piece.area_gradient, t).norm() / face);
        const PairMotion<Dim>& motion = active.motions[static_cast<std::size_t>(a)];
        const double gap_0 = motion.at_0.gap, gap_1 = motion.at_1.gap;
        const double opened = gap_1 < 0.0 ? 1.0 : gap_0 / (gap_0 - gap_1);
        const double parted = active.pieces_of(a).back().end;
        if (parted < opened) slipped_.push_back({a, -motion.gap(parted) / pair.admission_depth});
    }
    if (!slipped_.empty()) discard_supported(surface, list, active, step.faces.size());
    step.report.slipped_pairs = static_cast<std::int64_t>(slipped_.size());
    for (const Slipped& slipped : slipped_)
        step.report.slipped_compression = std::max(step.report.slipped_compression, slipped.compression);
}

/// Takes out of `slipped_` the pairs of which a face has another partner at the end of the step. A face of an obstacle may
/// hold many and supports none.
template <int Dim>
void PathMeasures<Dim>::discard_supported(const SurfaceView<Dim>& surface, const PairList<Dim>& list,
                                          const ActivePairs<Dim>& active, std::size_t n_faces) {
    supported_.assign(n_faces, 0);
    const auto pair_of = [&](std::int32_t a) -> const ContactPair<Dim>& {
        return list[active.pairs[static_cast<std::size_t>(a)]];
    };
    for (std::int32_t a = 0; a < active.size(); ++a) {
        const PathPiece<Dim>& last = active.pieces_of(a).back();
        if (last.end < 1.0 || !(polynomial(last.penetration, 1.0) < 0.0)) continue;
        const ContactPair<Dim>& pair = pair_of(a);
        if (!surface.is_rigid(pair.face_1)) supported_[static_cast<std::size_t>(pair.listed_1)] = 1;
        if (!surface.is_rigid(pair.face_2)) supported_[static_cast<std::size_t>(pair.listed_2)] = 1;
    }
    std::erase_if(slipped_, [&](const Slipped& slipped) {
        const ContactPair<Dim>& pair = pair_of(slipped.active);
        return supported_[static_cast<std::size_t>(pair.listed_1)] || supported_[static_cast<std::size_t>(pair.listed_2)];
    });
}

template class PathMeasures<2>;
template class PathMeasures<3>;

}  // namespace abut::contact
