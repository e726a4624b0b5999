#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "abut/contact/report.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::contact {
template <int Dim>
struct BlindCorner;
template <int Dim>
class Contact;
template <int Dim>
struct EdgePair;
template <int Dim>
class NodalContact;
}  // namespace abut::contact

namespace abut::solid {

template <int Dim>
class Solid;

/// Contact of a solid as it is now (Solid::contact): figures, forces, faces. It is of use as long as the solid lives;
/// without contact all is 0, null or empty.
template <int Dim>
class ContactView {
public:
    explicit ContactView(const Solid<Dim>& solid) : solid_(solid) {}

    /// Figures since the start.
    [[nodiscard]] contact::ContactReport report() const;
    /// Largest |g|/D of a pair in contact, in the last step or in the state that was evaluated since [-].
    [[nodiscard]] double compression() const;
    /// Throws TooDeep, as a step does, where this is more than `compression_limit`.
    void require_depth() const;
    /// Mean force of the last step on an obstacle, with local steps of the common one; after `end_force` that at its end
    /// [N]. Throws Misuse where there is no such obstacle.
    [[nodiscard]] Vector<Dim> obstacle_force(std::size_t obstacle) const;
    /// Impulses of all pairs of bodies that have touched so far, by (body_1, body_2): the force, integrated in time as the
    /// scheme does. The difference of two times over the time between is the mean force.
    [[nodiscard]] std::span<const BodyImpulse<Dim>> impulses() const;

    /// The contact of the law that acts; null under another one.
    [[nodiscard]] const contact::Contact<Dim>* reconstruction() const;
    [[nodiscard]] const contact::NodalContact<Dim>* pair_potential() const;  ///< the same
    [[nodiscard]] double skin() const;                                       ///< of the last candidate list [m]
    /// Boundary face of the mesh that an error of contact names (ErrorFacts::face_1, face_2); `no_face`: it is none, one of
    /// an obstacle, or on other ranks alone.
    [[nodiscard]] BoundaryFace boundary_of_face(std::int64_t face) const;
    /// Corners that are too sharp for contact to see them coming, by the law that acts. Bodies are those of the mesh, then
    /// obstacles. contact/surface/blind_corners.hpp, contact::NodalContact::blind_corners.
    [[nodiscard]] std::vector<contact::BlindCorner<Dim>> blind_corners() const;
    /// Edges of two bodies that would cross unseen. contact/surface/unseen_edges.hpp.
    [[nodiscard]] std::optional<contact::EdgePair<Dim>> unseen_edges() const;

private:
    const Solid<Dim>& solid_;
};

/// Contact in a state that was asked for (Solid::contact_at), until the solid is stepped or evaluated again.
template <int Dim>
class ContactState {
public:
    explicit ContactState(const Solid<Dim>& solid) : solid_(solid) {}

    /// Without contact no face has a partner.
    [[nodiscard]] ContactField field() const;
    /// Admitted pairs that share area and are open by at most `gap` [m].
    [[nodiscard]] std::vector<TouchingPair<Dim>> touching_pairs(double gap) const;
    /// Pairs that push each other.
    [[nodiscard]] std::vector<ActingPair<Dim>> acting_pairs() const;

private:
    const Solid<Dim>& solid_;
};

}  // namespace abut::solid
