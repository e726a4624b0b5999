#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::apps {

/// Which pairs must be found.
struct Requirement {
    double distance;             ///< [m] gaps up to here
    double depth;                ///< [m] gaps above minus this
    double facing_cosine;        ///< [-] n_1 . n_2 below this
    bool within_bodies = false;  ///< also pairs of faces of one body
    int rings = 1;               ///< of faces of one body that are left out
};

/// How many pairs may be tested, and which faces if that is not all.
struct VerificationLimits {
    double tests = 1e8;        ///< beyond, a sample of faces is compared with all
    std::int32_t samples = 0;  ///< size of that sample; 0: as many as `tests` allows, at least one
    std::uint64_t seed = 1;
};

struct Verification {
    std::int64_t faces = 0;     ///< compared with all others
    bool sampled = false;       ///< these are not all faces
    std::int64_t tested = 0;    ///< pairs
    std::int64_t required = 0;  ///< of them: facing, sharing area, with a gap in the range
    std::int64_t on_limit = 0;  ///< within rounding of a limit: neither required nor wrong
    std::int64_t missed_candidates = 0;
    std::int64_t missed_overlaps = 0;
    std::int64_t wrong_overlaps = 0;  ///< kept with other numbers, or should not be there
    double area_error = 0.0;          ///< largest, over the smaller face
    double gap_error = 0.0;           ///< largest [m]
    std::string first_fault;          ///< in words; empty: none

    [[nodiscard]] bool passed() const { return missed_candidates + missed_overlaps + wrong_overlaps == 0; }
    Verification& operator+=(const Verification& other);
};

/// Compares lists of candidates and overlaps, both sorted by (face_1, face_2), with plain loops over all pairs: no boxes, no
/// tree, areas by CGAL's exact numbers. `start` (n_vertices) says which corners are common (at one place).
[[nodiscard]] Verification verify(const contact::SurfaceView<3>& surface, std::span<const Vector<3>> start,
                                  const Requirement& requirement, const VerificationLimits& limits,
                                  std::span<const geometry::IndexPair> candidates,
                                  std::span<const contact::Overlap<3>> overlaps);

}  // namespace abut::apps
