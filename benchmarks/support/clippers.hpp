#pragma once
#include <span>
#include <string>
#include <vector>

#include "abut/geometry/overlap/overlap.hpp"

namespace abut::benchmark {

/// One way to compute the area that two triangles share; NaN where it came to grief. Pairs have no shift; both triangles
/// are counter-clockwise.
struct Clipper {
    std::string name;
    std::size_t most_pairs;  ///< that are worth timing
    void (*areas)(std::span<const geometry::TrianglePair> pairs, std::span<double> areas);
};

/// Plain clipping in doubles, first, and the libraries. Each does what its documentation tells a user to do.
[[nodiscard]] std::vector<Clipper> clippers();

/// The shared area, and those of the faces, in rational numbers, rounded once.
struct TrueAreas {
    double shared, face_1, face_2;
    bool overlaps;  ///< whether shared > 0, before it is rounded
};
[[nodiscard]] TrueAreas true_areas(const geometry::TrianglePair& pair);

}  // namespace abut::benchmark
