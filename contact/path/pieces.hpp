#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/pair_store.hpp"
#include "abut/contact/pairs/pair_list.hpp"
#include "abut/contact/shared_work.hpp"
#include "abut/contact/step.hpp"

namespace abut::contact {

/// c_0 + c_1 t + c_2 t^2
template <class Value>
[[nodiscard]] Value polynomial(const std::array<Value, 3>& c, double t) {
    return c[0] + t * (c[1] + t * c[2]);
}

/// A pair on the part of the step where it is active, with all that varies as polynomials of a local parameter in [0, 1].
template <int Dim>
struct PathPiece {
    double begin;                                   ///< tau
    double end;                                     ///< tau
    std::array<double, 3> area;                     ///< coefficients of A
    std::array<double, 3> penetration;              ///< coefficients of min(g, 0)
    std::array<PlaneVector<Dim>, 3> area_gradient;  ///< coefficients of dA/ds

    /// h = A min(g, 0), what the pair adds to the corrections of its faces, at a time inside the piece.
    [[nodiscard]] double correction_measure(double tau) const {
        const double t = (tau - begin) / (end - begin);
        return polynomial(area, t) * polynomial(penetration, t);
    }
};

/// A pair along the step: gap and tangential offset are linear.
template <int Dim>
struct PairMotion {
    PairPosition<Dim> at_0;
    PairPosition<Dim> at_1;
    bool overlap_moves;

    [[nodiscard]] double gap(double tau) const { return at_0.gap + tau * (at_1.gap - at_0.gap); }
    [[nodiscard]] PlaneVector<Dim> offset(double tau) const {
        return overlap_moves
                   ? PlaneVector<Dim>(at_0.tangential_offset + tau * (at_1.tangential_offset - at_0.tangential_offset))
                   : at_0.tangential_offset;
    }
    [[nodiscard]] bool overlap_changes() const { return overlap_moves && at_0.tangential_offset != at_1.tangential_offset; }
};

/// The pairs that are active at some time of a step, in the order of the list.
template <int Dim>
struct ActivePairs {
    std::vector<std::int32_t> pairs;          ///< indices into the pair list, increasing (n)
    std::vector<PairMotion<Dim>> motions;     ///< (n)
    std::vector<PathPiece<Dim>> pieces;       ///< of each pair, in the order of time
    std::vector<std::int32_t> piece_offsets;  ///< (n + 1)
    std::vector<double> cuts;                 ///< times inside the step at which a pair changes its formula, increasing
    std::vector<std::int32_t> cut_offsets;    ///< (n + 1)

    [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(pairs.size()); }
    [[nodiscard]] bool empty() const { return pairs.empty(); }
    [[nodiscard]] std::span<const PathPiece<Dim>> pieces_of(std::int32_t a) const {
        return {pieces.data() + piece_offsets[a], static_cast<std::size_t>(piece_offsets[a + 1] - piece_offsets[a])};
    }
    [[nodiscard]] std::span<const double> cuts_of(std::int32_t a) const {
        return {cuts.data() + cut_offsets[a], static_cast<std::size_t>(cut_offsets[a + 1] - cut_offsets[a])};
    }
};

/// Cuts a step into pieces: each pair where its own formula changes. An instance keeps its work arrays from step to step;
/// after a few steps it allocates nothing. Parts that share contact find the pieces of as many penetrating pairs each.
template <int Dim>
class PieceFinder {
public:
    explicit PieceFinder(const ContactOptions& options, Sharing* sharing = nullptr);

    /// The active ones among the admitted pairs along the straight path from u_0 to u_1, displacements of the listed faces
    /// [m]; `memory` is in the order of the list.
    const ActivePairs<Dim>& find(const SurfaceView<Dim>& surface, const PairList<Dim>& list,
                                 std::span<const PairMemory> memory, std::span<const Vector<Dim>> u_0,
                                 std::span<const Vector<Dim>> u_1);

private:
    struct Penetrating {  // an admitted pair with g < 0 at some time of the step
        std::int32_t pair;
        PairMotion<Dim> motion;
    };
    struct Found {                              // what a run of penetrating pairs gave; runs are joined in order
        std::vector<std::int32_t> penetrating;  // indices into penetrating_
        std::vector<PathPiece<Dim>> pieces;
        std::vector<std::int32_t> n_pieces;
        std::vector<double> cuts;
        std::vector<std::int32_t> n_cuts;
        std::vector<double> events;  // work array
    };

    void find_penetrating(const SurfaceView<Dim>& surface, const PairList<Dim>& list, std::span<const PairMemory> memory,
                          std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1);
    void append_pair(const PairList<Dim>& list, std::int32_t penetrating, Found& found) const;
    void append_piece(const PairList<Dim>& list, const ContactPair<Dim>& pair, const PairMotion<Dim>& motion, double begin,
                      double end, Found& found) const;
    void append_sampled_piece(const PairList<Dim>& list, const ContactPair<Dim>& pair, const PairMotion<Dim>& motion,
                              Found& found) const;
    [[nodiscard]] std::span<const Found> find_pieces(const PairList<Dim>& list, const IndexRange& of_penetrating);
    void clear_active();
    void append(const Found& found);
    static void write(const Found& found, ShareWriter& out);
    void read(ShareReader& in);

    ContactOptions options_;
    SharedWork shared_;
    std::vector<Penetrating> penetrating_;
    std::vector<Found> found_;  // by run of penetrating pairs
    Found received_;            // one of those of another part
    ActivePairs<Dim> active_;
};

/// Points per subinterval for these options: as many as exactness needs where they leave it open.
template <int Dim>
[[nodiscard]] int quadrature_points(const ContactOptions& options) {
    return options.quadrature == 0 ? Dim : options.quadrature;
}

}  // namespace abut::contact
