#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/point_system.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::dynamics {

/// An obstacle or a prescribed boundary does not let this position of a patch move along this direction.
template <int Dim>
struct Hold {
    Vector<Dim> position;  ///< of the kind of the system's `moment_arms`: at rest, or in the middle of the last step [m]
    /// Unit; of an obstacle its own normal: with that of a pair, which is tilted, momentum along a wall would change
    Vector<Dim> direction;
};

/// Points that touched something in the last step and so may carry the parasitic mode of the scheme.
template <int Dim>
struct ContactPatch {
    std::vector<std::int32_t> points;  ///< increasing; no point is in two patches
    std::vector<Hold<Dim>> holds;      ///< the momentum of rigid motions that these prevent is not the patch's own
};

/// A system that says which of its points were in contact, and what acts on them now.
template <class S>
concept PatchSystem = MomentSystem<S> && requires(S& system, std::span<const std::int32_t> points, std::span<const double> q,
                                                  std::span<Vector<S::dimension>> force) {
    { system.contact_patches() } -> std::convertible_to<std::vector<ContactPatch<S::dimension>>>;  ///< of the last step
    system.end_force_on(points, q, force);  ///< F(q) on some points (n_points, dimension) [N], q where the last step ended
};

namespace detail {

/// Throws BadInput for a kappa that is not from 0 to 1.
void check_kappa(double kappa);

/// One patch and the arrays of the whole system.
template <int Dim>
struct PatchState {
    std::span<const double> mass;                ///< of all points (n)
    std::span<const Vector<Dim>> rest_position;  ///< (n)
    std::span<const Vector<Dim>> q;              ///< (n)
    std::span<const Vector<Dim>> p_before;       ///< (n)
    std::span<Vector<Dim>> p_after;              ///< (n)
    std::span<const std::int32_t> points;        ///< of all patches, increasing
    std::span<const Vector<Dim>> force;          ///< on these
    MomentArms arms;
    double dt;
};

/// Takes kappa e' out of the patch.
template <int Dim>
void filter_patch(const ContactPatch<Dim>& patch, const PatchState<Dim>& state, double kappa);

}  // namespace detail

/// Takes the alternating mode of MEMM out of the points that were in contact, without touching H~, momentum or angular
/// momentum: those of `moment_arms`, J~ or that about the positions at rest. docs/filter.md:
///
///     p^{n+3/2} <- p^{n+3/2} - kappa e'
///
/// e' is the parasitic momentum e less its projection, in the norm of M^-1 over the patch, on {M e_k; M e_k × arm; M v}: the
/// momenta of rigid motions about `moment_arms`, as far as no obstacle and no prescribed boundary holds these, and those of
/// v = M^-1 p^{n+1/2}. H~ changes by v . e'/2, momentum and angular momentum by the products of e' with the rigid motions:
/// all are zero. Along rollers and along a wall momentum stays, too. Costs one force evaluation near the contact.
template <PatchSystem S>
class NeutralFilter {
public:
    static constexpr int Dim = S::dimension;

    /// `kappa`: the part of the mode that is taken out at each step [-], 0 to 1. The system must outlive the filter. Throws
    /// BadInput for a kappa outside.
    explicit NeutralFilter(S& system, double kappa = 1.0) : system_(system), kappa_(kappa) { detail::check_kappa(kappa); }

    /// To be called after each step (Integrator::set_after_step).
    void operator()(std::span<const double> q, double dt, std::span<const double> p_before, std::span<double> p_after) {
        refuse_ranks(ranks_of(system_), "filter");
        const std::vector<ContactPatch<Dim>> patches = system_.contact_patches();
        if (patches.empty()) return;
        points_.clear();
        for (const ContactPatch<Dim>& patch : patches)
            points_.insert(points_.end(), patch.points.begin(), patch.points.end());
        std::sort(points_.begin(), points_.end());
        force_.resize(points_.size());
        system_.end_force_on(points_, q, force_);
        const detail::PatchState<Dim> state{.mass = system_.masses(),
                                            .rest_position = system_.rest_positions(),
                                            .q = as_vectors<Dim>(q),
                                            .p_before = as_vectors<Dim>(p_before),
                                            .p_after = as_vectors<Dim>(p_after),
                                            .points = points_,
                                            .force = force_,
                                            .arms = system_.moment_arms(),
                                            .dt = dt};
        for (const ContactPatch<Dim>& patch : patches) detail::filter_patch<Dim>(patch, state, kappa_);
        // Along the lines of the last step: that changes no more of H~, momentum and J~ than the step itself.
        if constexpr (ConstrainedSystem<S>) system_.constrain_along(q, dt, p_after);
    }

private:
    S& system_;
    double kappa_;
    std::vector<std::int32_t> points_;
    std::vector<Vector<Dim>> force_;
};

}  // namespace abut::dynamics
