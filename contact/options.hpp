#pragma once
#include "abut/geometry/broad_phase.hpp"
#include "abut/geometry/overlap.hpp"

namespace abut::contact {

/// How the correction of a pair is shared by its two faces, theta_1 + theta_2 = 1. docs/method.md, Contact.
enum class Weights {
    half,       ///< theta = 1/2, the formula of the talk
    stiffness,  ///< theta_1 = k_2 / (k_1 + k_2): the tractions of the massless interface balance
};

/// Whether the overlap area follows the motion during a step.
enum class OverlapMode {
    moving,  ///< it does, and its derivative is part of the force: one potential, energy exact while sliding
    frozen,  ///< it is taken at the start of the step: cheaper, but the energy jumps at each update
};

/// Every choice that trades cost for accuracy. The defaults are the exact ones.
struct ContactOptions {
    geometry::BroadPhase broad_phase = geometry::BroadPhase::embree;
    geometry::AreaMethod area = geometry::AreaMethod::fast;
    OverlapMode overlap = OverlapMode::moving;
    Weights weights = Weights::stiffness;
    bool events = true;           ///< cut the step where a pair opens, closes or changes its overlap formula
    int quadrature = 0;           ///< Gauss-Legendre points a subinterval, 1 to 3; 0 means Dim, the exact number
    double facing_cosine = -0.5;  ///< n_1 . n_2 below this: the faces look at each other. Between -1 and 0
    /// [m] how far faces may move, together, before the candidate list is made anew; 0: the mean face size
    double skin = 0.0;
    /// Also pairs of faces of one body. Both sides of an edge sharper than `facing_cosine` says face each other, too (below
    /// 60 degrees by default), and touch from the start: lower facing_cosine for a body with such edges.
    bool self_contact = false;
    double compression_warning = 0.3;  ///< |g|/D above which a step is counted as strongly compressed
    double compression_limit = 2.0;    ///< |g|/D above which the step is refused with an error
};

}  // namespace abut::contact
