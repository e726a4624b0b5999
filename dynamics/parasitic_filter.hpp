#pragma once
#include "abut/dynamics/solid.hpp"

namespace abut::dynamics {

/// Takes the alternating mode of MEMM out of the cells that were in contact, without touching H~, momentum or angular
/// momentum. docs/method.md, Time:
///
///     p^{n+3/2} <- p^{n+3/2} - kappa (e' - alpha M v'),   alpha = v . e' / (v . M v')
///
/// e is the parasitic momentum, v = M^-1 p^{n+1/2}; e' and v' are without their rigid-body parts over the patch, unless the
/// patch is held by an obstacle or a prescribed boundary. Costs one force evaluation near the contact.
template <int Dim>
class NeutralFilter {
public:
    explicit NeutralFilter(Solid<Dim>& solid, double kappa = 1.0) : solid_(solid), kappa_(kappa) {}

    /// To be called after each step (Integrator::set_after_step).
    void operator()(std::span<const double> q, double dt, std::span<const double> p_before, std::span<double> p_after);

private:
    void filter(const ContactPatch& patch, std::span<const Vector<Dim>> q, double dt, std::span<const Vector<Dim>> p_before,
                std::span<Vector<Dim>> p_after, std::span<const Vector<Dim>> force);

    Solid<Dim>& solid_;
    double kappa_;
    std::vector<std::int32_t> cells_;
    std::vector<Vector<Dim>> force_;
    std::vector<Vector<Dim>> e_;  // of one patch, as a velocity M^-1 e
    std::vector<Vector<Dim>> v_;
};

}  // namespace abut::dynamics
