#pragma once
#include <cstdint>
#include <tuple>

namespace abut::contact {

/// Events since the start, for the reader of a run.
struct ContactReport {
    std::int64_t candidates = 0;  ///< pairs in the current list
    std::int64_t candidates_max = 0;
    std::int64_t active_pairs = 0;  ///< pairs active in the last step; here and below a part of a step counts as one
    std::int64_t active_pairs_max = 0;
    std::int64_t events = 0;                 ///< openings, closings and changes of overlap inside steps, all steps
    std::int64_t rebuilds = 0;               ///< candidate lists made
    std::int64_t missed_contacts = 0;        ///< pairs first seen with A > 0 and -D < g < 0: must stay 0
    std::int64_t inadmissible_overlaps = 0;  ///< pairs of the current list with A > 0 and g < 0 that are no contacts
    std::int64_t compressed_steps = 0;       ///< steps with |g|/D above the warning
    double compression_max = 0.0;            ///< largest |g|/D
    double sliding_ratio_max = 0.0;        ///< largest |g| |dA/ds| over the smaller face of a pair (not on nodes, as below)
    std::int64_t slipped_pairs = 0;        ///< slid off each other while pressed in, all steps (StepReport)
    double slipped_compression_max = 0.0;  ///< their largest |g|/D
    std::int64_t tilted_pairs_max = 0;     ///< the most in a step (StepReport)
    double correction_max = 0.0;           ///< of the pair potential, the largest of a step (StepReport)
    double friction_dissipated = 0.0;      ///< D so far [J]
    double least_dissipated = 0.0;         ///< of one face in one step [J]: < 0 by rounding alone under MEMM
    double friction_ratio_max = 0.0;       ///< largest force of a face over its limit [-]
    double sliding_force = 0.0;            ///< sum over faces that slide and all steps, times dt [N s]
    double sliding_limit = 0.0;            ///< the same of their limits [N s]
    std::int64_t sticking_faces = 0;       ///< in the last step
    std::int64_t sliding_faces = 0;
    std::int64_t sticking_faces_max = 0;  ///< the most in a step
    std::int64_t sliding_faces_max = 0;

    static auto fields(auto& self) {
        return std::tie(self.candidates, self.candidates_max, self.active_pairs, self.active_pairs_max, self.events,
                        self.rebuilds, self.missed_contacts, self.inadmissible_overlaps, self.compressed_steps,
                        self.compression_max, self.sliding_ratio_max, self.slipped_pairs, self.slipped_compression_max,
                        self.tilted_pairs_max, self.correction_max, self.friction_dissipated, self.least_dissipated,
                        self.friction_ratio_max, self.sliding_force, self.sliding_limit, self.sticking_faces,
                        self.sliding_faces, self.sticking_faces_max, self.sliding_faces_max);
    }
};

/// Figures of a search, for the reader of a run.
struct CandidateReport {
    std::int64_t searches = 0;         ///< lists made
    std::int64_t orderings = 0;        ///< of them, how many put the faces into a new spatial order first
    std::int64_t box_pairs = 0;        ///< pairs of boxes that overlapped, of bodies that may touch: the last search
    std::int64_t neighbours = 0;       ///< of them, left out because the faces are neighbours on one body
    std::int64_t both_rigid = 0;       ///< left out because both faces are rigid
    std::int64_t not_facing = 0;       ///< left out because the faces do not look at each other
    std::int64_t too_far_apart = 0;    ///< left out because gap or tangential offset rule contact out
    std::int64_t candidates = 0;       ///< pairs in the list
    std::int64_t candidates_max = 0;   ///< over all searches
    double motion = 0.0;               ///< [m] the farthest that a face or vertex moved within the step of the last search
    double seconds_boxes = 0.0;        ///< all searches: making boxes
    double seconds_broad_phase = 0.0;  ///< all searches: finding the pairs, tests of faces included
};

}  // namespace abut::contact
