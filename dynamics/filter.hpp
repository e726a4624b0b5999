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
    std::vector<std::int32_t> points;  ///< by their numbers among those of all ranks, increasing; none is in two patches
    std::vector<Hold<Dim>> holds;      ///< the momentum of rigid motions that these prevent is not the patch's own
};

/// A system that says which of its points were in contact, and what acts on them now. On several ranks both are calls
/// of all: the patches are the same everywhere, and each asks for forces on points of its own.
template <class S>
concept PatchSystem = MomentSystem<S> && requires(S& system, std::span<const std::int32_t> points, std::span<const double> q,
                                                  std::span<Vector<S::dimension>> force) {
    { system.contact_patches() } -> std::convertible_to<std::vector<ContactPatch<S::dimension>>>;  ///< of the last step
    system.end_force_on(points, q, force);  ///< F(q) on some points (n_points, dimension) [N], q where the last step ended
};

namespace detail {

/// Throws BadInput for a kappa that is not from 0 to 1.
void check_kappa(double kappa);

/// Data that the filter needs of a point.
template <int Dim>
struct PatchPoint {
    double mass;
    Vector<Dim> position;   ///< of the kind of the system's `moment_arms`
    Vector<Dim> momentum;   ///< p^{n+1/2}
    Vector<Dim> parasitic;  ///< e
};

/// Part kappa e' of the points of a patch, in its order. `points`: those of all patches, whose numbers are `numbers`,
/// increasing.
template <int Dim>
[[nodiscard]] std::vector<Vector<Dim>> parasitic_part(const ContactPatch<Dim>& patch, std::span<const std::int32_t> numbers,
                                                      std::span<const PatchPoint<Dim>> points, double kappa);

/// Fills in the points of other ranks. `own`: those of this one, by position.
template <int Dim>
void gather_points(const Ranks& ranks, std::span<const std::size_t> own, std::span<PatchPoint<Dim>> points);

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

    /// To be called after each step (Integrator::set_after_step); a call of all ranks.
    void operator()(std::span<const double> q, double dt, std::span<const double> p_before, std::span<double> p_after) {
        const std::vector<ContactPatch<Dim>> patches = system_.contact_patches();
        if (patches.empty()) return;
        find_points(patches);
        const auto before = as_vectors<Dim>(p_before);
        const auto after = as_vectors<Dim>(p_after);
        force_.resize(own_.size());
        system_.end_force_on(own_, q, force_);
        points_.resize(numbers_.size());
        for (std::size_t k = 0; k < own_.size(); ++k) {
            const auto i = static_cast<std::size_t>(own_[k]);
            points_[own_position_[k]] = {.mass = system_.masses()[i],
                                         .position = moment_position(i, as_vectors<Dim>(q)[i], dt, before[i]),
                                         .momentum = before[i],
                                         .parasitic = after[i] - before[i] - dt * force_[k]};
        }
        detail::gather_points<Dim>(ranks_of(system_), own_position_, points_);
        for (const ContactPatch<Dim>& patch : patches) {
            const auto removed = detail::parasitic_part<Dim>(patch, numbers_, points_, kappa_);
            for (std::size_t k = 0, own = 0; k < patch.points.size(); ++k) {
                while (own < own_.size() && numbers_[own_position_[own]] < patch.points[k]) ++own;
                if (own < own_.size() && numbers_[own_position_[own]] == patch.points[k]) after[own_[own]] -= removed[k];
            }
        }
        // Along the lines of the last step: that changes no more of H~, momentum and J~ than the step itself.
        if constexpr (ConstrainedSystem<S>) system_.constrain_along(q, dt, p_after);
    }

private:
    /// The points of all patches, and which of them are here.
    void find_points(std::span<const ContactPatch<Dim>> patches) {
        numbers_.clear();
        for (const ContactPatch<Dim>& patch : patches)
            numbers_.insert(numbers_.end(), patch.points.begin(), patch.points.end());
        std::sort(numbers_.begin(), numbers_.end());
        own_.clear();
        own_position_.clear();
        const Ranks& ranks = ranks_of(system_);
        for (std::size_t k = 0; k < numbers_.size(); ++k) {
            const std::int32_t point = ranks.point_with(numbers_[k]);
            if (point < 0) continue;
            own_.push_back(point);
            own_position_.push_back(k);
        }
    }
    /// About which the moments of the patch are taken.
    Vector<Dim> moment_position(std::size_t i, const Vector<Dim>& q, double dt, const Vector<Dim>& p_before) const {
        const Vector<Dim>& rest = system_.rest_positions()[i];
        if (system_.moment_arms() == MomentArms::rest) return rest;
        return rest + q - (0.5 * dt / system_.masses()[i]) * p_before;
    }

    S& system_;
    double kappa_;
    std::vector<std::int32_t> numbers_;            // of the points of all patches, among those of all ranks, increasing
    std::vector<detail::PatchPoint<Dim>> points_;  // of these
    std::vector<std::int32_t> own_;                // those that are here, as the system has them
    std::vector<std::size_t> own_position_;        // of these among numbers_
    std::vector<Vector<Dim>> force_;               // on these
};

}  // namespace abut::dynamics
