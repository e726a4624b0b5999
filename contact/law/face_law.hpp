#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/contact/law/face_friction.hpp"
#include "abut/contact/law/reconstruction.hpp"
#include "abut/contact/pair_store.hpp"
#include "abut/contact/pairs/admission.hpp"
#include "abut/contact/pairs/pair_list.hpp"
#include "abut/contact/path/measures.hpp"
#include "abut/contact/path/pieces.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/contact/surface/face_name.hpp"
#include "abut/contact/surface/facet_store.hpp"

namespace abut::contact {

/// The law of Contact as the engine wants it: faces that translate, under the modified reconstruction. Each face is a facet.
/// docs/method.md, Contact.
template <int Dim>
class FaceLaw {
public:
    static constexpr int dimension = Dim;
    using State = std::span<const Vector<Dim>>;  ///< displacements of all faces (n_faces) [m]
    struct Path {
        FacePath<Dim> faces;
        TakenForce take;  ///< with `end`, gradients at the start are not read
    };
    using Step = ContactStep<Dim>;

    FaceLaw(const SurfaceView<Dim>& surface, const ContactOptions& options, Sharing* sharing);

    [[nodiscard]] std::string name() const { return "contact"; }
    [[nodiscard]] const SurfaceView<Dim>& facets() const { return surface_; }
    [[nodiscard]] std::string face_name(Face face) const { return contact::face_name(surface_, number_of(face)); }
    [[nodiscard]] std::int32_t facet_memory() const { return friction_.memory(); }
    [[nodiscard]] double stored_energy(const FacetStore& facets) const { return friction_.stored_energy(facets); }
    [[nodiscard]] std::ptrdiff_t n_watched() const { return surface_.size(); }
    [[nodiscard]] const Vector<Dim>& position(State u, std::ptrdiff_t face) const {
        return u[static_cast<std::size_t>(face)];
    }

    void search(CandidateSearch<Dim>& candidates, State u_0, State u_1) const { candidates.search(u_0, u_1); }
    [[nodiscard]] bool is_wanted(FacetPair) const { return true; }
    void list(std::span<const FacetPair> pairs, std::span<const FacetPair> in_contact, State u_0, double reach);
    void list_remembered(std::span<const FacetPair> pairs);
    void drop_list() { faces_.clear(); }
    [[nodiscard]] bool is_pressed_in(std::size_t pair, State u) const;
    [[nodiscard]] FirstLook decide_first(std::size_t pair, State u, bool run_begins) const;

    void clear(ContactStep<Dim>& step) const;
    std::int64_t step(double dt, const Path& path, std::span<PairMemory> memory, FacetStore& facets, ContactStep<Dim>& step);
    /// `state`: a path of the listed faces without motion.
    void evaluate(const FacePath<Dim>& state, std::span<const PairMemory> memory, const FacetStore& facets,
                  ContactStep<Dim>& step);

    /// Faces of the list, increasing.
    [[nodiscard]] std::span<const Face> faces() const { return faces_; }
    [[nodiscard]] const FaceCoupling<Dim>& coupling() const { return coupling_; }
    /// Throws BadInput for a coupling that `FaceCoupling` does not allow.
    void set_coupling(FaceCoupling<Dim> coupling);
    /// See Contact::admitted_overlaps.
    [[nodiscard]] std::vector<AdmittedOverlap<Dim>> admitted_overlaps(std::span<const Vector<Dim>> displacement,
                                                                      std::span<const PairMemory> memory) const;

private:
    [[nodiscard]] bool is_pressed_in(const ContactPair<Dim>& pair, const Vector<Dim>& u_1, const Vector<Dim>& u_2) const;
    /// Decides admission again. Where A min(g, 0) = 0 the flag of a pair may change without a change of the potential:
    /// there, and only there, it is decided again. `u`: of the listed faces [m]. Returns how many pairs are pressed in
    /// without being contacts.
    std::int64_t update_admission(std::span<PairMemory> memory, std::span<const Vector<Dim>> u) const;
    /// All but friction; gives the pairs of the step.
    const ActivePairs<Dim>& apply(const FacePath<Dim>& path, std::span<const PairMemory> memory, ContactStep<Dim>& step);

    SurfaceView<Dim> surface_;
    geometry::AreaMethod area_;
    InterfaceWeighting weighting_;
    PairList<Dim> list_;
    std::vector<Face> faces_;
    FaceCoupling<Dim> coupling_;
    PieceFinder<Dim> pieces_;
    PathMeasures<Dim> measures_;
    Reconstruction<Dim> law_;
    FaceFrictionLaw<Dim> friction_;
};

}  // namespace abut::contact
