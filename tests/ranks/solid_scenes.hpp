#pragma once
// Bodies that several ranks share out.
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/ranks/partition.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::test {

inline constexpr solid::Material steel{.young = 2.0, .poisson = 0.3, .density = 1.5};

/// Long along x, so that copies do not reach from end to end.
template <int Dim>
mesh::Mesh<Dim> bar(mesh::CellShape shape) {
    if constexpr (Dim == 2)
        return mesh::structured_box<2>({0.0, 0.0}, {4.0, 0.5}, {64, 8}, shape);
    else
        return mesh::structured_box<3>({0.0, 0.0, 0.0}, {4.0, 0.3, 0.25}, {48, 4, 3}, shape);
}

/// Two round bodies, of different cells, about to collide off-centre.
template <int Dim>
mesh::Mesh<Dim> two_round_bodies() {
    std::vector<mesh::Mesh<Dim>> bodies;
    for (int i = 0; i < 2; ++i) {
        Vector<Dim> centre = Vector<Dim>::Zero();
        centre[0] = i == 0 ? -1.005 : 1.005;
        centre[1] = i == 0 ? 0.0 : 0.5;
        if constexpr (Dim == 2)
            bodies.push_back(mesh::disc({.centre = centre, .size = i == 0 ? 0.1 : 0.11, .variant = i}));
        else
            bodies.push_back(mesh::cylinder({.centre = centre, .length = 0.6, .size = i == 0 ? 0.28 : 0.31, .variant = i}));
    }
    return mesh::combine<Dim>(bodies);
}

/// The rank of each cell of a mesh, as many to each.
template <int Dim>
std::vector<int> parts(const ranks::Communicator& all, const mesh::Mesh<Dim>& mesh) {
    return ranks::partition<Dim>(all, mesh.cell_centroid);
}

/// Velocities of two bodies beside each other along x [m/s].
template <int Dim>
std::vector<Vector<Dim>> towards_each_other(double speed) {
    return {speed * Vector<Dim>::Unit(0), -speed * Vector<Dim>::Unit(0)};
}

}  // namespace abut::test
