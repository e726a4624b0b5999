#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "studies/nodal/p1_bodies.hpp"

/// Bodies of linear finite elements at rest, with contact on their nodes.
namespace abut::studies::nodal {

/// Load that acts on them, beside contact.
struct StaticLoad {
    std::vector<double> force;  ///< on the degrees of freedom [N]
    std::vector<char> held;     ///< 1: this degree of freedom stays where it starts
};

struct StaticState {
    std::vector<double> q;
    int iterations = 0;
    double residual = 0.0;  ///< largest force that is not in balance, over the largest load
    bool converged = false;
};

/// Newton's method from q, which has to have the bodies in contact. The stiffness of the bulk is that of small strain, which
/// alone will do; each active pair adds the second derivatives of its potential, less what is not positive in them.
template <int Dim>
[[nodiscard]] StaticState solve_at_rest(P1Bodies<Dim>& bodies, const StaticLoad& load, std::vector<double> q,
                                        double tolerance = 1e-11);

/// k_12 of the pairs of two deformable bodies [Pa/m].
template <int Dim>
[[nodiscard]] double pair_stiffness(const P1Bodies<Dim>& bodies, std::int32_t body_1, std::int32_t body_2);

}  // namespace abut::studies::nodal
