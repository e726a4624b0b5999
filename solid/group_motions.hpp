#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/all_points.hpp"
#include "abut/solid/body/body_frame.hpp"

namespace abut::solid {

/// Motion of some bodies together.
template <int Dim>
struct GroupMotion {
    double mass = 0.0;                                 ///< [kg]
    Vector<Dim> centre = Vector<Dim>::Zero();          ///< of mass [m]
    Vector<Dim> velocity = Vector<Dim>::Zero();        ///< of the centre of mass [m/s]
    AxialVector<Dim> spin = AxialVector<Dim>::Zero();  ///< as of a rigid body with its angular momentum [rad/s]
};

/// Motion of each group of bodies (n_groups); that of a group without bodies is zero. `group`: number of the group of each
/// body, 0 to n_groups - 1 (n_bodies).
template <int Dim>
[[nodiscard]] std::vector<GroupMotion<Dim>> group_motions(const AllPoints<Dim>& points, std::span<const std::int32_t> group,
                                                          std::size_t n_groups) {
    const auto q = as_vectors<Dim>(points.q());
    const auto mass = points.mass();
    const auto at = [&](std::size_t i) -> Vector<Dim> { return points.rest()[i] + q[i]; };
    const auto group_of = [&](std::size_t i) {
        return static_cast<std::size_t>(group[static_cast<std::size_t>(points.body()[i])]);
    };
    std::vector<GroupMotion<Dim>> motions(n_groups);
    for (std::size_t i = 0; i < q.size(); ++i) {
        GroupMotion<Dim>& motion = motions[group_of(i)];
        motion.mass += mass[i];
        motion.velocity += points.momentum(i);
    }
    for (std::size_t i = 0; i < q.size(); ++i) motions[group_of(i)].centre += mass[i] / motions[group_of(i)].mass * at(i);
    std::vector<Matrix<Dim>> second_moment(n_groups, Matrix<Dim>::Zero());
    std::vector<AxialVector<Dim>> angular(n_groups, AxialVector<Dim>::Zero());
    for (std::size_t i = 0; i < q.size(); ++i) {
        const Vector<Dim> arm = at(i) - motions[group_of(i)].centre;
        second_moment[group_of(i)] += mass[i] * arm * arm.transpose();
        angular[group_of(i)] += moment<Dim>(arm, points.momentum(i));
    }
    for (std::size_t g = 0; g < n_groups; ++g) {
        if (motions[g].mass == 0.0) continue;
        motions[g].velocity /= motions[g].mass;
        motions[g].spin = spin_of<Dim>(second_moment[g], angular[g]);
    }
    return motions;
}

}  // namespace abut::solid
