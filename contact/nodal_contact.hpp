#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/interference.hpp"
#include "abut/contact/nodal_step.hpp"
#include "abut/contact/options.hpp"
#include "abut/contact/report.hpp"
#include "abut/contact/sharing.hpp"
#include "abut/contact/surface/blind_corners.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/contact/surface/unseen_edges.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::contact {

struct NodalOptions {
    CandidateOptions search;  ///< `facing_cosine` has no effect: see `facing`
    /// How pairs fade out as faces turn away from each other. A `none` nearer to 0 lets sharper edges meet that cross, and
    /// faces around a corner act that look past the other body.
    geometry::FacingFade facing;
    bool events = true;                ///< look closer at a step where that is needed (geometry::PairPathOptions)
    bool gauss = false;                ///< integrate the forces of all pairs by Gauss's rule (geometry::PairPathOptions)
    double compression_warning = 0.3;  ///< |g|/D above which a step is counted as strongly compressed
    double compression_limit = 2.0;    ///< |g|/D above which the step is refused with an error
    FrictionOptions friction;          ///< needs `NodalFaces::shear_stiffness`
    InterferenceOptions interference;
    /// Piece of each body, which those have in common that were one or are bonded, -1: none (n_bodies); empty: no pieces.
    /// Faces of a piece that lie inside of each other at rest are no contact until they have been seen from outside.
    std::vector<std::int32_t> pieces;
    /// Which pairs of faces of the host may touch, beside the bodies they belong to; empty: all. What it says may change
    /// between two searches. A pair of two bodies that lies inside of each other when it is wanted for the first time is a
    /// contact whose overlap at that moment does not act, until it has been apart.
    std::function<bool(Face, Face)> wanted;
    /// Energy per area [J/m^2], >= 0, that such a pair has at that moment: what held the faces together pressed them with
    /// it. Only so much of the overlap is idle; where all of it holds less, none is. Empty: 0.
    std::function<double(Face, Face)> energy_at_first;
    /// Which faces of the host nothing can touch, as between bodies that are bonded there; empty: none. They cost a search
    /// nothing. What it says may change between two searches, and pairs of a face that is laid bare are wanted from then on.
    std::function<bool(Face)> covered;
};

/// n_1 . n_2 at which the weight of a pair is a quarter: what looks at each other less is pressed in deeper than others, or
/// passes.
[[nodiscard]] double quarter_weight_cosine(const geometry::FacingFade& facing);

/// How long a step may be. An estimate, no bound: a face at a corner may meet several partners at once.
struct NodalStableStep {
    double dt;           ///< 0.85 * 2 / omega [s]
    double omega;        ///< with contact [rad/s]
    double omega_free;   ///< without, as the host gave it
    std::int32_t node;   ///< whose contact raises omega most; -1: nothing can touch
    std::string reason;  ///< a sentence for people
};

/// The contact of bodies whose surfaces are made of nodes, and whose faces may turn: finite elements and nearly all other
/// solvers. Every pair of facing facets has a potential W of its corners (geometry::pair_mean_gradient): the spring of the
/// half elements behind both, over their overlap. In the plane a corner below 60 degrees has a facet of its own across
/// the tip. H~, momentum and angular momentum are kept to round-off by MEMM, for steps of any size; other schemes take
/// the force at the end of the step.
///
/// A host calls `step` once per step, with its nodes at both ends, and adds the forces to its own. Obstacles are bodies with
/// infinite stiffness, whose nodes the host places where it wants (`Placement` turns and shifts). docs/embedding.md walks
/// through it; docs/method.md, The potential of a pair, has the equations.
///
/// Not safe to use from two threads at once; several objects are independent of each other. After an exception the step did
/// not happen (counters may have seen it, and `last` holds nothing of use).
template <int Dim>
class NodalContact {
public:
    /// `sharing` must outlive it; null: nobody shares the work. Throws BadInput for an option out of range.
    explicit NodalContact(NodalSurface<Dim> surface, NodalOptions options = {}, Sharing* sharing = nullptr);
    ~NodalContact();
    NodalContact(NodalContact&&) noexcept;
    NodalContact& operator=(NodalContact&&) noexcept;

    /// Contact along one step that takes `dt` [s], finite and > 0, and in which the nodes move from x_0 to x_1
    /// (n_nodes) [m] on straight lines. Without friction nothing depends on `dt`. Searches first where the candidate
    /// list is not valid. Throws BadInput for a wrong `dt` or number of nodes, Diverged for a node that is not finite
    /// or moves too far, and for a force that is not finite (a face loses its area within the step), TooDeep for a pair that
    /// is deeper than `compression_limit`, both naming the faces, LimitExceeded for a search that takes more than it may.
    const NodalStep<Dim>& step(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take = TakenForce::mean);

    /// W and its gradient at one state, with the admission as it stands: for V(q) and F(q) of a host between two steps, at
    /// any x. Changes nothing that the next steps depend on; only before the first step the run begins at x. Cheap where the
    /// candidate list holds, as where the last step ended; it searches for each call elsewhere. Throws as `step`, except
    /// TooDeep.
    const NodalStep<Dim>& evaluate(PointsView<Dim> x);

    // What `step` and `evaluate` are made of, for a host to which a bound on the motion costs less than all its nodes.

    /// Whether the candidate list is still a superset of all that can touch, when no node of a face is farther than `motion`
    /// [m] from where the step began that was last searched for.
    [[nodiscard]] bool is_valid_for(double motion) const;
    /// Farthest that what acts reaches beyond the faces of the surface, at rest [m]: half the width of a facet across a
    /// sharp corner, 0 without any; and how far its ends move at most when no node moves by more than 1.
    [[nodiscard]] double bevel_width() const;
    [[nodiscard]] double bevel_stretch() const;
    /// Makes a new list for a step from x_0 to x_1; throws as `step`. The list holds for that step, however long it is.
    void search(PointsView<Dim> x_0, PointsView<Dim> x_1);
    /// Ends the list after a change of what `NodalOptions::wanted`, `covered` or `energy_at_first` answer. `step` makes a
    /// new one, `evaluate` one for itself; `step_listed` and `evaluate_listed` throw Misuse until `search`.
    void end_list();
    /// Like `step` and `evaluate`, without checking that the list is valid: they read the nodes of the list alone,
    /// `last().nodes`. Throw Misuse without a list.
    const NodalStep<Dim>& step_listed(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1,
                                      TakenForce take = TakenForce::mean);
    const NodalStep<Dim>& evaluate_listed(PointsView<Dim> x);

    /// Deepest overlap of each of `NodalOptions::interference` where the run began [m]; empty before.
    [[nodiscard]] std::span<const double> interference() const;

    /// The result of the last of these calls.
    [[nodiscard]] const NodalStep<Dim>& last() const;

    /// `mass`: of each node (n_nodes) [kg]; `omega_free`: the highest frequency of the host without contact [rad/s]. Throws
    /// BadInput for a mass of a node of a deformable face that is not > 0, or a frequency that is not >= 0.
    [[nodiscard]] NodalStableStep stable_step(std::span<const double> mass, double omega_free) const;

    /// Corners so sharp that pairs with a flat face that comes straight at them have less than a quarter of their weight
    /// (`NodalOptions::facing`; by default tips of 38 degrees and less in 2D), and that have no bevel: bodies go
    /// through each other there, or leave much too fast. To be asked once, where positions are those at rest.
    [[nodiscard]] std::vector<BlindCorner<Dim>> blind_corners() const;

    /// Bodies whose sharpest edges have less than a quarter of the weight of flat sides where they cross
    /// (`NodalOptions::facing`; by default edges of 70 degrees and less): they press in deeper than others, or go through
    /// each other until a step is refused. Nothing in 2D. To be asked once, where positions are those at rest.
    [[nodiscard]] std::optional<EdgePair<Dim>> unseen_edges() const;

    /// All that the next steps depend on, and the counters of `report`, as bytes: versioned, with a checksum. After
    /// `restore` of an object made for the same surface with the same options the next steps have the same bits. Throws
    /// BadInput, and stays as it is, for bytes that are damaged, of another version, dimension or surface.
    [[nodiscard]] std::vector<std::byte> state() const;
    void restore(std::span<const std::byte> state);

    /// Goes on with another surface of the same nodes or of others, between two steps: faces have eroded, and what was
    /// behind them is a face now. `old_face_of`: of each new face that was there before, its old number, else -1 (n_faces).
    /// Old faces, with their corners in the same order, and their pairs keep what they remember. For those with a new
    /// face the run begins: what is pressed in by less than D is a contact, and W jumps by what `evaluate` tells before
    /// and after. Throws BadInput, and stays as it is, for numbers out of range or given twice.
    void surface_replaced(NodalSurface<Dim> surface, std::span<const std::int32_t> old_face_of);
    /// As `surface_replaced`, for an object that was made for the new surface, which may have options of its own: it
    /// goes on where `before` has stopped. Throws BadInput, too, where one of both has friction or interference and the
    /// other has not.
    void take_over(const NodalContact& before, std::span<const std::int32_t> old_face_of);

    [[nodiscard]] const NodalSurface<Dim>& surface() const;
    [[nodiscard]] const ContactReport& report() const;
    void clear_report();  ///< a run begins here: its counts do, while pairs and faces remember what they do
    [[nodiscard]] const CandidateReport& search_report() const;
    [[nodiscard]] double skin() const;  ///< of the current list [m]

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace abut::contact
