#pragma once
#include <cstdint>
#include <vector>

#include "abut/base/ids.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// Which force of a step a scheme takes.
enum class TakenForce {
    mean,  ///< the exact mean along the straight path: MEMM
    end,   ///< that at the end of the step: central differences, Bilbao. What opens and closes inside the step is not seen
};

/// How the energy gradients of a host's faces answer to corrections: y_f = y_free,f + sum_f' Q_ff' delta_f', among the
/// listed faces (`Contact::faces`). Row f holds f itself and all faces that share an energy term with it: the other boundary
/// faces of its cell, those of cells that share a stabilised interior face with it. Rows of rigid faces may be empty. Q_ff'
/// = d²V/ddelta_f ddelta_f': finite, Q_f'f the transpose of Q_ff', no eigenvalue of Q_ff below 0 (both within 1e-10 of the
/// largest entry of these blocks; all zero is allowed). A search refuses anything else with BadInput naming the face.
template <int Dim>
struct FaceCoupling {
    std::vector<std::int32_t> offsets{0};  ///< (n + 1)
    std::vector<std::int32_t> columns;     ///< indices into the list of faces, increasing in each row
    std::vector<Matrix<Dim>> blocks;       ///< Q_ff' [N/m]
};

/// Data of the listed faces at the two ends of a step, given by the host; displacements and gradients are linear in between.
template <int Dim>
struct FacePath {
    std::span<const Vector<Dim>> displacement_0;  ///< û_f at the start (n) [m]
    std::span<const Vector<Dim>> displacement_1;  ///< û_f at the end (n) [m]
    std::span<const Vector<Dim>>
        gradient_0;  ///< y_free,f = dV/ddelta_f at delta = 0, as HostStep asks, at the start (n) [N]
    std::span<const Vector<Dim>> gradient_1;  ///< the same at the end (n) [N]
};

/// Result of one pair of faces in a step: a pair with A > 0 and g < 0 at some time of it.
template <int Dim>
struct PairStep {
    Face face_1;
    Face face_2;
    Vector<Dim> normal;   ///< n_12, unit, from the body of face 1 into that of face 2
    double gap_0;         ///< g at the start of the step [m], > 0 apart
    double gap_1;         ///< g at its end [m]
    double area;          ///< A_12, mean over the step, 0 where the pair is not active [m^(Dim-1)]
    double normal_force;  ///< -beta A, mean over the step [N], > 0 in compression
    Vector<Dim> force;    ///< on face 2, mean over the step, friction included [N]; face 1 feels the opposite
    std::int32_t events;  ///< openings, closings and changes of the overlap inside the step
    double active_share;  ///< part of the step in which the pair is active [-], 0 to 1
    double compression;   ///< largest |g|/D at the ends of the step [-]
    Vector<Dim> friction = Vector<Dim>::Zero();  ///< part of `force` that is friction [N]
    Vector<Dim> slip =
        Vector<Dim>::Zero();  ///< motion of face 2 past face 1 along both, where there is friction; of a step alone [m]
    Vector<Dim> point = Vector<Dim>::Zero();  ///< where friction acts, at the middle of the step [m]
};

/// Friction of one face in a step: of a facet, where a face has two. An evaluation of one state knows the face and the slip.
struct FaceFriction {
    Face face;
    double normal_force =
        0.0;             ///< that its friction is of [N]: half of that on the face, all of it where the partner is rigid
    double force = 0.0;  ///< along the face, mean over the step [N]
    double limit = 0.0;  ///< at which it slides [N]
    double slip = 0.0;   ///< in the last step [m]; 0: it stuck
    double dissipated = 0.0;  ///< in this step [J]
};

/// Figures of friction in a step; all 0 without any. Energy and dissipation close the balance of a host: H~ with
/// `energy` in V, plus the sum of `dissipated`, less the work from outside, stays what it was.
struct FrictionFigures {
    double energy = 0.0;            ///< E of all springs by which faces stick, at the end of the step [J]
    double dissipated = 0.0;        ///< D in the step [J]
    double least_dissipated = 0.0;  ///< of one face [J]: < 0 by rounding alone under MEMM
    std::int64_t sticking = 0;      ///< faces
    std::int64_t sliding = 0;       ///< faces
    double largest_ratio = 0.0;     ///< of the force of a face over its limit [-]
    double sliding_force = 0.0;     ///< sum over the faces that slide [N]
    double sliding_limit = 0.0;     ///< the same of their limits [N]; far above: their slip alternates from step to step
};

/// Figures of a step as a whole.
struct StepReport {
    std::int64_t events = 0;            ///< of all pairs
    double compression = 0.0;           ///< largest |g|/D of an active pair at the ends of the step
    std::int32_t most_compressed = -1;  ///< which pair it is, in `pairs` of the step; -1: none
    /// Largest |g| |dA/ds| over the smaller face of an active pair, at the ends of its pieces: the force of sliding over
    /// that which the whole face would carry. This and the next two are of the modified reconstruction; 0 on nodes.
    double sliding_ratio = 0.0;
    /// Pairs whose faces slid off each other in this step while pressed in, and neither of which (except for faces of
    /// obstacles) has another partner at its end. Seen where the overlap moves and events are looked for; not where the area
    /// comes to its end just when the step does.
    std::int64_t slipped_pairs = 0;
    double slipped_compression = 0.0;  ///< their largest |g|/D when the overlap came to its end
    /// Active pairs whose normal is more than 20 degrees away from those of both faces: edges on edges, and coarse round
    /// bodies. Their force has a part along the faces.
    std::int64_t tilted_pairs = 0;
    /// Correction of the pair potential that closes the balance of energy, over the forces of all pairs. Beyond 1e-3
    /// the step is too long to follow the pairs.
    double correction = 0.0;
    FrictionFigures friction;
};

/// Result of contact in one step, as a value: arrays by listed face, active pairs, figures. Without an active pair all is
/// zero.
template <int Dim>
struct ContactStep {
    std::vector<Face> faces;                            ///< the listed faces, increasing (n)
    IdVector<ListedFace, Vector<Dim>> mean_correction;  ///< mean over the step of delta_f (n) [m]
    /// Mean over the step of what the pairs add to dV/dû_f (n) [N]; on a rigid face: minus the force on the obstacle.
    IdVector<ListedFace, Vector<Dim>> mean_gradient;
    IdVector<ListedFace, double> mean_normal_force;  ///< of all pairs of a face (n) [N], > 0 in compression
    std::vector<PairStep<Dim>> pairs;                ///< the active ones, by (face_1, face_2)
    /// Energy that the corrections add to the host's energy at the end of the step: sum y . delta + 1/2 sum delta . Q
    /// delta [J].
    double energy = 0.0;
    std::vector<FaceFriction> friction;  ///< of each face with friction in the last step, increasing
    StepReport report;

    [[nodiscard]] bool is_active() const { return !pairs.empty(); }
};

/// Two faces of an admitted pair that share area in some state.
template <int Dim>
struct AdmittedOverlap {
    Face face_1;
    Face face_2;
    Vector<Dim> normal;  ///< n_12
    double gap;          ///< g [m]
    double area;         ///< A_12 [m^(Dim-1)], > 0
};

}  // namespace abut::contact
