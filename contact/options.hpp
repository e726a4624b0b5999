#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "abut/contact/friction.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/overlap/overlap.hpp"
#include "abut/geometry/planarity.hpp"

namespace abut::contact {

/// How the correction of a pair is shared by its two faces, theta_1 + theta_2 = 1. docs/method.md, Contact.
enum class InterfaceWeighting {
    half,       ///< theta = 1/2, whatever the stiffnesses; 0 for a rigid face
    stiffness,  ///< theta_1 = k_2 / (k_1 + k_2): the tractions of the massless interface balance
};

/// Whether the overlap area follows the motion during a step.
enum class OverlapMode {
    moving,  ///< it does, and its derivative is part of the force: one potential, energy exact while sliding
    frozen,  ///< it is taken at the start of the step: cheaper, but the energy jumps at each update
};

/// Which pairs of faces a search for candidates lists, and what it may take.
struct CandidateOptions {
    geometry::BroadPhase broad_phase = geometry::BroadPhase::automatic;  ///< changes the cost alone
    /// [-] n_1 . n_2 below this: the faces look at each other, and gap and tangential offset tell what can touch. From above
    /// -1 to 1. With 1 normals and the model of contact play no part: what counts is the distance of faces in space
    double facing_cosine = -0.2;
    /// [m] >= 0: gaps up to this count besides contact. Contact itself needs 0
    double distance = 0.0;
    /// [m] how far two faces may move together, each by half of it, before the list is rebuilt; 0: begins with half the
    /// mean size of a face, and is then chosen from the numbers of faces and pairs and from the motion, so that a step costs
    /// least (docs/detection.md)
    double skin = 0.0;
    bool self_contact = false;  ///< also pairs of faces of one body
    /// Faces of one body are no candidates within so many steps from face to face over common corners (corners at exactly
    /// the same position are common): 1 leaves out those that share a corner, 0 none. Two sides of a sharp edge face each
    /// other.
    int self_contact_rings = 1;
    /// [-] > 0: a face that moves farther within a step than this times the extent of all surfaces together has diverged
    double largest_motion = 1.0;
    /// [-] >= 0: largest distance of a corner from the plane of its face, over the face size
    double planarity_tolerance = geometry::planarity_tolerance;
    /// Pairs: of the whole list. Memory: of each pair of bodies that is searched, beside the list; where parts share a
    /// search (Sharing), of each of them
    geometry::SearchLimits limits;
    /// Pairs of bodies of the surface, in either order, that pass through each other: none of their faces are candidates
    std::vector<std::array<std::int32_t, 2>> ignored_bodies = {};
};

/// Every choice that trades cost for accuracy. The defaults are the exact ones.
struct ContactOptions {
    CandidateOptions search;
    geometry::AreaMethod area = geometry::AreaMethod::fast;
    OverlapMode overlap = OverlapMode::moving;
    InterfaceWeighting weighting = InterfaceWeighting::stiffness;
    bool events = true;                ///< cut the step where a pair opens, closes or changes its overlap formula
    int quadrature = 0;                ///< Gauss-Legendre points per subinterval, 1 to 3; 0 means Dim, the exact number
    double compression_warning = 0.3;  ///< |g|/D above which a step is counted as strongly compressed
    double compression_limit = 2.0;    ///< |g|/D above which the step is refused with an error
    FrictionOptions friction = {};     ///< needs `SurfaceView::shear_stiffness`
};

}  // namespace abut::contact
