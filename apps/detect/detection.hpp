#pragma once
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "apps/detect/motion.hpp"
#include "apps/detect/nearest.hpp"

namespace abut::apps {

/// Limits of what counts as near, once every default is known.
struct Nearness {
    double distance;  ///< [m] gaps up to here are kept
    double depth;     ///< [m] gaps above minus this
    double skin;      ///< [m] 0: the library chooses
};

/// Defaults from the bodies at the start and from what comes after it.
[[nodiscard]] Nearness nearness(const DetectOptions& options, const Bodies& bodies, const Motion& motion);

/// Findings of one step.
struct StepResult {
    int step = 0;
    bool searched = false;       ///< a list was made
    std::int64_t box_pairs = 0;  ///< of the last list
    std::int64_t candidates = 0;
    double area = 0.0;  ///< of the overlaps kept, together [m^2]
    double gap_min = 0.0, gap_max = 0.0;
    std::int64_t too_far = 0, too_deep = 0;  ///< overlaps left out because of their gap
    std::int64_t too_steep = 0;              ///< left out because n_1 . n_2 is not below --facing
    contact::OverlapReport narrow;
    std::vector<contact::Overlap<3>> overlaps;  ///< -depth < gap <= distance, n_1 . n_2 < --facing
    /// Distances of the faces of each in space [m]: by `Detection::measure_distances` alone, empty before, as is what
    /// follows
    std::vector<double> distances;
    Neighbours neighbours;
};

/// Contact of two bodies.
struct BodyContact {
    static constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    std::int64_t overlaps = 0;
    double area = 0.0;          ///< [m^2]
    double gap_min = nan;       ///< [m]; not a number without overlaps
    double distance_min = nan;  ///< of faces that overlap [m]; not a number without
    double depth = 0.0;         ///< how deep they lie in each other [m]; below 0: how far these faces are apart
    bool crosses = false;       ///< one is partly inside of the other one
    std::int32_t inner = -1;    ///< that which is wholly inside; -1: neither is
};
/// By pair of bodies, the smaller number first: those with overlaps, and all that meet. Distances must have been measured.
using BodyContacts = std::map<std::pair<std::int32_t, std::int32_t>, BodyContact>;
[[nodiscard]] BodyContacts contacts_of(const Bodies& bodies, const StepResult& result);

/// Finds candidates and overlaps step by step. Keeps a reference to the bodies, which are at the start when it is made.
class Detection {
public:
    /// `turns`: bodies turn or deform in some step. If not, normals help to choose the candidates.
    Detection(const Bodies& bodies, const DetectOptions& options, const Nearness& near, bool turns);

    /// Finds for the present positions of the bodies. The candidate list is rebuilt where it is not valid for the
    /// motion since.
    [[nodiscard]] const StepResult& find(int step);
    /// Fills `distances` and `nearest` of what `find` has given last.
    void measure_distances();

    [[nodiscard]] std::span<const geometry::IndexPair> candidates() const { return search_.candidates(); }
    [[nodiscard]] double skin() const { return search_.skin(); }
    [[nodiscard]] const contact::CandidateReport& report() const { return search_.report(); }
    [[nodiscard]] double seconds_search() const { return seconds_search_; }
    [[nodiscard]] double seconds_narrow() const { return seconds_narrow_; }
    [[nodiscard]] double seconds_nearest() const { return seconds_nearest_; }

private:
    void search();
    void search_where_faces_are();
    [[nodiscard]] std::vector<Vector<3>> translations() const;
    [[nodiscard]] double motion_since() const;
    void keep_near_ones();

    const Bodies& bodies_;
    geometry::AreaMethod area_;
    double facing_cosine_;
    Nearness near_;
    bool turns_;
    contact::Surface<3> start_;
    std::vector<Vector<3>> at_search_;  // vertices
    contact::CandidateSearch<3> search_;
    contact::Overlaps<3> found_;
    StepResult result_;
    double seconds_search_ = 0.0;
    double seconds_narrow_ = 0.0;
    double seconds_nearest_ = 0.0;
};

}  // namespace abut::apps
