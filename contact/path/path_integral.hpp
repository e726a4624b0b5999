#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/contact/pairs.hpp"

namespace abut::contact {

/// How the face forces of a host answer to a correction: y_f = y_free,f + sum_f' Q_ff' delta_f', among the faces of the
/// current candidate list, in its numbering (`Contact::faces`). Row f holds f itself and all faces that share an energy
/// term with it: the other boundary faces of its cell, those of cells that share a stabilised interior face with it.
template <int Dim>
struct FaceCoupling {
    std::vector<std::int32_t> offsets{0};  ///< (n + 1)
    std::vector<std::int32_t> columns;     ///< increasing in each row
    std::vector<Matrix<Dim>> blocks;       ///< Q_ff' [N/m]
};

/// What a host says of the listed faces at the two ends of a step; displacements and forces are linear in between.
template <int Dim>
struct FacePath {
    std::span<const Vector<Dim>> displacement_0;  ///< û_f at the start (n) [m]
    std::span<const Vector<Dim>> displacement_1;  ///< û_f at the end (n) [m]
    std::span<const Vector<Dim>> force_0;         ///< y_free,f = dV/dũ_f at ũ = û, less |f| t_f, at the start (n) [N]
    std::span<const Vector<Dim>> force_1;         ///< the same at the end (n) [N]
};

/// A pair on the part of the step where it is active, with all that varies as polynomials of a local parameter in [0, 1].
template <int Dim>
struct PathPiece {
    double begin;                                      ///< tau
    double end;                                        ///< tau
    std::array<double, 3> area;                        ///< coefficients of A
    std::array<double, 3> depth;                       ///< coefficients of min(g, 0)
    std::array<PlaneVector<Dim>, 3> shift_derivative;  ///< coefficients of dA/ds
};

/// A pair whose faces have slid off each other while they were pressed in.
struct SlippedPair {
    std::int32_t pair;   ///< place in the pair list
    double compression;  ///< |g|/D when the shared area came to an end
};

/// Where a pair force is cut into subintervals.
enum class Cuts {
    coupled,  ///< at the events of all pairs that its face forces depend on: exact, and local
    global,   ///< at the events of all pairs of the scene: the reference that `coupled` is tested against
};

/// Integrates the modified reconstruction and the pair forces along one straight step, exactly: each pair is cut where its
/// own formula changes, each pair force where the formula of any pair coupled to it does. docs/method.md, Time.
///
/// An instance keeps its work arrays from step to step; after a few steps it allocates nothing.
template <int Dim>
class PathIntegral {
public:
    explicit PathIntegral(const ContactOptions& options);

    /// Fills the results below for one step. `local_face` maps a face of the surface to its place in the path.
    void integrate(const SurfaceView<Dim>& surface, const PairList<Dim>& pairs, std::span<const std::int32_t> local_face,
                   const FaceCoupling<Dim>& coupling, const FacePath<Dim>& path, Cuts cuts = Cuts::coupled);

    /// Mean over the step of delta_f = ũ_f - û_f (n) [m].
    [[nodiscard]] std::span<const Vector<Dim>> mean_correction() const { return mean_correction_; }
    /// Mean over the step of the pair forces' part of dV/dû_f (n) [N]; on a rigid face: minus the force on the obstacle.
    [[nodiscard]] std::span<const Vector<Dim>> mean_force() const { return mean_force_; }
    /// Mean over the step of the normal force -sum beta A of each face (n) [N], > 0 in compression.
    [[nodiscard]] std::span<const double> mean_normal_force() const { return mean_normal_force_; }
    /// Pairs that were active at some time of the step: their indices in the pair list, increasing.
    [[nodiscard]] std::span<const std::int32_t> active_pairs() const { return active_; }
    [[nodiscard]] std::int64_t events() const { return static_cast<std::int64_t>(cuts_.size()); }
    /// Largest |g|/D of an active pair at the ends of the step, and which pair (-1: none).
    [[nodiscard]] double compression() const { return compression_; }
    [[nodiscard]] std::int32_t most_compressed() const { return most_compressed_; }
    /// Largest |g| |dA/ds| over the smaller face of an active pair, at the ends of its pieces: the force of sliding over that
    /// which the whole face would carry.
    [[nodiscard]] double sliding_ratio() const { return sliding_ratio_; }
    /// Pairs whose faces slid off each other in this step while pressed in, and neither of which (but for faces of obstacles)
    /// has another partner at its end. Seen where the overlap moves and events are looked for; not where the area comes to
    /// its end just when the step does.
    [[nodiscard]] std::span<const SlippedPair> slipped() const { return slipped_; }

private:
    using Position = PairPosition<Dim>;
    struct Motion {  // of a pair along the step
        Position at_0;
        Position at_1;
        bool overlap_moves;

        [[nodiscard]] double gap(double tau) const { return at_0.gap + tau * (at_1.gap - at_0.gap); }
        [[nodiscard]] PlaneVector<Dim> shift(double tau) const {
            return overlap_moves ? PlaneVector<Dim>(at_0.shift + tau * (at_1.shift - at_0.shift)) : at_0.shift;
        }
        [[nodiscard]] bool overlap_changes() const { return overlap_moves && at_0.shift != at_1.shift; }
    };
    struct Closing {  // an admitted pair with g < 0 at some time of the step
        std::int32_t pair;
        Motion motion;
    };
    struct Found {  // what a run of closing pairs gave; runs are joined in order
        std::vector<std::int32_t> active;
        std::vector<PathPiece<Dim>> pieces;
        std::vector<std::int32_t> n_pieces;
        std::vector<double> cuts;
        std::vector<std::int32_t> n_cuts;
        std::vector<double> events;  // work array
    };
    struct Term {             // one active pair on a face
        std::int32_t active;  // place in active_
        double weight;        // delta_f += weight h n_12, h = A min(g, 0)
    };
    struct Scratch {
        std::vector<std::pair<std::int32_t, double>> coupled;  // (active pair, what its h adds to beta)
        std::vector<double> nodes;
    };
    struct PairForce {
        double normal_force;  // mean of beta A
        Vector<Dim> force;    // mean of beta (A n + g dA/ds)
    };
    /// What stays the same while one step is integrated.
    struct Step {
        const SurfaceView<Dim>& surface;
        const PairList<Dim>& pairs;
        std::span<const std::int32_t> local_face;
        const FaceCoupling<Dim>& coupling;
        const FacePath<Dim>& path;
        Cuts cuts;
    };

    void find_closing(const Step& step);
    void find_active(const Step& step);
    void append_pair(const PairList<Dim>& pairs, const Closing& closing, Found& found) const;
    void append_piece(const PairList<Dim>& pairs, const ContactPair<Dim>& pair, const Motion& motion, double begin,
                      double end, Found& found) const;
    void append_sampled_piece(const PairList<Dim>& pairs, const ContactPair<Dim>& pair, const Motion& motion,
                              Found& found) const;
    void join_found();
    void measure_active(const Step& step);
    void drop_carried(const Step& step);
    [[nodiscard]] const PathPiece<Dim>& last_piece(std::size_t active) const {
        return pieces_[piece_offsets_[active + 1] - 1];
    }
    void link_faces(const Step& step);
    void add_mean_corrections(const PairList<Dim>& pairs);
    [[nodiscard]] PairForce pair_force(const Step& step, std::int32_t active, Scratch& scratch) const;
    void collect_coupled(const Step& step, std::int32_t active, Scratch& scratch) const;
    void collect_cuts(double begin, double end, Cuts cuts, Scratch& scratch) const;

    ContactOptions options_;
    std::vector<Closing> closing_;
    std::vector<Found> found_;  // by run of closing pairs
    std::vector<std::int32_t> active_;
    std::vector<PathPiece<Dim>> pieces_;
    std::vector<std::int32_t> piece_offsets_;  // (n_active + 1)
    std::vector<double> cuts_;                 // events of each active pair inside the step, sorted
    std::vector<std::int32_t> cut_offsets_;    // (n_active + 1)
    std::vector<std::int32_t> term_offsets_;   // (n + 1)
    std::vector<Term> terms_;
    std::vector<double> mean_measure_;    // mean of h, by active pair
    std::vector<PairForce> pair_forces_;  // by active pair
    std::vector<Scratch> scratch_;        // by run of active pairs
    std::vector<Vector<Dim>> mean_correction_;
    std::vector<Vector<Dim>> mean_force_;
    std::vector<double> mean_normal_force_;
    double compression_ = 0.0;
    std::int32_t most_compressed_ = -1;
    double sliding_ratio_ = 0.0;
    std::vector<SlippedPair> slipped_;
    std::vector<char> carried_;  // whether a face has a partner at the end of the step
};

}  // namespace abut::contact
