#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/contact/pair_store.hpp"
#include "abut/contact/report.hpp"
#include "abut/contact/sharing.hpp"
#include "abut/contact/step.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// How the gradients of a host answer to corrections of these listed faces; asked after each search.
template <int Dim>
using CouplingOf = std::function<FaceCoupling<Dim>(std::span<const Face> faces)>;

/// One step as `Contact::step` wants it from a host.
template <int Dim>
struct HostStep {
    std::span<const Vector<Dim>> displacement_0;  ///< û of all faces of the surface at the start of the step (n_faces) [m]
    std::span<const Vector<Dim>> displacement_1;  ///< the same at its end
    CouplingOf<Dim> coupling_of;
    /// Asked at each step: y_f = dV/ddelta_f at delta = 0, less applied tractions, of the listed faces at both ends
    /// (n_listed) [N]. It is dV/dũ_f - |f| t_f where a correction moves its own face alone.
    std::function<void(std::span<const Face> faces, std::span<Vector<Dim>> gradient_0, std::span<Vector<Dim>> gradient_1)>
        gradients_of;
    TakenForce take = TakenForce::mean;
};

/// The contact of a set of surfaces, for any solver that moves its bodies along straight lines during a step.
///
/// A host calls `step` once per step. It adds `mean_correction` to the displacement of the listed faces in its own force
/// evaluation at the middle of the step, adds `mean_gradient` to dV/dû of these faces, and takes both to its unknowns by the
/// transpose of its reconstruction. docs/embedding.md walks through it; docs/method.md, Contact and Time, has the equations.
///
/// Below it are the calls that `step` is made of, for hosts that know more than one step tells: a bound on the motion that
/// costs less than looking at all faces, gradients at the start of a step that are those at the end of the last one.
///
/// Not safe to use from two threads at once; several objects are independent of each other. After an exception the object
/// stays usable: the step did not happen (its counters may have seen it), and no list holds if it came from a search.
template <int Dim>
class Contact {
public:
    /// Keeps the view: the host's arrays must outlive it, and `sharing` as well, which is null where nobody shares the work.
    /// Throws BadInput naming what is wrong: a surface that `check` refuses, or an option out of range.
    explicit Contact(SurfaceView<Dim> surface, const ContactOptions& options = {}, Sharing* sharing = nullptr);
    ~Contact();
    Contact(Contact&&) noexcept;
    Contact& operator=(Contact&&) noexcept;

    /// Contact along one step that takes `dt` [s], finite and > 0; searches first where the candidate list is no longer
    /// valid. Without friction nothing depends on `dt`. Throws what `search` and `integrate` throw, BadInput for arrays
    /// of the wrong size or a function that is not set.
    const ContactStep<Dim>& step(double dt, const HostStep<Dim>& host);

    /// Whether the candidate list is still a superset of all that can touch, when no face has moved by more than `motion`
    /// [m] since `search`.
    [[nodiscard]] bool is_valid_for(double motion) const;

    /// Makes a new list for a step from u_0 to u_1, both of all faces (n_faces) [m]. Throws what CandidateSearch::search
    /// throws, and BadInput for a coupling that `FaceCoupling` does not allow; no list holds then until a search ends well.
    void search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1, const CouplingOf<Dim>& coupling_of);

    /// Faces of the candidate list, increasing: those whose path the host must give.
    [[nodiscard]] std::span<const Face> faces() const;

    /// Decides admission at the start of a step that takes `dt` [s], finite and > 0, then integrates along it. With
    /// TakenForce::end, for schemes that take the force at the end of a step alone, it takes corrections and pair
    /// forces there: there are no events, and `gradient_0` is not read and may be empty. Throws TooDeep naming the
    /// faces when a pair is pressed in deeper than `compression_limit`, Diverged when the path or a force is not
    /// finite, BadInput for a wrong size or `dt`, Misuse without a list.
    const ContactStep<Dim>& integrate(double dt, const FacePath<Dim>& path, TakenForce take = TakenForce::mean);

    /// Corrections and pair forces of one state (n_listed), as along a path without motion, with the admission as it stands;
    /// counts nothing. Throws as `integrate`, except TooDeep.
    const ContactStep<Dim>& evaluate(std::span<const Vector<Dim>> displacement, std::span<const Vector<Dim>> gradient);

    /// The result of the last of these calls; without pairs and forces after a search.
    [[nodiscard]] const ContactStep<Dim>& last() const;

    /// The admitted pairs of the list that share area when the listed faces have these displacements (n_listed) [m], open or
    /// closed. Throws BadInput for a wrong size, Misuse without a list.
    [[nodiscard]] std::vector<AdmittedOverlap<Dim>> admitted_overlaps(std::span<const Vector<Dim>> displacement) const;

    /// Memory of the listed pairs.
    [[nodiscard]] const PairStore& pair_store() const;

    /// All that the next steps depend on, and the counters of `report`, as bytes: versioned, with a checksum. After
    /// `restore` of an object made for the same surface with the same options the next steps are bitwise identical;
    /// they begin with a search. Throws BadInput, and stays as it is, for bytes that are damaged, of another version,
    /// dimension or surface.
    [[nodiscard]] std::vector<std::byte> state() const;
    void restore(std::span<const std::byte> state);

    /// Goes on, between two steps, where `before` has stopped, which was made for another surface. `old_face_of`: of
    /// each face its number there, -1 for one that was not there (n_faces). Old faces and their pairs keep what they
    /// remember. For those with a new face the run begins: what is pressed in by less than D is a contact. Throws
    /// BadInput, and stays as it is, for numbers out of range or given twice, and where one of both has friction and
    /// the other has not.
    void take_over(const Contact& before, std::span<const std::int32_t> old_face_of);

    [[nodiscard]] const SurfaceView<Dim>& surface() const;
    [[nodiscard]] const ContactReport& report() const;
    void clear_report();  ///< a run begins here: its counts do, while pairs and faces remember what they do
    [[nodiscard]] const CandidateReport& search_report() const;
    [[nodiscard]] double skin() const;                        ///< of the current list [m]
    [[nodiscard]] const FaceCoupling<Dim>& coupling() const;  ///< of the listed faces, as the host gave it

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace abut::contact
