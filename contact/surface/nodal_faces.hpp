#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/contact/surface/obstacle.hpp"

namespace abut::contact {

/// Nodes and faces of many bodies, for a host that has no arrays of its own or appends obstacles to them.
template <int Dim>
struct NodalFaceArrays {
    std::vector<std::int32_t> nodes;
    std::vector<std::int32_t> offsets{0};
    std::vector<std::int32_t> body;
    std::vector<double> depth;
    std::vector<double> stiffness;  ///< of each body

    [[nodiscard]] NodalFaces<Dim> view() const { return {nodes, offsets, body, depth, stiffness}; }

    void append_face(std::span<const std::int32_t> corners, double face_depth, std::int32_t face_body) {
        nodes.insert(nodes.end(), corners.begin(), corners.end());
        offsets.push_back(static_cast<std::int32_t>(nodes.size()));
        depth.push_back(face_depth);
        body.push_back(face_body);
    }
    /// Appends an obstacle as a new rigid body, and its corners to `rest`; gives the number of the body. Its path is not
    /// looked at: the host places its nodes at each step.
    std::int32_t append_obstacle(const RigidObstacle<Dim>& obstacle, std::vector<Vector<Dim>>& rest) {
        const auto number = static_cast<std::int32_t>(stiffness.size());
        stiffness.push_back(std::numeric_limits<double>::infinity());
        for (const auto& corners : obstacle.faces) {
            std::vector<std::int32_t> face;
            for (const Vector<Dim>& corner : corners) {
                face.push_back(static_cast<std::int32_t>(rest.size()));
                rest.push_back(corner);
            }
            append_face(face, 0.0, number);
        }
        return number;
    }
};

}  // namespace abut::contact
