#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::run {

/// Position at which a run is watched: the cell that holds a point, or the mean over a whole body.
template <int Dim>
struct Probe {
    std::string name;
    std::int32_t body = 0;                  ///< number in the mesh
    std::optional<Vector<Dim>> position{};  ///< at rest [m]; none: the body as a whole
    bool contact = false;                   ///< forces of contact on the body, and its slip; not with a position
};

/// Fields of frames for ParaView beside the displacement.
struct FrameFields {
    bool velocity = true;
    bool stress = true;  ///< in 2D with that out of the plane
    bool von_mises = true;
    bool plastic_strain = true;  ///< where a material has one
    bool pressure = true;        ///< of contact, on the surface
    bool gap = true;             ///< on the surface
    bool friction = true;        ///< traction, slip and state on the surface, and of pairs; where there is friction
    bool pairs = true;           ///< of faces that push each other, as a series of points
};

/// Files that ResultFiles writes of a scene beside its energies.
template <int Dim>
struct Outputs {
    std::vector<Probe<Dim>> probes{};  ///< probes.csv; none: no file
    bool forces = false;               ///< forces.csv
    int interval = 0;                  ///< steps between rows of these files; 0: those between records of the energies
    FrameFields fields{};
    std::vector<std::string> obstacles{};  ///< names; empty: obstacle_0 and so on
};

}  // namespace abut::run
