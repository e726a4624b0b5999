#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/values/forward.hpp"

namespace abut::run {

/// Marks in pictures of a scene beside its bodies: loads, springs and names of obstacles. Corners and points of bodies
/// are numbers of positions of a Snapshot.
struct PictureMarks {
    using Position = std::array<double, 3>;  ///< in 2D the third is 0 [m]

    /// A boundary face under a traction that the scene says.
    struct LoadedFace {
        std::vector<std::int32_t> corners;
        std::vector<Position> at_rest;                  ///< of the corners
        Position normal{};                              ///< outwards, at rest, unit
        std::function<Position(double time)> traction;  ///< [Pa]
        bool follows = false;                           ///< it turns with the face
    };
    /// An end of a spring, the sum of `fixed` and of weights times positions.
    struct SpringEnd {
        Position fixed{};
        std::vector<std::pair<std::int32_t, double>> held{};
    };
    /// A traction at a time, in the middle of its face.
    struct Load {
        Position at, traction, normal;
    };

    std::vector<LoadedFace> loaded;
    std::vector<std::array<SpringEnd, 2>> springs;
    Position gravity{};  ///< that all bodies have [m/s^2]
    std::vector<std::string> obstacle_names;
    std::vector<std::int32_t> obstacle;  ///< of each face of Snapshot::obstacles
};

/// At most twelve loaded faces per condition, and 48 in all. `number` gives the number of the position of a vertex of
/// the mesh.
template <int Dim>
[[nodiscard]] PictureMarks marks_of(const Scene<Dim>& scene, const std::function<std::int32_t(std::int32_t)>& number);

[[nodiscard]] std::vector<PictureMarks::Load> loads_at(const PictureMarks& marks, double time,
                                                       std::span<const PictureMarks::Position> positions);
[[nodiscard]] PictureMarks::Position place_of(const PictureMarks::SpringEnd& end,
                                              std::span<const PictureMarks::Position> positions);

}  // namespace abut::run
