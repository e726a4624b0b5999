#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/nodal_contact.hpp"
#include "abut/ranks/communicator.hpp"
#include "abut/ranks/nodal_part.hpp"
#include "abut/ranks/point_ranks.hpp"

namespace abut::ranks {

/// contact::NodalContact for a host whose nodes and faces are shared out to several ranks: each gives its own, and gets the
/// forces on its own. With face numbers (NodalPart::face_number) all bits are those of contact::NodalContact on one
/// rank that has the faces in the order of their numbers, for any number of ranks. docs/ranks.md, Nodes of a foreign
/// code.
///
/// Every rank has the whole surface and does all pairs; what is sent in a step are positions, docs/ranks.md says how many.
///
/// All functions but those marked so are calls of all ranks together. What one rank finds wrong ends the call on all of them
/// with an error of the same type. After an exception the step did not happen, as with contact::NodalContact.
template <int Dim>
class SharedNodalContact {
public:
    /// The communicator must outlive it; `options` are the same on all ranks, and `wanted` gives the same answers, for face
    /// numbers. Throws BadInput on all ranks for what contact::NodalSurface and contact::NodalContact refuse, and, naming
    /// ranks, nodes and faces: numbers that are negative or given twice, copies of a node at different positions, options or
    /// stiffnesses that are not those of rank 0, faces with numbers here and without there.
    SharedNodalContact(const Communicator& communicator, const NodalPart<Dim>& part, contact::NodalOptions options = {},
                       CopyForce copies = CopyForce::on_each);
    ~SharedNodalContact();
    SharedNodalContact(SharedNodalContact&&) noexcept;
    SharedNodalContact& operator=(SharedNodalContact&&) noexcept;

    /// Contact along one step that takes `dt` [s], the same on all ranks, and in which the nodes of this rank move from
    /// x_0 to x_1 (n_nodes) [m]. What comes back is the same on all ranks, except for `nodes`, `gradient` and
    /// `least_force_size`, which are of this rank's nodes (indices as in NodalPart::rest): `add_force_to` adds to the
    /// forces of this rank. Faces of `pairs` are face numbers. Throws as contact::NodalContact::step, and BadInput
    /// where copies of a node are farther apart than rounding explains, or ranks give different `dt`.
    const contact::NodalStep<Dim>& step(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1,
                                        contact::TakenForce take = contact::TakenForce::mean);

    /// W and its gradient at one state, as contact::NodalContact::evaluate: cheapest where the last step ended.
    const contact::NodalStep<Dim>& evaluate(PointsView<Dim> x);

    /// As contact::NodalContact::stable_step. `mass`: of each node of this rank (n_nodes) [kg], the whole of it on each rank
    /// that has a copy. Of `omega_free` the largest of all ranks counts. `node` is a node number. Throws BadInput, too,
    /// where copies have different masses.
    [[nodiscard]] contact::NodalStableStep stable_step(std::span<const double> mass, double omega_free) const;

    /// Goes on from what `state` gave, on any number of ranks whose faces have the same numbers: all ranks give the same
    /// bytes. Throws as contact::NodalContact::restore, and BadInput where ranks give different bytes.
    void restore(std::span<const std::byte> state);

    // Not calls of all ranks; they say the same on each

    /// All that the next steps depend on, as bytes that do not depend on the number of ranks.
    [[nodiscard]] std::vector<std::byte> state() const;
    /// The result of the last `step` or `evaluate`.
    [[nodiscard]] const contact::NodalStep<Dim>& last() const;
    [[nodiscard]] const contact::ContactReport& report() const;
    [[nodiscard]] const contact::CandidateReport& search_report() const;
    [[nodiscard]] double skin() const;  ///< of the current list [m]
    /// See contact::NodalSurface::inward_bodies, contact::NodalContact::blind_corners and ::unseen_edges: of the
    /// surface of all ranks.
    [[nodiscard]] std::vector<std::int32_t> inward_bodies() const;
    [[nodiscard]] std::vector<contact::BlindCorner<Dim>> blind_corners() const;
    [[nodiscard]] std::optional<contact::EdgePair<Dim>> unseen_edges() const;
    /// Data exchanged by `step` and `evaluate` so far: gathers and reductions. Bytes are those of this rank.
    [[nodiscard]] const Traffic& traffic() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace abut::ranks
