#pragma once
// Private to the sources of this layer and of run.
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/gathered_state.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

/// Points of a solid and their motion, of all ranks in the order of their numbers: on rank 0, none on the others. On one
/// rank nothing is copied, and solid and state must outlive it.
template <int Dim>
class AllPoints {
public:
    /// A call of all ranks, each with its own points.
    AllPoints(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid) : AllPoints(solid) {
        q_ = taken(solid, run.q, Dim, q_kept_);
        p_before_ = taken(solid, run.p_before, Dim, p_before_kept_);
        p_after_ = taken(solid, run.p_after, Dim, p_after_kept_);
    }
    /// Points at rest, without a motion.
    explicit AllPoints(const Solid<Dim>& solid) {
        const std::span<const Vector<Dim>> rest = solid.rest_positions();
        rest_ = taken(solid, std::span(rest.empty() ? nullptr : rest.front().data(), Dim * rest.size()), Dim, rest_kept_);
        mass_ = taken(solid, solid.masses(), 1, mass_kept_);
        body_ = solid.body_of_points();
        if (solid.ranks().is_one()) return;
        for (const double body : solid.ranks().collect(std::vector<double>(body_.begin(), body_.end()), 1))
            body_kept_.push_back(static_cast<std::int32_t>(body));
        body_ = body_kept_;
    }
    AllPoints(const AllPoints&) = delete;
    AllPoints& operator=(const AllPoints&) = delete;

    [[nodiscard]] std::size_t size() const { return mass_.size(); }
    [[nodiscard]] std::span<const Vector<Dim>> rest() const { return as_vectors<Dim>(rest_); }  ///< [m]
    [[nodiscard]] std::span<const double> mass() const { return mass_; }                        ///< [kg]
    [[nodiscard]] std::span<const std::int32_t> body() const { return body_; }
    [[nodiscard]] std::span<const double> q() const { return q_; }  ///< (n_points, Dim) [m]
    /// (p^{n-1/2} + p^{n+1/2})/2 of a point [kg m/s].
    [[nodiscard]] Vector<Dim> momentum(std::size_t point) const {
        return 0.5 * (as_vectors<Dim>(p_before_)[point] + as_vectors<Dim>(p_after_)[point]);
    }

private:
    static std::span<const double> taken(const Solid<Dim>& solid, std::span<const double> own, int width,
                                         std::vector<double>& kept) {
        if (solid.ranks().is_one()) return own;
        kept = solid.ranks().collect(own, width);
        return kept;
    }

    std::span<const double> rest_, mass_, q_, p_before_, p_after_;
    std::span<const std::int32_t> body_;
    std::vector<double> rest_kept_, mass_kept_, q_kept_, p_before_kept_, p_after_kept_;
    std::vector<std::int32_t> body_kept_;
};

}  // namespace abut::solid
