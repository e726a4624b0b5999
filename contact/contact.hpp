#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "abut/contact/path/path_integral.hpp"
#include "abut/contact/search/candidate_search.hpp"

namespace abut::contact {

/// What happened since the start, for the reader of a run.
struct ContactReport {
    std::int64_t candidates = 0;  ///< pairs in the current list
    std::int64_t candidates_max = 0;
    std::int64_t active_pairs = 0;  ///< pairs active in the last step; here and below a part of a step counts as one
    std::int64_t active_pairs_max = 0;
    std::int64_t events = 0;               ///< openings, closings and changes of overlap inside steps, all steps
    std::int64_t rebuilds = 0;             ///< candidate lists made
    std::int64_t lost_contacts = 0;        ///< pairs first seen with A > 0 and -D < g < 0: must stay 0
    std::int64_t not_admitted = 0;         ///< pairs of the current list with A > 0 and g < 0 that are no contacts
    std::int64_t compressed_steps = 0;     ///< steps with |g|/D above the warning
    double compression_max = 0.0;          ///< largest |g|/D
    double sliding_ratio_max = 0.0;        ///< largest |g| |dA/ds| over the smaller face of a pair
    std::int64_t slipped_pairs = 0;        ///< slid off each other while pressed in, all steps (PathIntegral::slipped)
    double slipped_compression_max = 0.0;  ///< their largest |g|/D
};

/// The contact of a set of surfaces, for any solver that moves its bodies along straight lines during a step.
///
/// Each step the host (1) asks `covers`, and if not, calls `search` with the displacements of all faces; (2) gives the path
/// of the listed `faces()` to `integrate`; (3) adds `mean_correction` to their displacement in its own force evaluation at
/// the middle of the step, adds `mean_force` to dV/dû of these faces, and takes both to its unknowns by the transpose of
/// its reconstruction. docs/method.md, Contact and Time; docs/embedding.md walks through it.
template <int Dim>
class Contact {
public:
    /// Keeps the view: the host's arrays must outlive it. Checks the surface and the options (BadInput).
    Contact(SurfaceView<Dim> surface, const ContactOptions& options);

    /// How the host's face forces answer to corrections of the given faces; called after each search.
    using CouplingOf = std::function<FaceCoupling<Dim>(std::span<const std::int32_t> faces)>;

    /// Whether the candidate list is still a superset of all that can touch, when no face has moved by more than `motion`
    /// [m] since `search`.
    [[nodiscard]] bool covers(double motion) const { return list_holds_ && candidates_.covers(motion); }

    /// Makes the list anew for a step from u_0 to u_1, both of all faces (n) [m]. Throws what CandidateSearch::search
    /// throws, and BadInput for a coupling out of range; no list holds then until a search ends well.
    void search(std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1, const CouplingOf& coupling_of);

    /// Faces of the candidate list, increasing: those whose path the host must give.
    [[nodiscard]] std::span<const std::int32_t> faces() const { return faces_; }

    /// Decides admission at the start of the step, then integrates along it. Throws TooDeep or Diverged naming the faces when
    /// a pair is pressed in deeper than `compression_limit` or the path is not finite, Misuse without a list.
    void integrate(const FacePath<Dim>& path);

    /// For schemes that take the force at the end of a step alone: decides admission at its start as `integrate` does, then
    /// takes corrections and pair forces at its end. There are no events; throws as `integrate`.
    void follow(std::span<const Vector<Dim>> displacement_0, std::span<const Vector<Dim>> displacement_1,
                std::span<const Vector<Dim>> force_1);

    /// Corrections and pair forces of one state (a path without motion), with the admission as it stands; counts nothing.
    void evaluate(std::span<const Vector<Dim>> displacement, std::span<const Vector<Dim>> force);

    [[nodiscard]] const PathIntegral<Dim>& result() const { return integral_; }
    [[nodiscard]] const PairList<Dim>& pairs() const { return pairs_; }
    [[nodiscard]] const SurfaceView<Dim>& surface() const { return surface_; }
    [[nodiscard]] const ContactReport& report() const { return report_; }
    [[nodiscard]] double skin() const { return candidates_.skin(); }
    [[nodiscard]] const CandidateReport& search_report() const { return candidates_.report(); }
    /// Place of a face of the surface in `faces()`, -1 if it is not there.
    [[nodiscard]] std::int32_t local(std::int32_t face) const { return local_face_[face]; }
    [[nodiscard]] const FaceCoupling<Dim>& coupling() const { return coupling_; }

private:
    void keep_admission(std::span<const ContactPair<Dim>> known, std::span<const Vector<Dim>> u_0);
    void update_admission(std::span<const Vector<Dim>> displacement);
    void list_faces();
    void require_list() const;
    void report_step();

    SurfaceView<Dim> surface_;
    ContactOptions options_;
    CandidateSearch<Dim> candidates_;
    bool searched_ = false;    // once at least: the run has begun
    bool list_holds_ = false;  // the last search came to its end
    PairList<Dim> pairs_;
    std::vector<std::int32_t> faces_;
    std::vector<std::int32_t> local_face_;
    FaceCoupling<Dim> coupling_;
    PathIntegral<Dim> integral_;
    ContactReport report_;
};

}  // namespace abut::contact
